#include "raycast/start_cell.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace deliso {

namespace {

// c[0] + c[1] t + c[2] t^2 + c[3] t^3.
using Cubic = std::array<double, 4>;

// The interpolant on the line: blended along x, then y, then z, each time by a linear function of t.
Cubic on_line(const CellCorners& f, const Vec3& u, const Vec3& d) {
  std::array<std::array<double, 2>, 4> along_x;
  for (std::size_t i = 0; i < 4; ++i) {
    const double rise = f[2 * i + 1] - f[2 * i];
    along_x[i] = {f[2 * i] + rise * u.x, rise * d.x};
  }
  std::array<std::array<double, 3>, 2> along_y;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& [low0, low1] = along_x[2 * i];
    const double rise0 = along_x[2 * i + 1][0] - low0, rise1 = along_x[2 * i + 1][1] - low1;
    along_y[i] = {low0 + rise0 * u.y, low1 + rise1 * u.y + rise0 * d.y, rise1 * d.y};
  }
  const auto& [low0, low1, low2] = along_y[0];
  const double rise0 = along_y[1][0] - low0, rise1 = along_y[1][1] - low1, rise2 = along_y[1][2] - low2;
  return {low0 + rise0 * u.z, low1 + rise1 * u.z + rise0 * d.z, low2 + rise2 * u.z + rise1 * d.z, rise2 * d.z};
}

// Newton's method from t = 0; nothing when it does not come to rest.
std::optional<double> root_near_zero(const Cubic& c) {
  constexpr int kMostSteps = 8;
  constexpr double kSmallStep = 1e-8;  // its square is beyond the digits of a double
  double t = -c[0] / c[1];
  for (int i = 0; i < kMostSteps; ++i) {
    const double slope = (3 * c[3] * t + 2 * c[2]) * t + c[1];
    const double step = (((c[3] * t + c[2]) * t + c[1]) * t + c[0]) / slope;
    t -= step;
    if (std::abs(step) <= kSmallStep) return t;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> falling_hit_around(const CellCorners& relative, const Vec3& u, const Vec3& d) {
  constexpr double kLeastSlope = 0.5;  // of that at t = 0
  const Cubic c = on_line(relative, u, d);
  if (!(c[1] < 0)) return std::nullopt;
  const std::optional<double> t = root_near_zero(c);
  if (!t) return std::nullopt;
  const double reach = std::abs(*t);
  const auto stays_in_cell = [&](double at, double along) { return reach * std::abs(along) <= std::min(at, 1 - at); };
  if (!stays_in_cell(u.x, d.x) || !stays_in_cell(u.y, d.y) || !stays_in_cell(u.z, d.z)) return std::nullopt;
  const double bend = (2 * std::abs(c[2]) + 3 * std::abs(c[3]) * reach) * reach;
  if (!(bend <= (kLeastSlope - 1) * c[1])) return std::nullopt;
  return t;
}

}  // namespace deliso

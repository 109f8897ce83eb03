#include "volume/critical_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "volume/exact_topology_cell.h"
#include "volume/exact_topology_numbers.h"
#include "volume/trilinear_cell.h"

namespace deliso {

namespace {

// Heights of saddles of the body are known up to this fraction of the largest difference to the isovalue.
constexpr double kRounding = 1e-11;

bool is_inside(double x) { return x > 0 && x < 1; }

// On a face g = f00 + (f10 - f00) x + (f01 - f00) y + k x y has its saddle where both partial derivatives vanish.
void append_face_saddles(const CellCorners& corners, std::vector<CriticalPoint>& points) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (std::size_t side = 0; side < 2; ++side) {
      const double f00 = corners[side << axis];
      const double f10 = corners[(side << axis) | (1u << u)];
      const double f01 = corners[(side << axis) | (1u << v)];
      const double f11 = corners[(side << axis) | (1u << u) | (1u << v)];
      const double k = f00 - f10 - f01 + f11;
      const double x = (f00 - f01) / k;
      const double y = (f00 - f10) / k;
      if (!is_inside(x) || !is_inside(y)) continue;
      CriticalPoint point;
      point.uvw[axis] = static_cast<double>(side);
      point.uvw[u] = x;
      point.uvw[v] = y;
      point.value = trilinear_value(corners, point.uvw);
      point.face = static_cast<int>(2 * axis + side);
      points.push_back(point);
    }
  }
}

// With g = ... + b x + c y + d z + e xy + f yz + k xz + h xyz and the origin moved to (-f/h, -k/h, -e/h), g has only
// the terms A X + B Y + C Z + h XYZ; its gradient vanishes where YZ = -A/h, XZ = -B/h, XY = -C/h. Without the last term
// the gradient is linear.
void append_body_saddles(const CellCorners& g, std::vector<CriticalPoint>& points) {
  const double b = g[1] - g[0];
  const double c = g[2] - g[0];
  const double d = g[4] - g[0];
  const double e = g[3] - g[1] - c;
  const double f = g[6] - g[4] - c;
  const double k = g[5] - g[4] - b;
  const double h = g[7] - g[6] - g[5] + g[4] - (g[3] - g[2] - g[1] + g[0]);
  const auto append = [&](const Vec3& uvw) {
    if (is_inside(uvw.x) && is_inside(uvw.y) && is_inside(uvw.z)) points.push_back({uvw, trilinear_value(g, uvw), -1});
  };
  if (h == 0) {
    const double half = -0.5 * (b * f + c * k + d * e);
    append({(half + b * f) / (e * k), (half + c * k) / (e * f), (half + d * e) / (f * k)});
    return;
  }
  const double big_a = b - e * k / h;
  const double big_b = c - e * f / h;
  const double big_c = d - f * k / h;
  const double squared_x = -big_b * big_c / (big_a * h);
  if (!(squared_x > 0) || !std::isfinite(squared_x)) return;
  for (const double side : {-1.0, 1.0}) {
    const double x = side * std::sqrt(squared_x);
    append({x - f / h, -big_c / (h * x) - k / h, -big_b / (h * x) - e / h});
  }
}

}  // namespace

void append_critical_points(const CellCorners& corners, std::vector<CriticalPoint>& points) {
  append_face_saddles(corners, points);
  append_body_saddles(corners, points);
}

int side_of_saddle(const CellCorners& corners, double isovalue, const CriticalPoint& saddle) {
  if (saddle.face < 0) {
    double scale = 0;
    for (const double value : corners) scale = std::max(scale, std::abs(value - isovalue));
    const double height = saddle.value - isovalue;
    return std::abs(height) <= kRounding * scale ? 0 : height > 0 ? 1 : -1;
  }
  // On a face the saddle's height is (f0 f2 - f1 f3) / (f0 - f1 + f2 - f3), corners in circular order, less the
  // isovalue.
  const std::array<int, 4> c = face_corners(saddle.face);
  const auto corner = [&](std::size_t i) { return corners[static_cast<std::size_t>(c[i])]; };
  const int determinant = exact_sign([&](const auto& kind) {
    using Number = std::decay_t<decltype(kind)>;
    const auto f = [&](std::size_t i) { return Number::difference(corner(i), isovalue); };
    return f(0) * f(2) - f(1) * f(3);
  });
  return (corner(0) - corner(1)) + (corner(2) - corner(3)) > 0 ? determinant : -determinant;
}

bool is_critical_sample(const ScalarGrid& grid, const std::array<std::int32_t, 3>& sample) {
  const double value = grid.at(sample[0], sample[1], sample[2]);
  std::array<std::size_t, 2> count{};      // neighbours below and above
  std::array<std::size_t, 2> axis_bits{};  // a bit for each axis that holds one of them; two opposite ones cancel
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::int32_t step : {-1, 1}) {
      std::array<std::int32_t, 3> at = sample;
      at[axis] += step;
      if (at[axis] < 0 || at[axis] >= grid.dims()[axis]) continue;
      const double there = grid.at(at[0], at[1], at[2]);
      const std::size_t side = there > value || (there == value && step > 0) ? 1 : 0;
      ++count[side];
      axis_bits[side] ^= std::size_t{1} << axis;
    }
  }
  for (std::size_t side = 0; side < 2; ++side) {
    if (count[side] == 0 || (count[side] == 2 && axis_bits[side] == 0)) return true;
  }
  return false;
}

}  // namespace deliso

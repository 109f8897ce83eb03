#include "volume/critical_points.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "volume/trilinear_cell.h"

namespace deliso {

namespace {

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
    if (is_inside(uvw.x) && is_inside(uvw.y) && is_inside(uvw.z)) points.push_back({uvw, trilinear_value(g, uvw)});
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

}  // namespace deliso

#include "raycast/voxel_intersection.h"

namespace deliso {

BernsteinCubic restrict_to_segment(const CellCorners& f, const Vec3& a, const Vec3& b) {
  // Interpolate along x, then y, then z, each at a (0) and at b (1), in the order of trilinear_value.
  std::array<double, 8> at_x;
  for (std::size_t i = 0; i < 4; ++i) {
    at_x[i] = interpolate(f[2 * i], f[2 * i + 1], a.x);
    at_x[i + 4] = interpolate(f[2 * i], f[2 * i + 1], b.x);
  }
  std::array<double, 8> at_xy;
  for (std::size_t i = 0; i < 4; ++i) {
    at_xy[i] = interpolate(at_x[2 * i], at_x[2 * i + 1], a.y);
    at_xy[i + 4] = interpolate(at_x[2 * i], at_x[2 * i + 1], b.y);
  }
  std::array<double, 8> g;  // bit 0: x, bit 1: y, bit 2: z from b
  for (std::size_t i = 0; i < 4; ++i) {
    g[i] = interpolate(at_xy[2 * i], at_xy[2 * i + 1], a.z);
    g[i + 4] = interpolate(at_xy[2 * i], at_xy[2 * i + 1], b.z);
  }
  return {g[0], (g[1] + g[2] + g[4]) / 3, (g[3] + g[5] + g[6]) / 3, g[7]};
}

SignChanges voxel_intersection(const CellCorners& relative, const Vec3& a, const Vec3& b, CubicSolver solver,
                               bool& starts_above) {
  const BernsteinCubic cubic = restrict_to_segment(relative, a, b);
  starts_above = cubic[0] >= 0;
  return solver == CubicSolver::kBracketed ? bracketed_sign_changes(cubic) : schwarze_sign_changes(cubic);
}

}  // namespace deliso

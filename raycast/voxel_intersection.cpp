#include "raycast/voxel_intersection.h"

namespace deliso {

BernsteinCubic restrict_to_segment(const CellCorners& f, const Vec3& a, const Vec3& b) {
  // Interpolate along z, then y, then x, each at a (first half) and at b (second half).
  std::array<double, 8> at_z;
  for (std::size_t i = 0; i < 4; ++i) at_z[i] = blend(f[i], f[i + 4], a.z);
  for (std::size_t i = 0; i < 4; ++i) at_z[i + 4] = blend(f[i], f[i + 4], b.z);
  std::array<double, 8> at_yz;  // bit 0: x, bit 1: z from b, bit 2: y from b
  for (std::size_t z = 0; z < 8; z += 4)
    for (std::size_t x = 0; x < 2; ++x) {
      at_yz[z / 2 + x] = blend(at_z[z + x], at_z[z + x + 2], a.y);
      at_yz[z / 2 + x + 4] = blend(at_z[z + x], at_z[z + x + 2], b.y);
    }
  std::array<double, 4> at_a;  // bit 0: z from b, bit 1: y from b
  std::array<double, 4> at_b;
  for (std::size_t i = 0; i < 4; ++i) {
    at_a[i] = blend(at_yz[2 * i], at_yz[2 * i + 1], a.x);
    at_b[i] = blend(at_yz[2 * i], at_yz[2 * i + 1], b.x);
  }
  constexpr double kThird = 1.0 / 3;
  return {at_a[0], (at_b[0] + at_a[1] + at_a[2]) * kThird, (at_b[1] + at_b[2] + at_a[3]) * kThird, at_b[3]};
}

SignChanges voxel_intersection(const CellCorners& relative, const Vec3& a, const Vec3& b, CubicSolver solver,
                               bool& starts_above) {
  const BernsteinCubic cubic = restrict_to_segment(relative, a, b);
  starts_above = cubic[0] >= 0;
  return solver == CubicSolver::kBracketed ? bracketed_sign_changes(cubic) : schwarze_sign_changes(cubic);
}

}  // namespace deliso

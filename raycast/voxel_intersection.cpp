#include "raycast/voxel_intersection.h"

#include "delaunay/base/pair.h"

namespace deliso {

BernsteinCubic restrict_to_segment(const CellCorners& f, const Vec3& a, const Vec3& b) {
  // Interpolate along z, then y, then x, each at a and at b. In each pair, the first value uses z from a, the second z
  // from b.
  const auto both = [](double s) { return Pair{s, s}; };
  const auto blend_pairs = [](const Pair& at0, const Pair& at1, const Pair& t) { return (1 - t) * at0 + t * at1; };
  const Pair az_bz = {a.z, b.z};
  std::array<Pair, 4> at_z;  // bit 0: x, bit 1: y
  for (std::size_t i = 0; i < 4; ++i) at_z[i] = blend_pairs(both(f[i]), both(f[i + 4]), az_bz);
  const auto at_y = [&](std::size_t x, double y) { return blend_pairs(at_z[x], at_z[x + 2], both(y)); };
  const std::array<Pair, 2> at_ay = {at_y(0, a.y), at_y(1, a.y)}, at_by = {at_y(0, b.y), at_y(1, b.y)};
  const Pair at_ax_ay = blend_pairs(at_ay[0], at_ay[1], both(a.x)),
             at_ax_by = blend_pairs(at_by[0], at_by[1], both(a.x));
  const Pair at_bx_ay = blend_pairs(at_ay[0], at_ay[1], both(b.x)),
             at_bx_by = blend_pairs(at_by[0], at_by[1], both(b.x));
  constexpr double kThird = 1.0 / 3;
  return {at_ax_ay[0], (at_bx_ay[0] + at_ax_ay[1] + at_ax_by[0]) * kThird,
          (at_bx_ay[1] + at_bx_by[0] + at_ax_by[1]) * kThird, at_bx_by[1]};
}

SignChanges voxel_intersection(const CellCorners& relative, const Vec3& a, const Vec3& b, CubicSolver solver,
                               bool& starts_above) {
  const BernsteinCubic cubic = restrict_to_segment(relative, a, b);
  starts_above = cubic[0] >= 0;
  return solver == CubicSolver::kBracketed ? bracketed_sign_changes(cubic) : schwarze_sign_changes(cubic);
}

}  // namespace deliso

// The circumcenters of two tetrahedra with a common vertex, computed side by side: the tetrahedra of a star are handled
// two at a time, so that their divisions overlap.
#pragma once

#include <algorithm>
#include <array>

#include "delaunay/base/pair.h"
#include "delaunay/base/vec3.h"
#include "delaunay/lifted_rows.h"

namespace deliso {

// Lifted rows of two points.
struct RowPair {
  Pair x, y, z, w;

  RowPair(const LiftedRow& first, const LiftedRow& second)
      : x{first.xy[0], second.xy[0]},
        y{first.xy[1], second.xy[1]},
        z{first.zw[0], second.zw[0]},
        w{first.zw[1], second.zw[1]} {}
};

// Two vectors.
struct Vec3Pair {
  Pair x, y, z;
  [[nodiscard]] Vec3 at(unsigned i) const { return {x[i], y[i], z[i]}; }
};

inline Vec3Pair cross(const RowPair& a, const RowPair& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct CircumcenterPair {
  Vec3Pair centers;
  std::array<bool, 2> is_certain;  // if false, the center is meaningless
};

// b, c and d: the other vertices of two positively oriented tetrahedra abcd, relative to a. A center that is certain is
// circumcenter(a, b, c, d) to the last bit.
inline CircumcenterPair circumcenter_pair(const Vec3& a, const RowPair& b, const RowPair& c, const RowPair& d) {
  // The same operations in the same order; the determinant shares its minors with the cross products.
  const Vec3Pair cd = cross(c, d), db = cross(d, b), bc = cross(b, c);
  const Vec3Pair numerator = {b.w * cd.x + c.w * db.x + d.w * bc.x, b.w * cd.y + c.w * db.y + d.w * bc.y,
                              b.w * cd.z + c.w * db.z + d.w * bc.z};
  const Pair det = b.z * cd.z + c.z * db.z + d.z * bc.z;
  const auto magnitude = [](const Pair& s) { return s < 0 ? -s : s; };
  const auto greater = [](const Pair& s, const Pair& t) { return s < t ? t : s; };
  const Pair size = greater(greater(magnitude(numerator.x), magnitude(numerator.y)), magnitude(numerator.z));
  const Pair length = size / (2 * det);
  const Pair ax{a.x, a.x}, ay{a.y, a.y}, az{a.z, a.z};
  CircumcenterPair result{
      {ax + length * (numerator.x / size), ay + length * (numerator.y / size), az + length * (numerator.z / size)}, {}};
  // orient3d accepts its first stage when its permanent is below 2^-20 / (7.1 u) of the determinant. The permanent is
  // at most 6 / sqrt(27) times the lengths of the three rows (Carlen, Lieb, Loss, 2006): compare squares, guarded
  // against underflow. Then the center is not far off, either.
  constexpr double kRelative = 0x1p20 * 8 * 0x1p-53 * 1.1548;
  const Pair bound = kRelative * kRelative * (b.w * c.w * d.w) + 0x1p-960;
  for (unsigned i = 0; i < 2; ++i) result.is_certain[i] = det[i] * det[i] > bound[i] && size[i] > 0;
  return result;
}

}  // namespace deliso

// The first stage of both predicates where a box of all points is known. It is inlined into walk and cavity search.
#pragma once

#include <algorithm>

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"
#include "delaunay/determinants.h"
#include "delaunay/predicates.h"

namespace deliso {

// Filtered predicates. Only the signs of their values are meaningful.
class StaticFilter {
 public:
  // All later points must lie in `box`.
  explicit StaticFilter(const Box3& box) {
    // |det| of differences inside the box is off by at most (7 + 56 u) u times its permanent, and that is at most
    // 6 width height depth. (The sizes are rounded: hence the 1 + 2^-20.)
    const Vec3 size = box.size();
    orient_bound_ = (7 + 0x1p-20) * 0x1p-53 * 6 * size.x * size.y * size.z * (1 + 0x1p-20);
  }

  // The sign of orient3d.
  [[nodiscard]] double orient(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) const {
    const double det = determinant3(row(b, a), row(c, a), row(d, a));
    if (det > orient_bound_ || det < -orient_bound_) [[likely]] {
      return det;
    }
    return orient3d(a, b, c, d);
  }

  // The sign of insphere.
  [[nodiscard]] static double insphere_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& e) {
    const Row<double> ea = row(a, e);
    const Row<double> eb = row(b, e);
    const Row<double> ec = row(c, e);
    const Row<double> ed = row(d, e);
    const double det = insphere_determinant(ea, eb, ec, ed);
    // The permanent of three rows is at most 6 / sqrt(27) times the product of their lengths (Carlen, Lieb, Loss: An
    // inequality of Hadamard type for permanents, 2006). So det is off by at most (16 + 224 u) u 4 * 1.1548 times the
    // product of the four lengths and the greatest length: compare the squares, guarded against underflow.
    const double a_lift = lift(ea);
    const double b_lift = lift(eb);
    const double c_lift = lift(ec);
    const double d_lift = lift(ed);
    const double greatest = std::max(std::max(a_lift, b_lift), std::max(c_lift, d_lift));
    constexpr double kRelative = (16 + 0x1p-20) * 0x1p-53 * 4 * 1.1548;
    if (det * det > kRelative * kRelative * ((a_lift * b_lift) * (c_lift * d_lift)) * greatest + 0x1p-960) [[likely]] {
      return det;
    }
    return insphere(a, b, c, d, e);
  }

 private:
  static Row<double> row(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  static double lift(const Row<double>& a) { return a.x * a.x + a.y * a.y + a.z * a.z; }

  double orient_bound_ = 0;
};

}  // namespace deliso

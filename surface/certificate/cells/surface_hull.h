// A convex body that holds the isosurface of a box within a cell.
#pragma once

#include <array>
#include <cstddef>

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"
#include "volume/trilinear_cell.h"

namespace deliso {

inline Vec3 corner_of(const Box3& box, unsigned i) {
  return {((i & 1u) != 0 ? box.high : box.low).x, ((i & 2u) != 0 ? box.high : box.low).y,
          ((i & 4u) != 0 ? box.high : box.low).z};
}

// A box within a cell (of the unit cube), and the field at its corners less the isovalue, in the order of corner_of().
struct PartOfCell {
  Box3 box;
  CellCorners values;
};

// The field is a linear function in a part, give or take at most what its mixed terms are at the corners, so the
// isosurface is where the linear function is that small.
class SurfaceHull {
 public:
  explicit SurfaceHull(const PartOfCell& part);

  // The corners, in the cell; none where values are too large to be added.
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] Vec3* begin() { return corners_.data(); }
  [[nodiscard]] Vec3* end() { return corners_.data() + count_; }
  [[nodiscard]] const Vec3* begin() const { return corners_.data(); }
  [[nodiscard]] const Vec3* end() const { return corners_.data() + count_; }
  // Half of what the linear function rises by over the part, along each axis.
  [[nodiscard]] const Vec3& rise() const { return rise_; }

 private:
  void add(const Vec3& p) { corners_.at(count_++) = p; }

  std::array<Vec3, 32> corners_;
  std::size_t count_ = 0;
  Vec3 rise_;
};

}  // namespace deliso

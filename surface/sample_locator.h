// Which tetrahedra hold the samples of the grid, for callers that come back to the same sample again and again.
//
// A walk to a point strictly inside a tetrahedron ends there wherever it begins, so that tetrahedron can be remembered.
// Where a point lies on a facet the walk decides, as ever.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "surface/signed_delaunay.h"
#include "volume/scalar_grid.h"

namespace deliso {

class SampleLocator {
 public:
  // Keeps references.
  SampleLocator(const SignedDelaunay& restricted, const ScalarGrid& grid);

  // The tetrahedron that SignedDelaunay::locate finds from `hint` for a sample of the grid.
  TetId locate(const std::array<std::int32_t, 3>& sample, TetId hint) { return locate_settled(sample, hint).tet; }
  // The same, and whether it is the same from every hint: the sample lies strictly inside the tetrahedron.
  struct Located {
    TetId tet;
    bool is_settled = false;
  };
  Located locate_settled(const std::array<std::int32_t, 3>& sample, TetId hint);
  // For any point.
  [[nodiscard]] Located locate_settled(const Vec3& p, TetId hint) const {
    const TetId t = restricted_.locate(p, hint);
    return {t, is_strictly_inside(t, p)};
  }
  // Whether that is the same from every hint: the sample lies strictly inside tetrahedron t, where it was found.
  [[nodiscard]] bool is_settled(const std::array<std::int32_t, 3>& sample, TetId t) const {
    return is_strictly_inside(t, place(sample));
  }

 private:
  static constexpr unsigned kBits = 15;
  struct Known {
    std::size_t sample = std::numeric_limits<std::size_t>::max();  // its index in the grid
    TetId tet;                                                     // it lies strictly inside
  };
  [[nodiscard]] Vec3 place(const std::array<std::int32_t, 3>& sample) const {
    return scaled({static_cast<double>(sample[0]), static_cast<double>(sample[1]), static_cast<double>(sample[2])},
                  restricted_.isosurface().step());
  }
  [[nodiscard]] bool is_strictly_inside(TetId t, const Vec3& p) const;

  const SignedDelaunay& restricted_;
  const ScalarGrid& grid_;
  std::vector<Known> known_;  // by a hash of the index; the latest of each hash
};

}  // namespace deliso

// Which tetrahedra hold the samples of the grid, for callers that come back to the same sample again and again.
//
// A walk that ends in a finite tetrahedron ends there wherever it begins, so that tetrahedron can be remembered. Which
// of several ghosts it ends in the walk decides.
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
  TetId locate(const std::array<std::int32_t, 3>& sample, TetId hint);

 private:
  static constexpr unsigned kBits = 15;
  struct Known {
    std::size_t sample = std::numeric_limits<std::size_t>::max();  // its index in the grid
    TetId tet;                                                     // finite
  };
  [[nodiscard]] Vec3 place(const std::array<std::int32_t, 3>& sample) const {
    return scaled({static_cast<double>(sample[0]), static_cast<double>(sample[1]), static_cast<double>(sample[2])},
                  restricted_.isosurface().step());
  }

  const SignedDelaunay& restricted_;
  const ScalarGrid& grid_;
  std::vector<Known> known_;  // by a hash of the index; the latest of each hash
};

}  // namespace deliso

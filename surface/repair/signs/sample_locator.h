// Which tetrahedra hold the samples of the grid, for callers that come back to the same sample again and again.
//
// A walk that ends in a finite tetrahedron ends there wherever it begins, so that tetrahedron can be remembered; and it
// is near when the sample is looked for from another cell. Which of several ghosts a walk ends in the walk decides.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "surface/restricted/signed_delaunay.h"
#include "volume/scalar_grid.h"

namespace deliso {

class SampleLocator {
 public:
  // Keeps references.
  SampleLocator(const SignedDelaunay& restricted, const ScalarGrid& grid);

  // The tetrahedron that SignedDelaunay::locate finds from `hint` for the sample at a corner of a cell, inwards to the
  // cell's center. Bit 0 of a corner is x, bit 1 y, bit 2 z.
  TetId locate(const std::array<std::int32_t, 3>& cell, unsigned corner, TetId hint);

 private:
  static constexpr unsigned kBits = 14;
  struct Known {
    std::size_t sample = std::numeric_limits<std::size_t>::max();  // its index in the grid
    unsigned corner = 0;
    TetId tet;  // finite
  };

  const SignedDelaunay& restricted_;
  const ScalarGrid& grid_;
  std::vector<Known> known_;  // by a hash of the index; the latest of each hash
};

}  // namespace deliso

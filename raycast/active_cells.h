// One bit per voxel cell: does it hold the isovalue?
//
// Made once for an isovalue. Bits are grouped in bricks of 4 x 4 x 4 cells, one 64-bit word each, and eight bricks make
// a cache line of 8 x 8 x 8 cells: a ray of a few cells touches one or two lines.
#pragma once

#include <cstdint>
#include <vector>

#include "raycast/cell_walk.h"
#include "volume/scalar_grid.h"

namespace deliso {

class ActiveCells {
 public:
  // Works on extended cells (see cell_walk.h): the outer ones are active when the face of the box they continue is
  // crossed. Precondition: no sample equals `isovalue`.
  ActiveCells(const ScalarGrid& grid, double isovalue);

  // The 64 cells of a cell's brick.
  [[nodiscard]] std::uint64_t brick(const Cell& cell) const { return words_[word_index(cell)]; }
  [[nodiscard]] static std::uint64_t bit(const Cell& cell) {
    return std::uint64_t{1} << ((cell[0] & 3) | ((cell[1] & 3) << 2) | ((cell[2] & 3) << 4));
  }
  [[nodiscard]] bool is_active(const Cell& cell) const { return (brick(cell) & bit(cell)) != 0; }
  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] std::size_t bytes() const { return words_.size() * sizeof(std::uint64_t); }

 private:
  [[nodiscard]] std::size_t word_index(const Cell& cell) const {
    const auto x = static_cast<std::size_t>(cell[0]);
    const auto y = static_cast<std::size_t>(cell[1]);
    const auto z = static_cast<std::size_t>(cell[2]);
    const std::size_t line = (x >> 3) + lines_x_ * ((y >> 3) + lines_y_ * (z >> 3));
    return 8 * line + (((x >> 2) & 1) | ((y >> 1) & 2) | (z & 4));
  }

  std::size_t lines_x_ = 0;
  std::size_t lines_y_ = 0;
  std::vector<std::uint64_t> words_;
};

}  // namespace deliso

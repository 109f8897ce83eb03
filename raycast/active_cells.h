// One bit per voxel cell: does it hold the isovalue?
//
// Made once for an isovalue. Bits are grouped in bricks of 4 x 4 x 4 cells, one 64-bit word each, and eight bricks make
// a cache line of 8 x 8 x 8 cells: a ray of a few cells touches one or two lines.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/base/huge_pages.h"
#include "raycast/cell_walk.h"
#include "volume/scalar_grid.h"

namespace deliso {

class ActiveCells {
 public:
  // Works on extended cells (see cell_walk.h): the outer ones are active when the face of the box they continue is
  // crossed. Precondition: no sample equals `isovalue`. The same for any number of threads.
  ActiveCells(const ScalarGrid& grid, double isovalue, int threads = 1);

  [[nodiscard]] bool is_active(const Cell& cell) const {
    const std::size_t place = place_of(cell);
    return ((words_[place / 64] >> (place % 64)) & 1) != 0;
  }
  // Tells the processor that a cell's bit will be read soon.
  void prefetch(const Cell& cell) const { __builtin_prefetch(&words_[place_of(cell) / 64]); }
  // The bits of the brick of 4 x 4 x 4 cells that holds a cell.
  [[nodiscard]] std::uint64_t brick(const Cell& cell) const { return words_[place_of(cell) / 64]; }
  // Is a cell active in the box from `low` to `high`, both inclusive?
  [[nodiscard]] bool any_active(const Cell& low, const Cell& high) const;
  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] std::size_t bytes() const { return words_.size() * sizeof(std::uint64_t); }

 private:
  void deal_out(const std::vector<std::uint64_t>& active, std::int32_t y, std::int32_t z);
  // The number of a cell's bit: every coordinate contributes on its own.
  [[nodiscard]] std::size_t place_of(const Cell& cell) const {
    return places_[0][static_cast<std::size_t>(cell[0])] + places_[1][static_cast<std::size_t>(cell[1])] +
           places_[2][static_cast<std::size_t>(cell[2])];
  }

  [[nodiscard]] bool any_active_of_eight(const Cell& low, const Cell& high) const;
  [[nodiscard]] bool any_active_of_many(const Cell& low, const Cell& high) const;

  std::array<std::vector<std::size_t>, 3> places_;
  UnwrittenArray<std::uint64_t> words_;
};

}  // namespace deliso

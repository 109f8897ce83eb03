// The refined voxel cells: those that repair samples by a lattice, each at a level of the lattice.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "raycast/isosurface.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// A cell's number: the linear index of its lowest sample.
using CellName = std::uint64_t;

class CellLevels {
 public:
  // Keeps a reference.
  explicit CellLevels(const Isosurface& isosurface) : grid_(isosurface.grid()), isosurface_(isosurface) {}

  [[nodiscard]] const Dims& dims() const { return grid_.dims(); }
  [[nodiscard]] CellName name(const CellIndex& c) const { return grid_.index(c[0], c[1], c[2]); }
  [[nodiscard]] CellIndex cell(CellName name) const;
  // The cell that holds a point of mesh space; for a point beyond the box the nearest cell.
  [[nodiscard]] CellIndex cell_of(const Vec3& p) const;
  // All cells that hold a point, sides included (within 1e-6 of the cell's size).
  void append_cells_of(const Vec3& p, std::vector<CellName>& cells) const;

  // Appends the active cells of the box from cell `low` to cell `high`, inclusive; the box may exceed the volume.
  void append_active_cells(const CrossingIndex& index, const CellIndex& low, const CellIndex& high,
                           std::vector<CellName>& cells) const;

  // Refines each of the cells by one level, up to the lattice's highest. The neighbours of a cell at level 3 or more
  // are then refined to within one level of it. `cells` may repeat names.
  void refine(std::vector<CellName> cells);
  [[nodiscard]] bool is_refined(CellName cell) const { return level_.contains(cell); }
  // The level of each refined cell, by name.
  [[nodiscard]] const std::map<CellName, int>& levels() const { return level_; }

  // By name: whether a cell is refined or in the ring of cells around a refined one.
  [[nodiscard]] std::vector<bool> zone() const;

 private:
  void grade();
  template <class Visit>
  void for_each_neighbour(const CellIndex& cell, Visit visit) const;

  const ScalarGrid& grid_;
  const Isosurface& isosurface_;
  std::map<CellName, int> level_;
};

}  // namespace deliso

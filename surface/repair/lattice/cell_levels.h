// Voxel cells that repair samples by a lattice, each at a level of the lattice.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_set>
#include <vector>

#include "raycast/isosurface.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// The linear index of a cell's lowest sample names it.
using CellName = std::uint64_t;

class CellLevels {
 public:
  // Keeps a reference.
  explicit CellLevels(const Isosurface& isosurface) : grid_(isosurface.grid()), isosurface_(isosurface) {}

  [[nodiscard]] const Dims& dims() const { return grid_.dims(); }
  [[nodiscard]] CellName name(const CellIndex& c) const { return grid_.index(c[0], c[1], c[2]); }
  [[nodiscard]] CellIndex cell(CellName name) const;
  // The cell that holds a point of mesh space; points beyond the box count to the nearest cell.
  [[nodiscard]] CellIndex cell_of(const Vec3& p) const;
  // All cells that hold a point, sides included (within 1e-6 of the cell's size).
  void append_cells_of(const Vec3& p, std::vector<CellName>& cells) const;

  // All active cells of the box from one cell to another, as far as it lies in the volume.
  void append_active_cells(const CrossingIndex& index, const CellIndex& low, const CellIndex& high,
                           std::vector<CellName>& cells) const;

  // Raises each of the cells one level, up to the lattice's highest; from level 3 on the neighbours of a cell are
  // brought within one level of it. `cells` may repeat names.
  void raise(std::vector<CellName> cells);
  [[nodiscard]] bool is_raised(CellName cell) const { return level_.contains(cell); }
  // Level of each raised cell, by name.
  [[nodiscard]] const std::map<CellName, int>& levels() const { return level_; }

  // The raised cells, and with the ring of cells around them, at some time.
  struct Zone {
    std::unordered_set<CellName> raised, cells;
  };
  // Brings a zone up to date. Returns the cells that have come to it.
  std::vector<CellName> extend(Zone& zone) const;

 private:
  void grade();
  template <class Visit>
  void for_each_neighbour(const CellIndex& cell, Visit visit) const;

  const ScalarGrid& grid_;
  const Isosurface& isosurface_;
  std::map<CellName, int> level_;
};

}  // namespace deliso

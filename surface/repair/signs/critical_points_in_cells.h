// Saddles and critical samples of the field, and the tetrahedra that hold them.
//
// The topology of the isosurface is decided at these points, and the side of each is known exactly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/restricted/signed_delaunay.h"
#include "volume/topology/crossing_index.h"

namespace deliso {

struct CriticalPointInCell {
  Vec3 point;              // in mesh space
  std::uint32_t cell = 0;  // of those asked for, the one in which it was found; a sample is found in each of its cells
  bool is_above = false;
};

// The points of some cells, cell by cell. The same for any number of threads, as is the next.
std::vector<CriticalPointInCell> critical_points_in(std::span<const CellIndex> cells, const Isosurface& isosurface,
                                                    int threads);
// The tetrahedra that hold these points, each in the direction of its cell's center.
std::vector<TetId> tets_at(std::span<const CriticalPointInCell> points, std::span<const CellIndex> cells,
                           const SignedDelaunay& restricted, int threads);

}  // namespace deliso

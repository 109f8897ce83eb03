// Lattice samples: points of the isosurface that determine it up to topology as the lattice gets finer.
//
// The interpolant g is linear along axis-parallel lines within a cell. So the crossings of such lines are exact, and a
// line through a thin sheet crosses it on both sides. Where random points of the surface do not determine the topology,
// these points do.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/base/vec3.h"
#include "surface/base/exact_surface.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// A point of the isosurface in index space. Equal keys mean the same point, bit by bit, from whichever cell it was
// computed.
struct LatticeSample {
  std::uint64_t key = 0;  // never 0
  Vec3 point;
};

inline constexpr int kMaxLatticeLevel = 5;

class SampleLattice {
 public:
  // Keeps references.
  explicit SampleLattice(const ExactSurface& surface);

  // Appends the samples of one cell at a level. Level 1: the crossings of its grid edges, and of lines that cut it into
  // its pieces (cell_pieces.h). Level 2: also a point inside each arc on its faces, and the saddles of the surface in
  // the cell. Levels 3, 4, 5: also the crossings of the axis-parallel lines at multiples of 1/2, 1/4, 1/8 of a piece.
  void append(const CellIndex& cell, int level, std::vector<LatticeSample>& samples) const;

 private:
  void append_lines(const CellIndex& cell, int parts_of_piece, std::vector<LatticeSample>& samples) const;
  void append_arcs(const CellIndex& cell, std::vector<LatticeSample>& samples) const;
  void append_saddles(const CellIndex& cell, std::vector<LatticeSample>& samples) const;
  [[nodiscard]] Vec3 arc_point(const FaceArc& arc) const;

  const ScalarGrid& grid_;
  double isovalue_;
  const IsosurfaceTopology& topology_;
  std::array<std::int32_t, 3> pieces_;  // of a cell
};

}  // namespace deliso

// The exact topology of an isosurface of the trilinear interpolant, found from the grid without a mesh.
//
// Within a cell, sweep w from 0 to 1: the slice is bilinear and holds 0, 1 or 2 arcs, each named by the cell sides it
// crosses; it changes only at roots on vertical edges and at saddles of ambiguous slices. Arcs between events are edges
// and event slices are nodes of a small graph, whose Euler characteristic is that of the cell's surface piece
// (cell_sweep.h). Pieces join through the grid-edge crossings they share. Linear time, exact for a regular
// isovalue: all decisions are exact signs of polynomials in the samples.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"
#include "volume/topology/crossing_index.h"

namespace deliso {

// (euler_characteristic, boundary_loops) classifies a connected orientable surface up to homeomorphism.
struct ComponentTopology {
  std::int64_t euler_characteristic = 0;
  std::int64_t boundary_loops = 0;
  friend bool operator==(const ComponentTopology&, const ComponentTopology&) = default;
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the defaulted comparison for a null pointer
  friend auto operator<=>(const ComponentTopology&, const ComponentTopology&) = default;
};

// A point of the surface inside a cell where the slice w = const has a saddle: two sheets nearly meet there, or a
// tunnel begins.
struct SurfaceSaddle {
  CellIndex cell{};
  Vec3 position;  // in index space, rounded
  std::uint32_t component = 0;
};

struct IsosurfaceTopology {
  std::vector<ComponentTopology> components;  // numbered by their first crossing in (sample, axis) order
  UnwrittenArray<EdgeCrossing> crossings;     // in (sample, axis) order; every component has at least one
  CrossingIndex index;                        // index.find(i, j, k, axis) is an index into `crossings`
  std::vector<SurfaceSaddle> saddles;         // by cell, x fastest
  // Cells in which, or on whose faces, the surface has a singular point although no sample equals the isovalue: the
  // isovalue is that of a saddle inside the cell, of a saddle of a face on the box, or of a saddle where two sheets
  // touch. The surface is no manifold there, and the components are those of a nearby field.
  std::vector<CellIndex> singular_cells;
};

// Precondition: no sample equals `isovalue` (see regular_isovalue), and it is finite. The same for any number of
// threads.
IsosurfaceTopology exact_topology(const ScalarGrid& grid, double isovalue, int threads = 1);

// The exact topology at a regular isovalue: `isovalue` itself or, when a sample or a saddle has that value, a slightly
// lower one (regular_isovalue, lowered_isovalue). singular_cells is empty unless three lowerings did not help.
struct RegularTopology {
  double isovalue = 0;
  IsosurfaceTopology topology;
};
RegularTopology regular_topology(const ScalarGrid& grid, double isovalue, int threads = 1);

// The exact component on which a point of the surface lies, given in index space and rounded. Points within 1e-13 of a
// crossed grid edge, or of a grid face that the surface meets, are looked up on it; others in the slice of their cell.
// Nothing when no cell at the point meets the surface. Constant time.
std::optional<std::uint32_t> component_of(const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology,
                                          const Vec3& point);

// An arc in which the surface meets a grid face. The face has its lowest corner at `corner` and lies across `axis`.
struct FaceArc {
  std::array<std::uint32_t, 2> crossings{};  // indices into IsosurfaceTopology::crossings
  CellIndex corner{};
  std::uint8_t axis = 0;
};

// The arcs on one grid face: at most two.
struct FaceArcs {
  int count = 0;
  std::array<FaceArc, 2> arcs;
};
FaceArcs face_arcs(const ScalarGrid& grid, double isovalue, const CrossingIndex& index, const CellIndex& corner,
                   int axis);

}  // namespace deliso

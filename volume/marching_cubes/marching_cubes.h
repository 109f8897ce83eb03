// Marching cubes with the topology of the trilinear interpolant: the baseline that Delaunay meshing is compared with.
//
// One vertex per grid-edge crossing. In every cell the arcs on its faces (asymptotic decider; Nielson and Hamann 1991)
// close to loops. The exact pieces of the surface in the cell (cell_sweep.h) say which loops bound a disk, and which
// two loops bound a tunnel (Chernyaev 1995). All decisions are the exact ones of exact_topology, so the mesh is
// homeomorphic to the isosurface. If exact tests are given, no triangles meet beyond what they share, except at
// crossings that are rounded to samples (cell_triangulation.h). Without them some triangles may meet around tunnels.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"
#include "volume/marching_cubes/exact_tests.h"
#include "volume/scalar_grid.h"
#include "volume/topology/crossing_index.h"

namespace deliso {

struct MarchingCubesMesh {
  // In world coordinates. The grid-edge crossings come first, in (sample, axis) order, then points inside cells: around
  // tunnels, and in disks that no chords inside the cell can triangulate. Nearly all of the latter lie on the surface
  // but for rounding.
  std::vector<Vec3> points;
  std::size_t crossing_count = 0;
  // Counterclockwise seen from the side of lower values. A closed manifold up to the box.
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Precondition: no sample equals `isovalue` (see regular_isovalue), and it is finite.
MarchingCubesMesh marching_cubes(const ScalarGrid& grid, double isovalue, const ExactTests* tests = nullptr);
// The same for callers that already have the index of the crossings and their list (list_crossings).
MarchingCubesMesh marching_cubes(const ScalarGrid& grid, double isovalue, const CrossingIndex& index,
                                 std::span<const EdgeCrossing> crossings, const ExactTests* tests = nullptr);
// The same without the triangles of some cells.
MarchingCubesMesh marching_cubes(const ScalarGrid& grid, double isovalue, const CrossingIndex& index,
                                 std::span<const EdgeCrossing> crossings, const ExactTests* tests,
                                 const std::function<bool(const CellIndex&)>& is_left_out);

}  // namespace deliso

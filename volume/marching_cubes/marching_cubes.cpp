#include "volume/marching_cubes/marching_cubes.h"

#include <cmath>

#include "delaunay/base/check.h"
#include "volume/marching_cubes/cell_triangulation.h"
#include "volume/topology/crossing_index.h"

namespace deliso {

MarchingCubesMesh marching_cubes(const ScalarGrid& grid, double isovalue, const ExactTests* tests) {
  DELISO_CHECK(std::isfinite(isovalue), "an isovalue is a finite number");
  const CrossingIndex index(grid, isovalue);
  return marching_cubes(grid, isovalue, index, list_crossings(grid, isovalue, index), tests);
}

MarchingCubesMesh marching_cubes(const ScalarGrid& grid, double isovalue, const CrossingIndex& index,
                                 std::span<const EdgeCrossing> crossings, const ExactTests* tests) {
  return marching_cubes(grid, isovalue, index, crossings, tests, [](const CellIndex&) { return false; });
}

MarchingCubesMesh marching_cubes(const ScalarGrid& grid, double isovalue, const CrossingIndex& index,
                                 std::span<const EdgeCrossing> crossings, const ExactTests* tests,
                                 const std::function<bool(const CellIndex&)>& is_left_out) {
  MarchingCubesMesh mesh;
  mesh.points.reserve(crossings.size());
  for (const EdgeCrossing& crossing : crossings) mesh.points.push_back(crossing_position(grid, crossing));
  mesh.crossing_count = mesh.points.size();
  mesh.triangles.reserve(2 * mesh.crossing_count);
  CellTriangulation cells(grid, isovalue, index, crossings, tests);
  index.for_each_active_cell([&](const CellIndex& cell, std::uint8_t pattern) {
    if (is_left_out(cell)) return;
    const MarchingCubesPatch& patch = cells.triangulate(cell, pattern);
    mesh.points.insert(mesh.points.end(), patch.points.begin() + static_cast<std::ptrdiff_t>(patch.crossing_count),
                       patch.points.end());
    for (const auto& [a, b, c] : patch.triangles) {
      mesh.triangles.push_back({patch.vertices[a], patch.vertices[b], patch.vertices[c]});
    }
  });
  for (Vec3& point : mesh.points) point = grid.origin() + scaled(point, grid.spacing());
  return mesh;
}

}  // namespace deliso

#include "surface/polygonized_components.h"

#include <algorithm>
#include <array>

#include "volume/marching_cubes.h"

namespace deliso {

namespace {

// Neighbours of the triangles of a manifold mesh: sides with the same two ends, one run each way.
void link_sides(SurfaceMesh& mesh) {
  struct Side {
    std::uint32_t low, high;
    TriangleSide side;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax({mesh.triangles[t][(i + 1) % 3], mesh.triangles[t][(i + 2) % 3]});
      sides.push_back({low, high, 4 * t + i});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.side < b.side;
  });
  mesh.neighbours.assign(mesh.triangles.size(), {kNoSide, kNoSide, kNoSide});
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side& a = sides[i - 1];
    const Side& b = sides[i];
    if (a.low != b.low || a.high != b.high) continue;
    mesh.neighbours[a.side >> 2][a.side & 3u] = b.side;
    mesh.neighbours[b.side >> 2][b.side & 3u] = a.side;
  }
}

}  // namespace

PolygonizedSurface polygonized_surface(const ScalarGrid& grid, const Isosurface& isosurface,
                                       const IsosurfaceTopology& topology) {
  const MarchingCubesMesh cubes = marching_cubes(grid, isosurface.isovalue());
  PolygonizedSurface surface;

  // A triangle belongs to the component of its crossings; one of inner points alone to that of a triangle beside it.
  std::vector<std::uint32_t>& component = surface.component;
  component.assign(cubes.points.size(), kNoSide);
  for (std::size_t v = 0; v < cubes.crossing_count; ++v) component[v] = topology.crossings[v].component;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& v : cubes.triangles) {
      const auto known = std::find_if(v.begin(), v.end(), [&](std::uint32_t q) { return component[q] != kNoSide; });
      if (known == v.end()) continue;
      for (const std::uint32_t q : v) {
        if (component[q] != kNoSide) continue;
        component[q] = component[*known];
        changed = true;
      }
    }
  }

  const Vec3& step = isosurface.step();
  surface.mesh.points.reserve(cubes.points.size());
  for (std::uint32_t v = 0; v < cubes.points.size(); ++v) {
    Vec3 p = cubes.points[v] - grid.origin();
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] *= step[axis] / grid.spacing()[axis];
    if (v < cubes.crossing_count) p = scaled(crossing_position(grid, topology.crossings[v]), step);
    surface.mesh.points.push_back(p);
  }
  surface.mesh.pole_heights.assign(cubes.points.size(), 1);
  surface.mesh.triangles.assign(cubes.triangles.begin(), cubes.triangles.end());
  link_sides(surface.mesh);
  return surface;
}

}  // namespace deliso

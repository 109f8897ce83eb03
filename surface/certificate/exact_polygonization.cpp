#include "surface/certificate/exact_polygonization.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "surface/intersection/exact_tests.h"
#include "surface/mesh/equal_vertices.h"
#include "surface/mesh/side_adjacency.h"
#include "volume/marching_cubes/marching_cubes.h"

namespace deliso {

ExactPolygonization exact_polygonization(const ExactSurface& exact) {
  ExactPolygonization surface = cubes_without(exact, [](const CellIndex&) { return false; });
  set_side_adjacency(surface.mesh);
  take_strips_off(surface, exact.isosurface);
  return surface;
}

ExactPolygonization cubes_without(const ExactSurface& exact, const std::function<bool(const CellIndex&)>& is_left_out) {
  const IsosurfaceTopology& topology = exact.topology;
  MarchingCubesMesh cubes = marching_cubes(exact.grid(), exact.isosurface.isovalue(), topology.index,
                                           topology.crossings, &kExactTests, is_left_out);
  ExactPolygonization surface;

  // A triangle belongs to the component of its crossings; a triangle with only inner points to that of a neighbouring
  // triangle.
  std::vector<std::uint32_t>& component = surface.component;
  component.assign(cubes.points.size(), kNoSide);
  for (std::size_t v = 0; v < cubes.crossing_count; ++v) component[v] = topology.crossings[v].component;
  std::vector<std::array<std::uint32_t, 3>> with_inner_point;
  std::copy_if(cubes.triangles.begin(), cubes.triangles.end(), std::back_inserter(with_inner_point),
               [&](const auto& v) {
                 return std::max({v[0], v[1], v[2]}) >= cubes.crossing_count;
               });
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& v : with_inner_point) {
      const auto known = std::find_if(v.begin(), v.end(), [&](std::uint32_t q) { return component[q] != kNoSide; });
      if (known == v.end()) continue;
      for (const std::uint32_t q : v) {
        if (component[q] != kNoSide) continue;
        component[q] = component[*known];
        changed = true;
      }
    }
  }

  // From world to mesh space, in place, because there may be many points.
  for (std::uint32_t v = 0; v < cubes.points.size(); ++v) {
    Vec3& p = cubes.points[v];
    p = v < cubes.crossing_count ? exact.position(topology.crossings[v]) : from_world(p, exact.isosurface);
  }
  surface.mesh.points = std::move(cubes.points);
  surface.mesh.pole_heights.assign(surface.mesh.points.size(), 1);
  surface.mesh.triangles = std::move(cubes.triangles);
  return surface;
}

void take_strips_off(ExactPolygonization& surface, const Isosurface& isosurface) {
  if (!isosurface.grid().walls()) return;
  // Taken off, the strips are folds.
  const Box3 box = isosurface.surface_box();
  for (Vec3& p : surface.mesh.points) p = isosurface.settled(box.clamp(p));
  const std::vector<Vec3> places = surface.mesh.points;
  merge_equal_vertices(places, surface.mesh, &surface.component);
  set_side_adjacency(surface.mesh);
}

}  // namespace deliso

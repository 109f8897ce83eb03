#include "surface/polygonized_components.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

#include "surface/blocks.h"
#include "volume/marching_cubes.h"

namespace deliso {

namespace {

// Links the sides of a manifold mesh whose lower end is one of the vertices from `from` to `to` - 1: those with the
// same two ends, one run each way, are neighbours. Sides are put in buckets by their lower end.
void link_sides(SurfaceMesh& mesh, std::uint32_t from, std::uint32_t to) {
  const auto for_each_side = [&](const auto& visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& v = mesh.triangles[t];
      for (unsigned i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(v[(i + 1) % 3], v[(i + 2) % 3]);
        if (from <= low && low < to) visit(low - from, high, 4 * t + i);
      }
    }
  };
  std::vector<std::uint32_t> first(to - from + 2, 0);  // of each bucket, moved on as it is filled
  for_each_side([&](std::uint32_t bucket, std::uint32_t, TriangleSide) { ++first[bucket + 2]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::pair<std::uint32_t, TriangleSide>> sides(first.back());  // (higher end, side)
  for_each_side([&](std::uint32_t bucket, std::uint32_t high, TriangleSide side) {
    sides[first[bucket + 1]++] = {high, side};
  });
  for (std::size_t bucket = 0; bucket + 1 < first.size(); ++bucket) {
    std::sort(sides.begin() + first[bucket], sides.begin() + first[bucket + 1]);
    for (std::size_t i = first[bucket] + 1; i < first[bucket + 1]; ++i) {
      const auto& [a_high, a] = sides[i - 1];
      const auto& [b_high, b] = sides[i];
      if (a_high != b_high) continue;
      mesh.neighbours[a >> 2][a & 3u] = b;
      mesh.neighbours[b >> 2][b & 3u] = a;
    }
  }
}

// Each thread reads all triangles and links the sides of its share of the vertices.
void link_sides(SurfaceMesh& mesh, int threads) {
  mesh.neighbours.assign(mesh.triangles.size(), {kNoSide, kNoSide, kNoSide});
  Shares(mesh.points.size(), threads).for_each(threads, [&](std::size_t, std::size_t first, std::size_t last) {
    link_sides(mesh, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last));
  });
}

}  // namespace

PolygonizedSurface polygonized_surface(const ScalarGrid& grid, const Isosurface& isosurface,
                                       const IsosurfaceTopology& topology, int threads) {
  MarchingCubesMesh cubes = marching_cubes(grid, isosurface.isovalue(), topology.index, topology.crossings, threads);
  PolygonizedSurface surface;

  // A triangle belongs to the component of its crossings; one of inner points alone to that of a triangle beside it.
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

  const Vec3& step = isosurface.step();
  surface.mesh.points.resize(cubes.points.size());
  const auto point_in_mesh_space = [&](std::size_t v) {
    if (v < cubes.crossing_count) return scaled(crossing_position(grid, topology.crossings[v]), step);
    Vec3 p = cubes.points[v] - grid.origin();
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] *= step[axis] / grid.spacing()[axis];
    return p;
  };
  for_each_block(cubes.points.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) surface.mesh.points[v] = point_in_mesh_space(v);
  });
  surface.mesh.pole_heights.assign(cubes.points.size(), 1);
  surface.mesh.triangles = std::move(cubes.triangles);
  link_sides(surface.mesh, threads);
  return surface;
}

}  // namespace deliso

// Steps that insert a missed point: each replaces triangles by the star of the point over what bounded them, and what
// the guard keeps beside that.
#include "surface/sizes/insertion_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/certificate/exact_polygonization.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/shape/place_search.h"
#include "surface/shape/step_guard.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

struct PatchOfAll {
  BoxSet room;
  Patch patch{room, 1};

  PatchOfAll(const Box3& box, const TriangleMesh& mesh) {
    room.add({box.low - Vec3{1, 1, 1}, box.high + Vec3{1, 1, 1}});
    for (const Vec3& p : mesh.points) patch.add_vertex(p);
    for (const auto& t : mesh.triangles) patch.add_triangle(t);
  }
  [[nodiscard]] std::uint32_t nearest(const Vec3& p) const {
    std::uint32_t nearest = 0;
    const auto off = [&](std::uint32_t t) {
      const auto [a, b, c] = patch.corner_points(t);
      return squared_distance_to_triangle(p, a, b, c);
    };
    for (std::uint32_t t = 1; t < patch.triangle_count(); ++t) {
      if (off(t) < off(nearest)) nearest = t;
    }
    return nearest;
  }
};

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// How often triangles run along each edge from its lower to its higher vertex, less how often the other way: their
// boundary as a chain.
std::map<Edge, int> chain_of(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::map<Edge, int> chain;
  for (const auto& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      chain[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  std::erase_if(chain, [](const auto& entry) { return entry.second == 0; });
  return chain;
}

TEST(InsertionSteps, HaveTheBoundaryOfWhatTheyReplace) {
  int on_boundary = 0, inside = 0;
  for (const auto& scene : {testing::field_scene("gyroid", 10), testing::noise_scene({5, 6, 5}, 4)}) {
    SCOPED_TRACE(scene->name);
    const Box3& box = scene->isosurface->box();
    const SurfaceMesh mesh = exact_polygonization(scene->surface()).mesh;
    const PatchOfAll all(box, {mesh.points, mesh.triangles});
    Rng rng(7);
    for (int i = 0; i < 60; ++i) {
      Vec3 p = testing::crossing_points(*scene)[rng.below(scene->topology.crossings.size())];
      p = box.clamp(p + 0.6 * Vec3{rng.uniform() - 0.5, rng.uniform() - 0.5, rng.uniform() - 0.5});
      for (const PatchStep& step : insertion_steps(all.patch, all.nearest(p), p, box)) {
        std::vector<std::array<std::uint32_t, 3>> removed;
        for (const std::uint32_t t : step.removed) removed.push_back(all.patch.corners(t));
        std::map<Edge, int> before = chain_of(removed);
        const std::map<Edge, int> after = chain_of(step.added);
        // On the boundary the point halves edges in a face of the box that it lies in.
        std::vector<std::array<std::uint32_t, 3>> halved;
        for (const auto& [edge, count] : before) {
          const auto [a, b] = count > 0 ? edge : Edge{edge.second, edge.first};
          const unsigned faces = faces_at(box, all.patch.point(a)) & faces_at(box, all.patch.point(b));
          if (after.contains(edge) || (faces & faces_at(box, p)) == 0) continue;
          halved.push_back({step.vertex, b, a});
        }
        EXPECT_EQ(step.is_on_boundary, !halved.empty());
        for (const auto& [edge, count] : chain_of(halved)) before[edge] += count;
        std::erase_if(before, [](const auto& entry) { return entry.second == 0; });
        EXPECT_EQ(before, after);
        ++(step.is_on_boundary ? on_boundary : inside);
      }
    }
  }
  EXPECT_GT(on_boundary, 20);
  EXPECT_GT(inside, 500);
}

// A square near the isosurface x = 4.3 may lose a vertex that stands out a little, but for a witness there.
TEST(StepGuard, StaysNearTheWitnessesOfItsOptions) {
  const ScalarGrid grid = testing::sampled({9, 9, 9}, [](const Vec3& p) { return 4.3 - p.x; });
  const Isosurface isosurface(grid, 0, {});
  TriangleMesh mesh;
  const auto number = [](int i, int j) { return static_cast<std::uint32_t>(5 * (j + 2) + i + 2); };
  for (int j = -2; j <= 2; ++j) {
    for (int i = -2; i <= 2; ++i) mesh.points.push_back({i == 0 && j == 0 ? 4.38 : 4.28, 4.0 + i, 4.0 + j});
  }
  for (int j = -2; j < 2; ++j) {
    for (int i = -2; i < 2; ++i) {
      mesh.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      mesh.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
  const std::uint32_t middle = number(0, 0);
  PatchStep step;
  step.kind = ShapeStep::kRemove;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (std::count(mesh.triangles[t].begin(), mesh.triangles[t].end(), middle) == 1) step.removed.push_back(t);
  }
  step.added = {{number(1, 0), number(1, 1), number(0, 1)},
                {number(1, 0), number(0, 1), number(-1, 0)},
                {number(1, 0), number(-1, 0), number(-1, -1)},
                {number(1, 0), number(-1, -1), number(0, -1)}};
  for (const bool has_witness : {false, true}) {
    SCOPED_TRACE(has_witness);
    PatchOfAll all(isosurface.box(), mesh);
    ShapeOptions options;
    options.max_distance = 0.05;
    if (has_witness) options.witnesses = {mesh.points[middle]};
    SearchCounters counters;
    StepGuard guard(all.patch, {}, isosurface, options, counters);
    EXPECT_EQ(guard.apply(step), !has_witness);
  }
}

}  // namespace
}  // namespace deliso

// Cutting the mesh of stage 2 into slabs and joining them again.
#include "surface/refinement_slabs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "delaunay/base/parallel.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

// A wavy square of n x n squares, cut into triangles.
SurfaceMesh wavy_square(std::uint32_t n) {
  SurfaceMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) mesh.points.push_back({double(i), double(j), std::sin(0.3 * i + 0.2 * j)});
  }
  mesh.pole_heights.assign(mesh.points.size(), 1);
  const auto square = [&](std::uint32_t i, std::uint32_t j) { return 2 * (j * n + i); };
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t at = j * (n + 1) + i;
      mesh.triangles.push_back({at, at + 1, at + n + 2});
      mesh.neighbours.push_back({i + 1 < n ? 4 * (square(i + 1, j) + 1) + 1 : kNoSide, 4 * (square(i, j) + 1) + 2,
                                 j > 0 ? 4 * (square(i, j - 1) + 1) + 0 : kNoSide});
      mesh.triangles.push_back({at, at + n + 2, at + n + 1});
      mesh.neighbours.push_back({j + 1 < n ? 4 * square(i, j + 1) + 2 : kNoSide,
                                 i > 0 ? 4 * square(i - 1, j) + 0 : kNoSide, 4 * square(i, j) + 1});
    }
  }
  return mesh;
}

std::vector<std::array<std::uint32_t, 3>> sorted_triangles(std::vector<std::array<std::uint32_t, 3>> triangles) {
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(RefinementSlabs, PartsAreApartAndJoinToWhatWasCut) {
  const SurfaceMesh mesh = wavy_square(120);
  ASSERT_EQ(testing::surface_mesh_defect(mesh), "");
  RefinementMesh whole(mesh);
  RefinementSlabs slabs(whole, 8192);
  ASSERT_EQ(slabs.parts().size(), 3u);
  std::size_t free_triangles = 0;
  for (const RefinementPart& part : slabs.parts()) {
    EXPECT_GT(part.frozen, 0u);
    for (std::uint32_t t = part.frozen; t < part.mesh.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) EXPECT_TRUE(part.contains(part.mesh.corner(t, i)));
    }
    free_triangles += part.mesh.triangles.size() - part.frozen;
  }
  EXPECT_GT(free_triangles, mesh.triangles.size() * 9 / 10);
  slabs.join(whole);
  SurfaceMesh joined;
  whole.move_to(joined);
  EXPECT_EQ(testing::surface_mesh_defect(joined), "");
  EXPECT_EQ(joined.points, mesh.points);
  EXPECT_EQ(sorted_triangles(joined.triangles), sorted_triangles(mesh.triangles));
}

TEST(RefinementSlabs, WhatPartsAddStaysLinked) {
  const SurfaceMesh mesh = wavy_square(120);
  RefinementMesh whole(mesh);
  RefinementSlabs slabs(whole, 8192);
  // Every part splits its first free triangle and one beside a frozen one at their centroids.
  std::size_t added = 0;
  for (RefinementPart& part : slabs.parts()) {
    const auto beside = [&] {
      std::uint32_t t = part.frozen;
      const auto touches_frozen = [&] {
        const auto& sides = part.mesh.triangles[t].neighbours;
        return std::any_of(sides.begin(), sides.end(),
                           [&](TriangleSide side) { return side != kNoSide && side >> 2 < part.frozen; });
      };
      while (!touches_frozen()) ++t;
      return t;
    };
    for (const std::uint32_t t : {part.frozen, beside()}) {
      const auto old = part.mesh.triangles[t];
      const auto p = static_cast<std::uint32_t>(part.mesh.vertices.size());
      const auto [a, b, c] = part.mesh.corner_points(old.corners);
      part.mesh.vertices.push_back({(a + b + c) / 3, 1});
      const auto next = static_cast<std::uint32_t>(part.mesh.triangles.size());
      const std::array<std::uint32_t, 3> slot = {t, next, next + 1};
      part.mesh.triangles.resize(next + 2);
      for (unsigned i = 0; i < 3; ++i) {
        auto& triangle = part.mesh.triangles[slot[i]];
        triangle.corners = {p, old.corners[(i + 1) % 3], old.corners[(i + 2) % 3]};
        triangle.neighbours = {old.neighbours[i], 4 * slot[(i + 1) % 3] + 2, 4 * slot[(i + 2) % 3] + 1};
        const TriangleSide outer = old.neighbours[i];
        if (outer != kNoSide) part.mesh.triangles[outer >> 2].neighbours[outer & 3u] = 4 * slot[i];
      }
      ++added;
    }
  }
  slabs.join(whole);
  SurfaceMesh joined;
  whole.move_to(joined);
  EXPECT_EQ(testing::surface_mesh_defect(joined), "");
  EXPECT_EQ(joined.points.size(), mesh.points.size() + added);
  EXPECT_EQ(joined.triangles.size(), mesh.triangles.size() + 2 * added);
  EXPECT_TRUE(std::equal(mesh.points.begin(), mesh.points.end(), joined.points.begin()));
}

TEST(RefinementSlabs, SmallMeshesAreOnePart) {
  RefinementMesh whole(wavy_square(20));
  RefinementSlabs slabs(whole, 8192);
  ASSERT_EQ(slabs.parts().size(), 1u);
  EXPECT_EQ(slabs.parts()[0].frozen, 0u);
  EXPECT_EQ(slabs.parts()[0].mesh.triangles.size(), whole.triangles.size());
}

TEST(RunTasks, RunsEachTaskOnceAndThrowsTheFirstError) {
  for (const int threads : {0, 1, 2, 7}) {
    std::vector<int> runs(100, 0);
    run_tasks(runs.size(), threads, [&](std::size_t i) { ++runs[i]; });
    EXPECT_TRUE(std::all_of(runs.begin(), runs.end(), [](int n) { return n == 1; }));
    run_tasks(0, threads, [](std::size_t) { FAIL(); });
    try {
      run_tasks(runs.size(), threads, [&](std::size_t i) {
        ++runs[i];
        if (i % 30 == 29) throw std::runtime_error(std::to_string(i));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "29");
    }
    EXPECT_TRUE(std::all_of(runs.begin(), runs.end(), [](int n) { return n == 2; }));
  }
}

}  // namespace
}  // namespace deliso

// Cutting the mesh of stage 2 into slabs and joining them again.
#include "surface/refine/slabs/refinement_slabs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "delaunay/base/parallel.h"
#include "tests/support/surface_oracle.h"
#include "tests/support/wavy_square.h"

namespace deliso {
namespace {

using testing::wavy_square;

std::vector<std::array<std::uint32_t, 3>> sorted_triangles(std::vector<std::array<std::uint32_t, 3>> triangles) {
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(RefinementSlabs, PartsAreApartAndJoinToWhatWasCut) {
  const SurfaceMesh mesh = wavy_square(120);
  ASSERT_EQ(testing::surface_mesh_defect(mesh), "");
  RefinementMesh whole(mesh);
  const std::vector<Slab> cut = slabs_of_equal_work(whole, std::vector<float>(whole.triangles.size(), 1), 8192);
  ASSERT_EQ(cut.size(), 4u);
  std::atomic<std::size_t> free_triangles = 0;
  RefinementSlabs slabs(whole, cut, std::vector<float>(whole.triangles.size(), 1), 2);
  slabs.refine_each([&](std::size_t k, const RefinementPart& part) {
    EXPECT_EQ(part.slab.low, cut[k].low);
    EXPECT_GT(part.frozen, 0u);
    for (std::uint32_t t = part.frozen; t < part.mesh.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) EXPECT_TRUE(part.slab.contains(part.mesh.corner(t, i)));
    }
    free_triangles += part.mesh.triangles.size() - part.frozen;
  });
  EXPECT_GT(free_triangles, mesh.triangles.size() * 9 / 10);
  SurfaceMesh joined;
  whole.move_to(joined);
  EXPECT_EQ(testing::surface_mesh_defect(joined), "");
  EXPECT_EQ(joined.points, mesh.points);
  EXPECT_EQ(sorted_triangles(joined.triangles), sorted_triangles(mesh.triangles));
}

// Splits the first free triangle of a part and one beside a frozen one at their centroids; finds the new vertices and
// the first vertex of all suspect.
void split_two_triangles(RefinementPart& part) {
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
    part.mesh.vertices[p].is_suspect = part.mesh.vertices[0].is_suspect = true;
  }
}

TEST(RefinementSlabs, WhatPartsAddStaysLinked) {
  const SurfaceMesh mesh = wavy_square(120);
  RefinementMesh whole(mesh);
  const std::vector<float> work(whole.triangles.size(), 1);
  const std::vector<Slab> cut = slabs_of_equal_work(whole, work, 8192);
  RefinementSlabs(whole, cut, work, 1).refine_each([](std::size_t, RefinementPart& part) {
    split_two_triangles(part);
  });
  SurfaceMesh joined;
  whole.move_to(joined);
  EXPECT_EQ(testing::surface_mesh_defect(joined), "");
  EXPECT_EQ(joined.points.size(), mesh.points.size() + 2 * cut.size());
  EXPECT_EQ(joined.triangles.size(), mesh.triangles.size() + 4 * cut.size());
  EXPECT_TRUE(std::equal(mesh.points.begin(), mesh.points.end(), joined.points.begin()));
}

TEST(RefinementSlabs, ItDoesNotMatterWhichPartIsRefinedFirst) {
  const SurfaceMesh mesh = wavy_square(120);
  const std::vector<float> work(mesh.triangles.size(), 1);
  const auto refined = [&](int threads) {
    RefinementMesh whole(mesh);
    const std::vector<Slab> cut = slabs_of_equal_work(whole, work, 8192);
    std::atomic<std::size_t> done = 0;
    const auto refine = [&](std::size_t k, RefinementPart& part) {
      for (const auto& vertex : part.mesh.vertices) EXPECT_FALSE(vertex.is_suspect) << k;
      split_two_triangles(part);
      // The first part waits for all others.
      for (int wait = 0; threads > 1 && k == 0 && done + 1 < cut.size() && wait < 10000; ++wait) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      ++done;
    };
    RefinementSlabs(whole, cut, work, threads).refine_each(refine);
    return whole;
  };
  const RefinementMesh expected = refined(1);
  const RefinementMesh found = refined(2);
  ASSERT_EQ(found.vertices.size(), expected.vertices.size());
  ASSERT_EQ(found.triangles.size(), expected.triangles.size());
  std::size_t suspects = 0;
  for (std::size_t v = 0; v < expected.vertices.size(); ++v) {
    EXPECT_EQ(found.vertices[v].point, expected.vertices[v].point) << v;
    EXPECT_EQ(found.vertices[v].is_suspect, expected.vertices[v].is_suspect) << v;
    suspects += expected.vertices[v].is_suspect ? 1 : 0;
  }
  EXPECT_EQ(suspects, 11u);  // two for each part, and one more; two parts share theirs
  for (std::size_t t = 0; t < expected.triangles.size(); ++t) {
    EXPECT_EQ(found.triangles[t].corners, expected.triangles[t].corners) << t;
    EXPECT_EQ(found.triangles[t].neighbours, expected.triangles[t].neighbours) << t;
  }
}

TEST(RefinementSlabs, TrianglesBeyondThemStayAsTheyAre) {
  const SurfaceMesh mesh = wavy_square(40);
  RefinementMesh whole(mesh);
  const std::vector<Slab> apart = {{1, 3.5, 9.25}, {1, 20, 31.5}};
  std::size_t cut_out = 0;
  RefinementSlabs slabs(whole, apart, std::vector<float>(whole.triangles.size()), 1);
  slabs.refine_each([&](std::size_t, const RefinementPart& part) { cut_out += part.mesh.triangles.size(); });
  EXPECT_EQ(cut_out, 80u * (7 + 13));  // the rows of squares that the slabs meet, planes included
  SurfaceMesh joined;
  whole.move_to(joined);
  EXPECT_EQ(joined.points, mesh.points);
  EXPECT_EQ(joined.triangles, mesh.triangles);
  EXPECT_EQ(joined.neighbours, mesh.neighbours);
}

// Planes through vertices, the same plane twice, slabs without end or without anything between their planes.
TEST(RefinementSlabs, PartsHaveWhatTheirSlabsMeet) {
  const RefinementMesh mesh(wavy_square(40));
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<Slab>> cuts = {
      {{1, -inf, 7}, {1, 7, 7}, {1, 7, 20.5}, {1, 20.5, inf}},
      {{1, 3, 4}, {1, 4, 4.5}, {1, 9, 9}, {1, 30, 50}},
      {{0, -1, 0}, {0, 0, 0}, {0, 40, 40}, {0, 41, inf}},
      {{1, 7, 20.5}, {1, 30, inf}, {1, 7, 7}, {1, -inf, 7}},  // in any order
  };
  for (const std::vector<Slab>& slabs : cuts) {
    RefinementMesh whole = mesh;
    RefinementSlabs(whole, slabs, std::vector<float>(mesh.triangles.size()), 1)
        .refine_each([&](std::size_t k, const RefinementPart& part) {
          std::size_t met = 0, within = 0;
          for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const Box3 box = mesh.box_of(t);
            const double low = box.low[slabs[k].axis], high = box.high[slabs[k].axis];
            met += slabs[k].low <= high && low <= slabs[k].high ? 1 : 0;
            within += slabs[k].low < low && high < slabs[k].high ? 1 : 0;
          }
          EXPECT_EQ(part.mesh.triangles.size(), met) << k;
          EXPECT_EQ(part.mesh.triangles.size() - part.frozen, within) << k;
        });
  }
}

// A frozen triangle that was refused, beside which a part inserts, is to be tried again in the whole.
TEST(RefinementSlabs, FrozenTrianglesThatPartsWakeAreCoarseInTheWhole) {
  const RefinementMesh mesh(wavy_square(40));
  RefinementMesh whole = mesh;
  std::size_t woken = 0;
  RefinementSlabs(whole, {{1, 10.5, 20.5}}, std::vector<float>(mesh.triangles.size()), 1)
      .refine_each([&](std::size_t, RefinementPart& part) {
        ASSERT_GT(part.frozen, 1u);
        part.mesh.triangles[1].set(RefinementMesh::Triangle::kCoarse, true);
      });
  for (const auto& triangle : whole.triangles) woken += triangle.is_coarse() ? 1 : 0;
  EXPECT_EQ(woken, 1u);
}

// A later refinement counts its attempts anew: none of the parts' numbers may be taken for one of its own.
TEST(RefinementSlabs, WhatPartsNotedOfTheirAttemptsIsForgotten) {
  const RefinementMesh mesh(wavy_square(40));
  RefinementMesh whole = mesh;
  RefinementSlabs(whole, {{1, 10.5, 20.5}}, std::vector<float>(mesh.triangles.size()), 1)
      .refine_each([&](std::size_t, RefinementPart& part) {
        for (RefinementMesh::Triangle& t : part.mesh.triangles) t.attempt = 7;
        for (RefinementMesh::Vertex& v : part.mesh.vertices) v.attempt = 7;
        for (std::uint32_t t = part.frozen; t < part.mesh.triangles.size(); ++t) part.mesh.triangles[t].renew();
      });
  for (const RefinementMesh::Triangle& t : whole.triangles) ASSERT_TRUE(t.attempt == 0 && !t.is_renewed());
  for (const RefinementMesh::Vertex& v : whole.vertices) ASSERT_EQ(v.attempt, 0u);
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

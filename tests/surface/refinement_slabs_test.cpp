// Cutting the mesh of stage 2 into slabs and joining them again.
#include "surface/refinement_slabs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

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

TEST(RefinementPlanes, SmallMeshesAreOneSlab) {
  const RefinementMesh whole(wavy_square(20));
  const std::vector<Slab> slabs = slabs_of_equal_work(whole, std::vector<float>(whole.triangles.size(), 1), 8192);
  ASSERT_EQ(slabs.size(), 1u);
  EXPECT_TRUE(slabs[0].contains({-1e300, 0, 1e300}));
}

// Of each slab: the work of the triangles whose middles lie in it, as a part of all; of each plane: what it cuts.
struct Shares {
  std::vector<double> of_slabs, of_planes;
};
Shares shares_of(const RefinementMesh& mesh, const std::vector<Slab>& slabs, const std::vector<float>& work) {
  Shares shares{std::vector<double>(slabs.size()), std::vector<double>(slabs.size() - 1)};
  double all = 0;
  for (std::uint32_t t = 0; t < work.size(); ++t) {
    const Box3 box = mesh.box_of(t);
    const std::size_t axis = slabs[0].axis;
    const double middle = 0.5 * (box.low[axis] + box.high[axis]);
    all += work[t] + 0.5;
    for (std::size_t k = 0; k < slabs.size(); ++k) {
      if (slabs[k].low <= middle && middle < slabs[k].high) shares.of_slabs[k] += work[t] + 0.5;
      const bool is_cut = box.low[axis] <= slabs[k].high && slabs[k].high <= box.high[axis];
      if (k + 1 < slabs.size() && is_cut) shares.of_planes[k] += work[t];
    }
  }
  for (double& share : shares.of_slabs) share /= all;
  for (double& share : shares.of_planes) share /= all;
  return shares;
}

TEST(RefinementPlanes, SlabsHaveAboutTheSameWork) {
  const RefinementMesh mesh(wavy_square(120));
  std::vector<float> work(mesh.triangles.size());
  for (std::uint32_t t = 0; t < work.size(); ++t) work[t] = static_cast<float>(mesh.corner(t, 0).x * 0.2);
  const std::vector<Slab> slabs = slabs_of_equal_work(mesh, work, 8192);
  ASSERT_EQ(slabs.size(), 4u);
  for (std::size_t k = 0; k + 1 < slabs.size(); ++k) {
    EXPECT_EQ(slabs[k].high, slabs[k + 1].low);
    EXPECT_EQ(slabs[k].axis, slabs[0].axis);
  }
  for (const double share : shares_of(mesh, slabs, work).of_slabs) EXPECT_NEAR(share, 0.25, 0.08);
}

TEST(RefinementPlanes, ThereIsAnEvenNumberOfSlabs) {
  const RefinementMesh mesh(wavy_square(120));
  const std::vector<float> work(mesh.triangles.size(), 1);
  for (const std::size_t in_slab : {20'000u, 12'000u, 9'600u, 7'200u, 5'760u, 4'000u, 1'000u}) {
    const std::size_t count = slabs_of_equal_work(mesh, work, in_slab).size();
    EXPECT_TRUE(count == 1 || count % 2 == 0) << in_slab;
    EXPECT_LE(count, 10u) << in_slab;
    EXPECT_NEAR(static_cast<double>(count), std::min(10.0, 28'800.0 / static_cast<double>(in_slab)), 1) << in_slab;
  }
}

// Work alone counts that is left: every second row of squares is coarse, the more the farther from the middle.
TEST(RefinementPlanes, TheSlabWithTheMostWorkLeftComesFirst) {
  RefinementMesh mesh(wavy_square(60));
  std::vector<float> work(mesh.triangles.size());
  for (std::uint32_t t = 0; t < work.size(); ++t) {
    const double y = mesh.box_of(t).low.y;
    mesh.triangles[t].set(RefinementMesh::Triangle::kCoarse, std::fmod(y, 2) == 0);
    work[t] = static_cast<float>(std::fmod(y, 2) == 0 ? std::abs(y - 31) : 1000 + y);
  }
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Slab> in_order = {{1, -inf, 10}, {1, 10, 40}, {1, 40, 50}, {1, 50, inf}};
  const auto left_in = [&](const Slab& slab) {
    double left = 0;
    for (std::uint32_t t = 0; t < work.size(); ++t) {
      const double middle = mesh.box_of(t).low.y + 0.5;
      if (mesh.triangles[t].is_coarse() && slab.low < middle && middle < slab.high) left += work[t];
    }
    return left;
  };
  const std::vector<Slab> slabs = most_work_first(in_order, mesh, work);
  ASSERT_EQ(slabs.size(), in_order.size());
  double sum = 0;
  for (const Slab& slab : slabs) sum += left_in(slab);
  for (std::size_t k = 1; k < slabs.size(); ++k) EXPECT_GT(left_in(slabs[k - 1]), left_in(slabs[k]));
  EXPECT_EQ(sum, left_in({1, -inf, inf}));
  EXPECT_EQ(slabs.front().low, 10);
  EXPECT_EQ(slabs.back().low, 40);
}

TEST(RefinementPlanes, PlanesKeepOutOfCoarsePlaces) {
  // Coarse stripes where equal shares would have the planes.
  const RefinementMesh mesh(wavy_square(128));
  std::vector<float> work(mesh.triangles.size());
  for (std::uint32_t t = 0; t < work.size(); ++t) work[t] = std::fmod(mesh.box_of(t).low.y + 2, 8) < 4 ? 100 : 1;
  const std::vector<Slab> slabs = slabs_of_equal_work(mesh, work, 8192);
  ASSERT_EQ(slabs.size(), 4u);
  ASSERT_EQ(slabs[0].axis, 1u);
  for (const double share : shares_of(mesh, slabs, work).of_planes) EXPECT_LT(share, 2.0 / 128 / 50);
}

TEST(RefinementPlanes, SeamsHoldWhatIsCoarseAtThePlanes) {
  RefinementMesh mesh(wavy_square(128));
  // Triangles of every third row are coarse.
  const auto is_coarse = [&](std::uint32_t t) { return std::fmod(mesh.box_of(t).low.y, 3) == 0; };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    mesh.triangles[t].set(RefinementMesh::Triangle::kCoarse, is_coarse(t));
  }
  const double inf = std::numeric_limits<double>::infinity();
  // One plane within a coarse row, one in a row that is not, and one between two rows, the upper one coarse.
  const std::vector<Slab> slabs = {{1, -inf, 30.5}, {1, 30.5, 31.75}, {1, 31.75, 60}, {1, 60, inf}};
  const std::vector<Slab> seams = seams_between(slabs, mesh, 2);
  ASSERT_EQ(seams.size(), 3u);
  EXPECT_EQ(seams[0].low, 29);                   // the row from 30 to 31 and its own height around it,
  EXPECT_EQ(seams[0].high, (30.5 + 31.75) / 2);  // but no farther than the middle of the next slab
  EXPECT_EQ(seams[1].low, seams[1].high);        // nothing
  EXPECT_EQ(seams[2].low, 59);
  EXPECT_EQ(seams[2].high, 62);
  for (const Slab& seam : seams) EXPECT_EQ(seam.axis, 1u);
}

TEST(RefinementPlanes, SeamsLeaveFreeWhatMeetsThePlanes) {
  const RefinementMesh mesh(wavy_square(120));
  const std::vector<float> work(mesh.triangles.size(), 1);
  const std::vector<Slab> slabs = slabs_of_equal_work(mesh, work, 8192);
  RefinementMesh coarse = mesh;
  for (auto& triangle : coarse.triangles) triangle.set(RefinementMesh::Triangle::kCoarse, true);
  const std::vector<Slab> seams = seams_between(slabs, coarse);
  ASSERT_EQ(slabs.size(), 4u);
  ASSERT_EQ(seams.size(), 3u);
  for (std::uint32_t t = 0; t < coarse.triangles.size(); ++t) {
    const Box3 box = coarse.box_of(t);
    for (std::size_t k = 0; k < seams.size(); ++k) {
      const double plane = slabs[k].high;
      const std::size_t axis = slabs[k].axis;
      if (box.low[axis] > plane || box.high[axis] < plane) continue;
      EXPECT_LT(seams[k].low, box.low[axis]);  // free to be refined there
      EXPECT_GT(seams[k].high, box.high[axis]);
    }
  }
  for (std::size_t k = 0; k + 1 < seams.size(); ++k) EXPECT_LE(seams[k].high, seams[k + 1].low);
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

// Stage 2 as a whole: the mesh keeps its topology, lies on the surface, and is the same for all ways to it.
#include "surface/refine/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "surface/refine/guard/clearances.h"
#include "surface/refine/refine_loop.h"
#include "tests/support/refine_runs.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::fine_options;
using testing::noise_scene;
using testing::run;
using testing::Scene;
using testing::stage1_mesh;

std::vector<std::unique_ptr<Scene>> scenes() {
  std::vector<std::unique_ptr<Scene>> all;
  for (const char* name : {"sphere", "torus", "double_torus", "gyroid", "sheets", "plane", "marschner_lobb"}) {
    all.push_back(field_scene(name, 16));
  }
  all.push_back(std::make_unique<Scene>("gyroid 12 closed", padded(generate_field("gyroid", 12), -3), 0.1));
  all.push_back(testing::wave_scene({9, 10, 6}, {1, 1, 3}, 4));
  for (std::uint64_t seed = 0; seed < 6; ++seed) all.push_back(noise_scene({5, 4, 6}, seed));
  return all;
}

TEST(Refine, TheMeshStaysHomeomorphicToWhatItWas) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    SurfaceMesh mesh = stage1_mesh(*scene);
    ASSERT_EQ(testing::surface_mesh_defect(mesh), "");
    const auto before = test::mesh_facts(mesh.triangles).components;
    const std::vector<Vec3> points = mesh.points;
    const RefineStats stats = run(mesh, *scene, fine_options());
    EXPECT_EQ(testing::surface_mesh_defect(mesh), "");
    EXPECT_EQ(test::mesh_facts(mesh.triangles).components, before);
    // Old vertices stay where they are; every insertion adds one.
    EXPECT_EQ(mesh.points.size(), points.size() + static_cast<std::size_t>(stats.insertions));
    EXPECT_TRUE(std::equal(points.begin(), points.end(), mesh.points.begin()));
    EXPECT_EQ(mesh.pole_heights.size(), mesh.points.size());
  }
}

TEST(Refine, NewVerticesLieOnTheSurfaceAndBoundaryEdgesOnTheBox) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    SurfaceMesh mesh = stage1_mesh(*scene);
    const std::size_t before = mesh.points.size();
    run(mesh, *scene, fine_options());
    const Box3& box = scene->isosurface->box();
    for (std::size_t v = before; v < mesh.points.size(); ++v) {
      EXPECT_TRUE(box.contains(mesh.points[v]));
      EXPECT_LE(std::abs(scene->isosurface->value(mesh.points[v])),
                1e-6 * (1 + norm(scene->isosurface->gradient(mesh.points[v]))));
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        if (mesh.neighbours[t][i] != kNoSide) continue;
        EXPECT_TRUE(SignedDelaunay::on_box(box, mesh.points[mesh.triangles[t][(i + 1) % 3]]));
        EXPECT_TRUE(SignedDelaunay::on_box(box, mesh.points[mesh.triangles[t][(i + 2) % 3]]));
      }
    }
  }
}

TEST(Refine, BallsPassThroughTheirThreeVertices) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    SurfaceMesh mesh = stage1_mesh(*scene);
    std::vector<SurfaceDelaunayBall> balls;
    run(mesh, *scene, fine_options(), &balls);
    ASSERT_EQ(balls.size(), mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const double radius = std::sqrt(balls[t].squared_radius);
      if (radius == 0 || radius > 1e3) continue;  // nothing could be measured on it
      for (const std::uint32_t v : mesh.triangles[t]) {
        EXPECT_NEAR(distance(mesh.points[v], balls[t].center), radius, 1e-6 * (1 + radius));
      }
    }
  }
}

TEST(Refine, EqualRunsGiveEqualMeshes) {
  const auto scene = noise_scene({5, 5, 5}, 3);
  for (const QueueOrder order : {QueueOrder::kWorstFirst, QueueOrder::kFirstInFirstOut, QueueOrder::kLargestRadius}) {
    RefineOptions options = fine_options();
    options.order = order;
    SurfaceMesh a = stage1_mesh(*scene);
    SurfaceMesh b = stage1_mesh(*scene);
    run(a, *scene, options);
    run(b, *scene, options);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(testing::surface_mesh_defect(a), "");
  }
}

TEST(Refine, SearchingAgainGivesTheMeshThatKeptHitsGive) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    SurfaceMesh kept = stage1_mesh(*scene);
    SurfaceMesh searched = kept;
    RefineOptions options = fine_options();
    const RefineStats few = run(kept, *scene, options);
    options.store_hits = false;
    const RefineStats many = run(searched, *scene, options);
    EXPECT_EQ(kept.points, searched.points);
    EXPECT_EQ(kept.triangles, searched.triangles);
    EXPECT_TRUE(few.insertions == 0 || many.search.searches > few.search.searches);
  }
}

TEST(Refine, StoppedAtAnyMomentTheMeshIsWhole) {
  const auto scene = field_scene("gyroid", 14);
  const SurfaceMesh start = stage1_mesh(*scene);
  const auto facts = test::mesh_facts(start.triangles).components;
  for (const auto& [more, slab_triangles] : std::vector<std::pair<std::int64_t, std::size_t>>{
           {0, 100}, {1, 100}, {2, 100}, {13, 100}, {200, 100}, {0, 100000}, {1, 100000}, {200, 100000}}) {
    SCOPED_TRACE(slab_triangles);
    SurfaceMesh mesh = start;
    BudgetParameters budget;
    budget.max_vertices = static_cast<std::int64_t>(mesh.points.size()) + more;
    Controls controls(budget, nullptr, {});
    RefineStats stats;
    RefineOptions options = fine_options();
    options.slab_triangles = slab_triangles;
    refine_geometry(mesh, *scene->isosurface, options, controls, stats);
    EXPECT_TRUE(controls.stopped());
    EXPECT_EQ(stats.insertions, more);
    EXPECT_EQ(testing::surface_mesh_defect(mesh), "");
    EXPECT_EQ(test::mesh_facts(mesh.triangles).components, facts);
  }
}

TEST(Refine, IsTheSameForAnyNumberOfThreads) {
  const auto scene = field_scene("gyroid", 32);
  const SurfaceMesh start = stage1_mesh(*scene);
  ASSERT_GT(start.triangles.size(), 4u * 100);
  RefineOptions options = fine_options();
  options.threads = 1;
  SurfaceMesh one = start;
  const RefineStats of_one = run(one, *scene, options);
  EXPECT_EQ(testing::surface_mesh_defect(one), "");
  for (const int threads : {2, 5}) {
    options.threads = threads;
    SurfaceMesh many = start;
    const RefineStats of_many = run(many, *scene, options);
    EXPECT_EQ(many.points, one.points);
    EXPECT_EQ(many.triangles, one.triangles);
    EXPECT_EQ(of_many.insertions, of_one.insertions);
    EXPECT_EQ(of_many.search.solves, of_one.search.solves);
  }
}

// Corners, neighbours, balls and flags.
void expect_equal(const RefinementMesh& mesh, const RefinementMesh& expected) {
  ASSERT_EQ(mesh.vertices.size(), expected.vertices.size());
  ASSERT_EQ(mesh.triangles.size(), expected.triangles.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    EXPECT_EQ(mesh.vertices[v].point, expected.vertices[v].point);
    EXPECT_EQ(mesh.vertices[v].pole_height, expected.vertices[v].pole_height);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto &now = mesh.triangles[t], &then = expected.triangles[t];
    EXPECT_EQ(now.corners, then.corners);
    EXPECT_EQ(now.neighbours, then.neighbours);
    EXPECT_EQ(now.ball.center, then.ball.center);
    EXPECT_EQ(now.state, then.state);
  }
}

TEST(Refine, WhatIsTakenBackLeavesTheMeshAsItWasAndCanBeDoneAgain) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    RefinementPart part;
    RefinementMesh& mesh = part.mesh;
    mesh = RefinementMesh(stage1_mesh(*scene));
    set_clearances(mesh);
    const RefineOptions options = fine_options();
    RefineStats stats;
    Controls controls(BudgetParameters{}, nullptr, {});
    RefineLoop(part, *scene->isosurface, options, stats).measure_all(1);
    const RefinementMesh before = mesh;
    RefineLoop refinement(part, *scene->isosurface, options, stats);
    refinement.run(controls, 1);
    EXPECT_EQ(mesh.vertices.size(), before.vertices.size() + static_cast<std::size_t>(stats.insertions));
    const RefinementMesh after = mesh;
    const RefinementChange change = refinement.take_back();
    expect_equal(mesh, before);
    change.redo(mesh);
    expect_equal(mesh, after);
  }
}

}  // namespace
}  // namespace deliso

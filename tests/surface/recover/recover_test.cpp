#include "surface/recover/recover.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include "delaunay/validate.h"
#include "surface/restricted/poles.h"
#include "surface/restricted/umbrella.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

Controls free_run() { return {BudgetParameters{}, nullptr, {}}; }

RecoverOptions coarse_options() {
  RecoverOptions options;
  options.geometry.r_min = 0.05;
  options.size_bound = 0.3;
  return options;
}

struct Recovered {
  std::size_t at_start = 0;  // vertices before
  RecoverStats stats;
  std::unique_ptr<RestrictedDelaunay> restricted;
};

Recovered run(const Scene& scene, const RecoverOptions& options) {
  Recovered result;
  result.restricted = std::make_unique<RestrictedDelaunay>(*scene.isosurface, scene.start());
  result.at_start = result.restricted->delaunay().vertex_count();
  Controls controls = free_run();
  recover(*result.restricted, options, controls, result.stats);
  return result;
}

std::size_t multiple_hits(const RestrictedDelaunay& restricted) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < restricted.dual_edge_slots(); ++i) {
    count += restricted.is_alive(DualEdgeId(i)) && restricted.dual_edge(DualEdgeId(i)).hits.size() > 1 ? 1 : 0;
  }
  return count;
}

TEST(Recover, NewVerticesKeepTheirDistanceFromAllOthers) {
  for (const auto& scene : {field_scene("gyroid", 14), noise_scene({5, 6, 5}, 1), noise_scene({4, 4, 7}, 2)}) {
    const Recovered result = run(*scene, coarse_options());
    const auto points = result.restricted->delaunay().points();
    ASSERT_EQ(points.size(), result.at_start + static_cast<std::size_t>(result.stats.insertions)) << scene->name;
    for (std::size_t i = result.at_start; i < points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) ASSERT_GE(distance(points[i], points[j]), 0.3) << scene->name;
    }
  }
}

TEST(Recover, NewVerticesLieOnTheSurfaceInTheBox) {
  for (const auto& scene : {field_scene("gyroid", 14), noise_scene({5, 6, 5}, 3)}) {
    const Recovered result = run(*scene, coarse_options());
    for (const Vec3& p : result.restricted->delaunay().points()) {
      EXPECT_TRUE(scene->isosurface->box().contains(p));
      EXPECT_LE(std::abs(scene->isosurface->value(p)), 1e-6 * norm(scene->isosurface->gradient(p)));
    }
  }
}

TEST(Recover, SmoothClosedSurfacesAreLeftWithoutViolations) {
  for (const char* name : {"sphere", "torus", "linked_tori", "double_torus"}) {
    const auto scene = field_scene(name, 32);
    SCOPED_TRACE(name);
    RecoverOptions options = coarse_options();
    options.size_bound = 0.1;
    const Recovered result = run(*scene, options);
    EXPECT_EQ(multiple_hits(*result.restricted), 0u);
    UmbrellaInspector umbrella(*result.restricted);
    for (std::size_t v = 0; v < result.restricted->delaunay().vertex_count(); ++v) {
      EXPECT_EQ(umbrella.inspect(VertexId(v)), UmbrellaShape::kDisk) << v;
    }
    // The counts of the three steps add up, and one step did most of the work.
    const RecoverStats& stats = result.stats;
    EXPECT_EQ(stats.multi_intersect + stats.extract_manifold + stats.approximate_geometry, stats.insertions);
    EXPECT_GT(stats.approximate_geometry, 0);
  }
}

TEST(Recover, TrianglesMeetTheCriteriaWhereNothingWasRefused) {
  const auto scene = field_scene("torus", 32);
  RecoverOptions options;
  options.geometry.r_min = 0.2;
  options.size_bound = 1e-3;
  const Recovered result = run(*scene, options);
  ASSERT_EQ(result.stats.refused_by_size_bound, 0);
  std::size_t checked = 0;
  for (std::size_t i = 0; i < result.restricted->dual_edge_slots(); ++i) {
    if (!result.restricted->is_alive(DualEdgeId(i))) continue;
    const DualEdge& edge = result.restricted->dual_edge(DualEdgeId(i));
    if (!result.restricted->is_restricted(edge.facet) || edge.radius <= options.geometry.r_min) continue;
    const auto point = [&](std::size_t n) { return result.restricted->delaunay().point(edge.vertices[n]); };
    const double shortest =
        std::min({distance(point(0), point(1)), distance(point(1), point(2)), distance(point(2), point(0))});
    EXPECT_LE(std::abs(surface_hit(edge)), options.geometry.epsilon * edge.radius * (1 + 1e-9));
    EXPECT_LE(edge.radius, options.geometry.rho * shortest * (1 + 1e-9));
    ++checked;
  }
  EXPECT_GT(checked, 100u);
}

TEST(Recover, UmbrellasOfCutSurfacesAreDisksOrHalfDisksOnTheBox) {
  for (const char* name : {"plane", "sheets"}) {
    const auto scene = field_scene(name, 16);
    const Recovered result = run(*scene, coarse_options());
    UmbrellaInspector umbrella(*result.restricted);
    for (std::size_t i = 0; i < result.restricted->delaunay().vertex_count(); ++i) {
      const VertexId v(i);
      if (result.restricted->is_virtual(v)) continue;
      EXPECT_EQ(umbrella.inspect(v), result.restricted->is_on_box(v) ? UmbrellaShape::kHalfDisk : UmbrellaShape::kDisk)
          << name << " vertex " << i;
    }
  }
}

TEST(Recover, EqualRunsGiveEqualVerticesAndOtherOrdersEndToo) {
  const auto scene = noise_scene({5, 5, 5}, 9);
  for (const QueueOrder order : {QueueOrder::kWorstFirst, QueueOrder::kFirstInFirstOut, QueueOrder::kLargestRadius}) {
    RecoverOptions options = coarse_options();
    options.order = order;
    const Recovered a = run(*scene, options);
    const Recovered b = run(*scene, options);
    const auto pa = a.restricted->delaunay().points();
    const auto pb = b.restricted->delaunay().points();
    EXPECT_TRUE(std::equal(pa.begin(), pa.end(), pb.begin(), pb.end()));
    EXPECT_GT(a.stats.insertions, 0);
  }
}

// Large enough to be refined in slabs, which keep the promises of stage 1, too.
TEST(Recover, AnyNumberOfThreadsGivesTheSameVerticesAndSigns) {
  for (const auto& scene : {field_scene("gyroid", 40), noise_scene({12, 14, 13}, 5)}) {
    SCOPED_TRACE(scene->name);
    RecoverOptions options = coarse_options();
    const Recovered one = run(*scene, options);
    const auto points = one.restricted->delaunay().points();
    ASSERT_GT(points.size(), 2000u);
    EXPECT_GT(one.stats.in_slabs, one.stats.insertions / 10);
    for (std::size_t i = one.at_start; i < points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) ASSERT_GE(distance(points[i], points[j]), 0.3);
    }
    EXPECT_EQ(find_violation(one.restricted->delaunay()).value_or("none"), "none");
    const RestrictedDelaunay fresh(*scene->isosurface, points);
    EXPECT_EQ(testing::signs_by_name(*one.restricted), testing::signs_by_name(fresh));
    for (const int threads : {2, 3}) {
      options.threads = threads;
      const Recovered several = run(*scene, options);
      const auto others = several.restricted->delaunay().points();
      EXPECT_TRUE(std::equal(points.begin(), points.end(), others.begin(), others.end()));
      EXPECT_EQ(several.restricted->signs(), one.restricted->signs());
      EXPECT_EQ(several.stats.insertions, one.stats.insertions);
      EXPECT_EQ(several.stats.search.searches, one.stats.search.searches);
    }
  }
}

// In no part of it, and none is lost.
TEST(Recover, SlabsLeaveNoViolation) {
  const auto scene = field_scene("gyroid", 40);
  RecoverOptions options;
  options.geometry.r_min = 0.2;
  options.size_bound = 1e-3;
  Recovered result = run(*scene, options);
  ASSERT_GT(result.stats.insertions, 2000);
  EXPECT_GT(result.stats.in_slabs, 500);
  const std::int64_t refused = result.stats.refused_by_size_bound;
  RecoverStats again;
  Controls controls = free_run();
  recover(*result.restricted, options, controls, again);
  EXPECT_EQ(again.insertions, 0);
  EXPECT_LE(again.refused_by_size_bound, refused);
}

// An umbrella may need several points, and the first ones may leave it as it is.
TEST(Recover, LooksAtAnUmbrellaAgainAfterEachPoint) {
  for (const std::uint64_t seed : {2u, 5u, 23u, 26u}) {
    const auto scene = field_scene("bubbles", 20 + static_cast<std::int32_t>(seed), seed);
    Recovered result = run(*scene, coarse_options());
    RecoverStats again;
    Controls controls = free_run();
    recover(*result.restricted, coarse_options(), controls, again);
    EXPECT_EQ(again.insertions, 0) << scene->name;
  }
}

// Points are inserted later: then no violation is left, and points that are refused stay out.
TEST(Recover, WithMorePointsLeavesNoViolation) {
  for (const auto& scene : {field_scene("gyroid", 40), field_scene("bubbles", 24)}) {
    Recovered result = run(*scene, coarse_options());
    const std::vector<Vec3> crossings = testing::crossing_points(*scene);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < crossings.size(); i += 20) points.push_back(crossings[i]);
    const std::size_t before = result.restricted->delaunay().vertex_count();
    Controls controls = free_run();
    RecoverStats stats;
    const std::int64_t inserted = recover_with(*result.restricted, points, coarse_options(), controls, stats);
    EXPECT_GT(inserted, 10) << scene->name;
    EXPECT_LT(static_cast<std::size_t>(inserted), points.size()) << scene->name;
    EXPECT_EQ(stats.uncovered, inserted) << scene->name;
    EXPECT_GT(stats.insertions, inserted) << scene->name;
    EXPECT_EQ(result.restricted->delaunay().vertex_count(), before + static_cast<std::size_t>(stats.insertions));
    RecoverStats again;
    recover(*result.restricted, coarse_options(), controls, again);
    EXPECT_EQ(again.insertions, 0) << scene->name;
  }
}

TEST(Recover, WithMorePointsEndsAtTheVertexBudget) {
  const auto scene = field_scene("gyroid", 24);
  Recovered result = run(*scene, coarse_options());
  const std::vector<Vec3> points = testing::crossing_points(*scene);
  const std::size_t most = result.restricted->delaunay().vertex_count() + 9;
  BudgetParameters budget;
  budget.max_vertices = static_cast<std::int64_t>(most);
  Controls limited(budget, nullptr, {});
  RecoverStats stats;
  EXPECT_EQ(recover_with(*result.restricted, points, coarse_options(), limited, stats), 9);
  EXPECT_TRUE(limited.stopped());
  EXPECT_EQ(result.restricted->delaunay().vertex_count(), most);
}

TEST(Recover, SlabsEndAtTheVertexBudget) {
  const auto scene = field_scene("gyroid", 40);
  for (const std::size_t more : {100u, 777u, 1500u}) {
    RestrictedDelaunay restricted(*scene->isosurface, scene->start());
    const std::size_t most = restricted.delaunay().vertex_count() + more;
    BudgetParameters budget;
    budget.max_vertices = static_cast<std::int64_t>(most);
    Controls limited(budget, nullptr, {});
    RecoverStats stats;
    recover(restricted, coarse_options(), limited, stats);
    EXPECT_TRUE(limited.stopped());
    EXPECT_EQ(restricted.delaunay().vertex_count(), most);
    EXPECT_EQ(find_violation(restricted.delaunay()).value_or("none"), "none");
  }
}

TEST(Recover, NewVerticesInheritPoleHeightsBetweenThoseOfTheOld) {
  const auto scene = field_scene("torus", 24);
  Recovered result = run(*scene, coarse_options());
  std::vector<double> heights = compute_poles(*result.restricted);
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  const double least = *low;
  const double most = *high;
  RecoverOptions options = coarse_options();
  options.geometry.epsilon2 = 0.2;
  Controls controls = free_run();
  recover(*result.restricted, options, controls, result.stats, &heights);
  ASSERT_EQ(heights.size(), result.restricted->delaunay().vertex_count());
  for (const double h : heights) {
    EXPECT_GE(h, least * (1 - 1e-12));
    EXPECT_LE(h, most * (1 + 1e-12));
  }
}

TEST(Recover, StopsWhenToldAndAtTheVertexBudget) {
  const auto scene = noise_scene({5, 5, 5}, 4);
  std::atomic<bool> stop = true;
  RestrictedDelaunay restricted(*scene->isosurface, scene->start());
  const std::size_t before = restricted.delaunay().vertex_count();
  RecoverStats stats;
  Controls stopped(BudgetParameters{}, &stop, {});
  recover(restricted, coarse_options(), stopped, stats);
  EXPECT_TRUE(stopped.stopped());
  EXPECT_EQ(restricted.delaunay().vertex_count(), before);

  BudgetParameters budget;
  budget.max_vertices = static_cast<std::int64_t>(before) + 17;
  Controls limited(budget, nullptr, {});
  recover(restricted, coarse_options(), limited, stats);
  EXPECT_TRUE(limited.stopped());
  EXPECT_EQ(restricted.delaunay().vertex_count(), before + 17);
}

}  // namespace
}  // namespace deliso

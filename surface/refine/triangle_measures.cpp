// What stage 2 measures on triangles: their balls and how far they are from the criteria.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "surface/base/parallel_blocks.h"
#include "surface/refine/refine_loop.h"
#include "surface/refine/triangle_lanes.h"

namespace deliso {

namespace {

constexpr double kMostExpected = 1e6;  // insertions for one triangle

}  // namespace

RefineLoop::NewTriangle RefineLoop::measure(const Shape& shape) {
  NewTriangle measured;
  measure({&shape, 1}, {&measured, 1});
  return measured;
}

// Balls and badness of triangles; a dual line without a falling hit gives its circumball and no further refinement.
void RefineLoop::measure(std::span<const Shape> shapes, std::span<NewTriangle> measured) {
  TriangleLanes lanes;
  for (std::size_t first = 0; first < shapes.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, shapes.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [corners, mean_pole] = shapes[first + i];
      lanes.a.set(i, corners[0]);
      lanes.b.set(i, corners[1]);
      lanes.c.set(i, corners[2]);
      lanes.mean_pole[i] = mean_pole;
    }
    measure_in_planes(lanes);
    std::array<bool, kLanes> has_area{};
    for (std::size_t i = 0; i < count; ++i)
      has_area[i] = std::isfinite(lanes.radius[i]) && is_finite(lanes.dual.direction.at(i));
    isosurface_.nearest_falling_hits(lanes.dual, has_area, isosurface_.box().diagonal(), lanes.height, stats_.search);
    measure_balls(lanes, criteria_);
    for (std::size_t i = 0; i < count; ++i) {
      NewTriangle& triangle = measured[first + i];
      const double radius = lanes.radius[i], longest = lanes.squared_longest[i];
      if (!has_area[i]) {
        triangle = {{shapes[first + i].corners[0], 0}, false, 0, 0, longest};
      } else if (std::isnan(lanes.height[i])) {
        triangle = {{lanes.dual.origin.at(i), radius * radius}, false, 0, radius, longest};
      } else {
        triangle = {{lanes.x.at(i), lanes.squared_radius[i]}, true, lanes.badness[i], radius, longest};
      }
    }
  }
}

double RefineLoop::mean_pole_height(std::uint32_t triangle) const {
  double mean = 0;
  for (const std::uint32_t v : mesh_.triangles[triangle].corners) mean += mesh_.vertices[v].pole_height / 3;
  return mean;
}

// The same of a triangle of the mesh, by the ball it has.
RefineLoop::NewTriangle RefineLoop::measured(std::uint32_t triangle) {
  if (!mesh_.triangles[triangle].has_hit()) return {.ball = ball_of(triangle)};
  const auto [a, b, c] = mesh_.corner_points(mesh_.triangles[triangle].corners);
  const SurfaceDelaunayBall ball = ball_of(triangle);
  TriangleLanes lanes;  // one of them
  lanes.a.set(0, a);
  lanes.b.set(0, b);
  lanes.c.set(0, c);
  lanes.mean_pole[0] = mean_pole_height(triangle);
  measure_in_planes(lanes);
  lanes.height[0] = distance(ball.center, lanes.dual.origin.at(0));
  measure_balls(lanes, criteria_);
  return {ball, true, lanes.badness[0], lanes.radius[0], lanes.squared_longest[0]};
}

// What is learnt of a triangle of the mesh.
void RefineLoop::learn(std::uint32_t triangle, const NewTriangle& measured) {
  using Triangle = RefinementMesh::Triangle;
  Triangle& t = mesh_.triangles[triangle];
  const bool is_bad = measured.badness > 1, is_large = exceeds_r_min(measured.radius, criteria_);
  t.ball = measured.ball;
  t.set(Triangle::kNoHit, !measured.has_hit);
  t.set(Triangle::kTooSmall, is_bad && !is_large);
  t.set(Triangle::kCoarse, is_bad && is_large);
}

// In blocks, on several threads; each block has counters of its own, which are added to ours in order.
std::vector<float> RefineLoop::measure_all(int threads) {
  const std::size_t count = mesh_.triangles.size();
  std::vector<float> expected(count);
  std::vector<RefineStats> counted(count / kBlockSize + 1);
  for_each_block(count, threads, [&](std::size_t first, std::size_t last) {
    RefineLoop block(part_, isosurface_, options_, counted[first / kBlockSize]);
    std::array<Shape, kLanes> shapes;
    std::array<NewTriangle, kLanes> now;
    for (std::size_t from = first; from < last; from += kLanes) {
      const std::size_t some = std::min(kLanes, last - from);
      for (std::size_t i = 0; i < some; ++i) {
        const auto t = static_cast<std::uint32_t>(from + i);
        shapes[i] = {mesh_.corner_points(mesh_.triangles[t].corners), mean_pole_height(t)};
      }
      block.measure(std::span(shapes).first(some), std::span(now).first(some));
      for (std::size_t i = 0; i < some; ++i) {
        block.learn(static_cast<std::uint32_t>(from + i), now[i]);
        if (!mesh_.triangles[from + i].is_coarse()) continue;
        // Radii have to get smaller by the badness; r_min may end it before.
        const double times = std::min(now[i].badness, now[i].radius / options_.r_min);
        expected[from + i] = static_cast<float>(std::min(times * times, kMostExpected));
      }
    }
  });
  for (const RefineStats& stats : counted) stats_.search += stats.search;
  return expected;
}

}  // namespace deliso

// What stage 2 measures on triangles: their balls and how far they are from the criteria.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/constructions.h"
#include "surface/blocks.h"
#include "surface/refinement.h"

namespace deliso {

namespace {

constexpr double kMostExpected = 1e6;  // insertions for one triangle
constexpr std::size_t kTogether = 8;   // triangles

}  // namespace

Refinement::NewTriangle Refinement::measure(const Shape& shape) {
  NewTriangle measured;
  measure({&shape, 1}, {&measured, 1});
  return measured;
}

// Balls and badness of triangles; a dual line without a falling hit gives its circumball and no further refinement.
void Refinement::measure(std::span<const Shape> shapes, std::span<NewTriangle> measured) {
  for (std::size_t first = 0; first < shapes.size(); first += kTogether) {
    const std::size_t count = std::min(kTogether, shapes.size() - first);
    measure_few(shapes.subspan(first, count), measured.subspan(first, count));
  }
}

// At most kTogether, step by step for all of them: none waits for the roots and quotients of another.
void Refinement::measure_few(std::span<const Shape> shapes, std::span<NewTriangle> measured) {
  std::array<Circumcircle, kTogether> circles;
  std::array<Line, kTogether> duals;
  std::array<std::size_t, kTogether> of{};  // the shape that a dual line belongs to
  std::size_t count = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto& [p, a, b] = shapes[i].corners;
    circles[i] = circumcircle(p, a, b);
    const Vec3 normal = cross(a - p, b - p);
    const double length = norm(normal);
    measured[i] = {{p, 0}, false, 0, 0};  // when nothing can be measured on it
    duals[count] = {circles[i].center, normal / length};
    of[count] = i;
    count += std::isfinite(circles[i].radius) && length > 0 ? 1 : 0;
  }
  std::array<std::optional<double>, kTogether> hits;
  isosurface_.nearest_falling_hits(std::span(duals).first(count), isosurface_.box().diagonal(), hits, stats_.search);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = of[k];
    const auto& [p, a, b] = shapes[i].corners;
    const double radius = circles[i].radius;
    if (!hits[k]) {
      measured[i] = {{circles[i].center, radius * radius}, false, 0, radius};
      continue;
    }
    const Vec3 x = duals[k].at(*hits[k]);
    const double shortest =
        std::sqrt(std::min({squared_distance(p, a), squared_distance(a, b), squared_distance(b, p)}));
    measured[i] = {
        {x, squared_distance(x, p)}, true, badness(std::abs(*hits[k]), radius, shortest, shapes[i].mean_pole), radius};
  }
}

// The largest of the criteria's ratios to their thresholds: above 1 the triangle is too coarse.
double Refinement::badness(double h, double r, double l, double mean_pole) const {
  const double size = options_.criterion2 == Criterion2::kCircumradius ? r : l;
  return std::max({h / (r * options_.epsilon1), size / (mean_pole * options_.epsilon2), r / (l * options_.rho),
                   h / options_.max_distance});
}

double Refinement::mean_pole_height(std::uint32_t triangle) const {
  double mean = 0;
  for (const std::uint32_t v : mesh_.triangles[triangle].corners) mean += mesh_.vertices[v].pole_height / 3;
  return mean;
}

// The same of a triangle of the mesh, by the ball it has.
Refinement::NewTriangle Refinement::measured(std::uint32_t triangle) {
  if (!mesh_.triangles[triangle].has_hit()) return {ball_of(triangle), false, 0, 0};
  const auto [a, b, c] = mesh_.corner_points(mesh_.triangles[triangle].corners);
  const Circumcircle circle = circumcircle(a, b, c);
  const SurfaceDelaunayBall ball = ball_of(triangle);
  const double shortest = std::sqrt(std::min({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)}));
  const double bad = badness(distance(ball.center, circle.center), circle.radius, shortest, mean_pole_height(triangle));
  return {ball, true, bad, circle.radius};
}

// What is learnt of a triangle of the mesh.
void Refinement::learn(std::uint32_t triangle, const NewTriangle& measured) {
  using Triangle = RefinementMesh::Triangle;
  Triangle& t = mesh_.triangles[triangle];
  const bool is_bad = measured.badness > 1, is_large = measured.radius > options_.r_min;
  t.ball = measured.ball;
  t.set(Triangle::kNoHit, !measured.has_hit);
  t.set(Triangle::kTooSmall, is_bad && !is_large);
  t.set(Triangle::kCoarse, is_bad && is_large);
}

// In blocks, on several threads; each block has counters of its own, which are added to ours in order.
std::vector<float> Refinement::measure_all(int threads) {
  const std::size_t count = mesh_.triangles.size();
  std::vector<float> expected(count);
  std::vector<RefineStats> counted(count / kBlockSize + 1);
  for_each_block(count, threads, [&](std::size_t first, std::size_t last) {
    Refinement block(part_, isosurface_, options_, counted[first / kBlockSize]);
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      const NewTriangle now = block.measure({mesh_.corner_points(mesh_.triangles[t].corners), mean_pole_height(t)});
      block.learn(t, now);
      if (!mesh_.triangles[t].is_coarse()) continue;
      // Radii have to get smaller by the badness; r_min may end it before.
      const double times = std::min(now.badness, now.radius / options_.r_min);
      expected[t] = static_cast<float>(std::min(times * times, kMostExpected));
    }
  });
  for (const RefineStats& stats : counted) stats_.search += stats.search;
  return expected;
}

}  // namespace deliso

// What stage 2 measures on triangles: their balls and how far they are from the criteria.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "delaunay/constructions.h"
#include "surface/blocks.h"
#include "surface/refinement.h"

namespace deliso {

// Ball and badness of the triangle pab; a dual line without a falling hit gives its circumball and no further
// refinement.
Refinement::NewTriangle Refinement::measure(const Vec3& p, const Vec3& a, const Vec3& b, double mean_pole) {
  const Circumcircle circle = circumcircle(p, a, b);
  const Vec3 normal = cross(a - p, b - p);
  if (!std::isfinite(circle.radius) || !(norm(normal) > 0))
    return {{p, 0}, false, 0, 0};  // nothing can be measured on it
  const Line dual{circle.center, normal / norm(normal)};
  const auto t = isosurface_.nearest_falling_hit(dual, isosurface_.box().diagonal(), stats_.search);
  if (!t) return {{circle.center, circle.radius * circle.radius}, false, 0, circle.radius};
  const Vec3 x = dual.at(*t);
  const double shortest = std::sqrt(std::min({squared_distance(p, a), squared_distance(a, b), squared_distance(b, p)}));
  return {{x, squared_distance(x, p)}, true, badness(std::abs(*t), circle.radius, shortest, mean_pole), circle.radius};
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

// Calls body(refinement, first, last) for each block of the triangles, on several threads; each block has counters of
// its own, which are added to ours in order.
template <class Body>
void Refinement::for_each_block_of_triangles(Body&& body) {
  const std::size_t count = mesh_.triangles.size();
  std::vector<RefineStats> counted(count / kBlockSize + 1);
  const int threads = part_ == nullptr ? options_.threads : 1;
  for_each_block(count, threads, [&](std::size_t first, std::size_t last) {
    Refinement block(mesh_, isosurface_, options_, counted[first / kBlockSize]);
    body(block, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last));
  });
  for (const RefineStats& stats : counted) {
    stats_.search += stats.search;
    stats_.stopped_at_r_min += stats.stopped_at_r_min;
  }
}

void Refinement::measure_all() {
  for_each_block_of_triangles([](Refinement& block, std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t t = first; t < last; ++t) {
      const RefinementMesh& mesh = block.mesh_;
      const NewTriangle now = block.measure(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), 1);
      block.mesh_.triangles[t].set_ball(now.ball, now.has_hit);
    }
  });
}

void Refinement::count_stopped() {
  for_each_block_of_triangles([](Refinement& block, std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t t = first; t < last; ++t) {
      const NewTriangle now = block.measured(t);
      if (now.badness > 1 && now.radius <= block.options_.r_min) ++block.stats_.stopped_at_r_min;
    }
  });
}

void Refinement::queue_bad_triangles() {
  std::vector<std::vector<std::uint32_t>> bad(mesh_.triangles.size() / kBlockSize + 1);
  for_each_block_of_triangles([&](Refinement& block, std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t t = first; t < last; ++t) {
      if (block.may_be_refined(block.measured(t))) bad[first / kBlockSize].push_back(t);
    }
  });
  const std::uint32_t first = part_ == nullptr ? 0 : part_->frozen;
  for (const std::vector<std::uint32_t>& some : bad) {
    for (const std::uint32_t t : some) {
      if (t >= first) queue_if_bad(t, measured(t));
    }
  }
}

}  // namespace deliso

// Refinement: at its end, vertices move along the isosurface towards the middle of their neighbours where that makes
// the angles around them larger. Ours. Of Laplacian smoothing only steps that improve a star are taken, as in Freitag
// and Ollivier-Gooch (Tetrahedral mesh improvement using swapping and smoothing, 1997).
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "surface/mesh/triangle_shape.h"
#include "surface/refine/refine_loop.h"

namespace deliso {

namespace {

// Squared sines of smallest angles. Around a vertex whose angles are all above 42 degrees there is little to gain; the
// smallest of them may become smaller, but not below 30 degrees.
constexpr double kFine = 0.45, kSmall = 0.25;
// The sum of those of a star has to grow by this factor.
constexpr double kGain = 1.01;
// The whole way to the middle is tried, then half of it.
constexpr int kTries = 2;
// The star is flat where no triangle turns by more than 26 degrees (the cosine) from their mean.
constexpr double kFlat = 0.9;
constexpr std::uint32_t kNoCorner = std::numeric_limits<std::uint32_t>::max();

// The corner (3 t + i) of some triangle from `first` on at each vertex.
std::vector<std::uint32_t> corners_of_vertices(const RefinementMesh& mesh, std::uint32_t first) {
  std::vector<std::uint32_t> corner_of(mesh.vertices.size(), kNoCorner);
  for (std::uint32_t t = first; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) corner_of[mesh.triangles[t].corners[i]] = 3 * t + i;
  }
  return corner_of;
}

}  // namespace

// Vertices of the boundary, and where a criterion fails, stay.
void RefineLoop::smooth_vertices(Controls& controls, int threads) {
  constexpr std::uint32_t kPollsEvery = 1024;  // vertices
  const bool is_rest = part_.smoothing == Smoothing::kRest;
  const std::vector<std::uint32_t> corner_of = corners_of_vertices(mesh_, part_.frozen);
  const std::int64_t moves_before = stats_.moves;
  bool is_moving = true;
  for (int pass = 0; pass < options_.smoothing_passes && is_moving; ++pass) {
    is_moving = false;
    for (std::uint32_t v = 0; v < corner_of.size(); ++v) {
      if (v % kPollsEvery == 0 && controls.poll()) break;
      RefinementMesh::Vertex& vertex = mesh_.vertices[v];
      if (corner_of[v] == kNoCorner || (is_rest && vertex.is_smoothed)) continue;
      if (!disk_.take_star(corner_of[v])) continue;
      if (!is_rest) vertex.is_smoothed = true;
      if (!guard_) guard_.emplace(mesh_, threads);
      if (vertex.is_suspect || !is_fine(disk_.triangles()) || !smooth(v)) continue;
      ++stats_.moves;
      is_moving = true;
    }
  }
  if (options_.observer != nullptr && stats_.moves > moves_before) options_.observer->improved(mesh_, "angles");
}

// Whether all criteria hold, else they rarely would after a move, and the star lies flat: from a crease, which it runs
// along, a vertex would be moved off.
bool RefineLoop::is_fine(std::span<const std::uint32_t> triangles) const {
  const Vec3 sum = disk_.normal_sum();
  const double length = norm(sum);
  return std::all_of(triangles.begin(), triangles.end(), [&](std::uint32_t i) {
    const RefinementMesh::Triangle& t = mesh_.triangles[i];
    if (!t.has_hit() || t.is_too_small() || t.is_coarse() || t.is_refused()) return false;
    const auto [a, b, c] = mesh_.corner_points(t.corners);
    const Vec3 normal = cross(b - a, c - a);
    return dot(normal, sum) > kFlat * norm(normal) * length;
  });
}

RefineLoop::StarAngles RefineLoop::angles_around(const Vec3& p) const {
  StarAngles angles;
  for (const RimEdge& edge : disk_.rim()) {
    const double squared =
        squared_sine_of_least_angle(p, mesh_.vertices[edge.from].point, mesh_.vertices[edge.to].point);
    angles.least = std::min(angles.least, squared);
    angles.sum += squared;
  }
  return angles;
}

// Moves the vertex whose star is E, if that is an improvement.
bool RefineLoop::smooth(std::uint32_t v) {
  const Vec3 old = mesh_.vertices[v].point;
  const StarAngles before = angles_around(old);
  if (!(before.least < kFine)) return false;
  const auto is_better = [&](const Vec3& p) {
    const StarAngles now = angles_around(p);
    return now.least >= std::min(before.least, kSmall) && now.sum > kGain * before.sum;
  };
  const std::span<const RimEdge> rim = disk_.rim();
  Vec3 way;
  for (const RimEdge& edge : rim) way += (mesh_.vertices[edge.from].point - old) / static_cast<double>(rim.size());
  const Vec3 normal = disk_.normal_sum();
  const double length = norm(normal), reach = distance(old, mesh_.vertices[rim.front().from].point);
  if (!(length > 0)) return false;
  for (int i = 0; i < kTries; ++i, way = way / 2) {
    if (!is_better(old + way)) continue;
    const Line line{old + way, normal / length};
    const auto hit = isosurface_.nearest_falling_hit(line, reach, stats_.search);
    if (!hit) continue;
    const Vec3 to = isosurface_.settled(line.at(*hit));
    if (!is_better(to) || !may_move(v, to, reach)) continue;
    move_vertex(v, to);
    return true;
  }
  return false;
}

// Measures the star, all of E, as it would be with its vertex elsewhere. The criteria have to hold.
// The gradient is that of the field on the wall, not of the wall itself: so hardly a vertex on walls moves, which would
// wear off the edges of a closed box (ClosedSolids in the tests).
bool RefineLoop::may_move(std::uint32_t v, const Vec3& to, double reach) {
  if (!part_.slab.contains(to) || !isosurface_.box().contains(to)) return false;
  const Candidate candidate{to, reach, 0, disk_.triangles().front(), kNoSide};
  if (refusal_of_star(candidate, isosurface_.gradient(to))) return false;
  shapes_.clear();
  for (const std::uint32_t t : disk_.triangles()) {
    const std::array<std::uint32_t, 3>& corners = mesh_.triangles[t].corners;
    Shape& shape = shapes_.emplace_back(Shape{mesh_.corner_points(corners), mean_pole_height(t)});
    for (std::size_t i = 0; i < 3; ++i) shape.corners[i] = corners[i] == v ? to : shape.corners[i];
  }
  star_.resize(shapes_.size());
  measure(shapes_, star_);
  return std::all_of(star_.begin(), star_.end(), [](const NewTriangle& t) { return t.has_hit && t.badness <= 1; });
}

// After may_move(). The triangles keep their slots and corners.
void RefineLoop::move_vertex(std::uint32_t v, const Vec3& to) {
  const std::span<const std::uint32_t> triangles = disk_.triangles();
  start_->keep_vertex(v, mesh_);
  for (const std::uint32_t t : triangles) {
    start_->keep(t, mesh_);
    guard_->forget(t);
  }
  RefinementMesh::Vertex& vertex = mesh_.vertices[v];
  const float moved_bound = vertex.clearance + static_cast<float>(distance(vertex.point, to));
  vertex.clearance = std::min(moved_bound, guard_->new_clearance());
  vertex.point = to;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    mesh_.triangles[triangles[i]].renew();
    learn(triangles[i], star_[i]);
    guard_->learn(triangles[i], star_[i].squared_longest);
  }
}

}  // namespace deliso

#include "surface/refine/guard/crossing_guard.h"

#include <algorithm>
#include <cmath>

#include "delaunay/triangle_contact.h"
#include "surface/base/parallel_blocks.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

namespace {

// A triangle is tight when its clearance is below its longest edge times this.
constexpr double kTightness = 1.5;
// Other sheets are tested for when the clearance is below this times the distance that the mesh moves.
constexpr double kReach = 15;
// The surface lies far from a triangle whose ball is larger than its box by this factor.
constexpr double kFarBall = 1.3;
// A star can fold over its neighbours when the mesh moves by more than this fraction of the rim's distance from p.
constexpr double kFoldingMove = 0.1;

bool is_tight(double squared_longest, float clearance) {
  return clearance * clearance < kTightness * kTightness * squared_longest;
}

double squared_longest_edge(const std::array<Vec3, 3>& points) {
  return std::max({squared_distance(points[0], points[1]), squared_distance(points[1], points[2]),
                   squared_distance(points[2], points[0])});
}

Box3 box_of(std::span<const Vec3> points) {
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

bool has_area(const std::array<Vec3, 3>& points) { return deliso::has_area(points[0], points[1], points[2]); }

}  // namespace

CrossingGuard::CrossingGuard(RefinementMesh& mesh, int threads) : mesh_(mesh) {
  const auto triangles_that = [&](const auto& holds) {
    const std::size_t count = mesh.triangles.size();
    return collect_in_blocks<std::uint32_t>(count, threads, [&](std::size_t i, std::vector<std::uint32_t>& found) {
      const auto t = static_cast<std::uint32_t>(i);
      if (holds(t)) found.push_back(t);
    });
  };
  for (const std::uint32_t t : triangles_that([&](std::uint32_t i) { return !mesh.triangles[i].has_hit(); })) {
    for (const std::uint32_t v : mesh.triangles[t].corners) mesh.vertices[v].is_suspect = true;
  }
  for (const std::uint32_t t : triangles_that([&](std::uint32_t i) { return is_tight(i); })) {
    tight_.add(t, mesh.box_of(t));
  }
}

void CrossingGuard::learn(std::uint32_t triangle) {
  if (is_tight(triangle)) tight_.add(triangle, mesh_.box_of(triangle));
}

void CrossingGuard::learn(std::uint32_t triangle, double squared_longest) {
  if (deliso::is_tight(squared_longest, effective_clearance(mesh_.triangles[triangle].corners)))
    tight_.add(triangle, mesh_.box_of(triangle));
}

void CrossingGuard::forget(std::uint32_t triangle) {
  if (!tight_.holds(triangle)) return;
  tight_.remove(triangle, mesh_.box_of(triangle));
}

void CrossingGuard::mark_if_far_off(std::uint32_t triangle) {
  const RefinementMesh::Triangle& t = mesh_.triangles[triangle];
  const Vec3 size = mesh_.box_of(triangle).size();
  if (t.has_hit() && t.ball.squared_radius < kFarBall * kFarBall * squared_norm(size)) return;
  for (std::uint32_t i = 0; i < 3; ++i) {
    bool& is_suspect = mesh_.vertices[t.corners[i]].is_suspect;
    if (is_suspect) continue;
    is_suspect = true;
    // All triangles around this corner have become tight.
    const std::uint32_t first = 3 * triangle + i;
    for_each_corner_of_fan(
        first, [&](TriangleSide side) { return mesh_.triangles[side >> 2].neighbours[side & 3u]; },
        [&](std::uint32_t corner) {
          if (!tight_.holds(corner / 3)) learn(corner / 3);
          return corner != first;
        });
  }
}

bool CrossingGuard::is_tight(std::uint32_t triangle) const {
  const auto& corners = mesh_.triangles[triangle].corners;
  return deliso::is_tight(squared_longest_edge(mesh_.corner_points(corners)), effective_clearance(corners));
}

CrossingGuard::PlacedTriangle CrossingGuard::star_triangle(const Vec3& p, const RimEdge& edge) const {
  const std::array<Vec3, 3> points = {p, mesh_.vertices[edge.from].point, mesh_.vertices[edge.to].point};
  return {{static_cast<std::uint32_t>(mesh_.vertices.size()), edge.from, edge.to}, points, box_of(points)};
}

bool CrossingGuard::meets(const PlacedTriangle& s, const PlacedTriangle& t) {
  return s.box.meets(t.box) && has_area(t.points) &&
         triangle_contact(s.corners, s.points, t.corners, t.points) != TriangleContact::kNone;
}

CrossingGuard::PlacedTriangle CrossingGuard::placed(const std::array<std::uint32_t, 3>& corners) const {
  const std::array<Vec3, 3> points = mesh_.corner_points(corners);
  return {corners, points, box_of(points)};
}

// Computes the clearance of p from those of the rim's vertices; returns the least effective clearance on the rim.
float CrossingGuard::clearance_at(const Vec3& p, std::span<const RimEdge> rim) {
  const auto bound = [&](std::uint32_t v) {
    return static_cast<float>(distance(p, mesh_.vertices[v].point)) + mesh_.vertices[v].clearance;
  };
  new_clearance_ = bound(rim.front().from);
  float mean = 0;
  float least = new_clearance_;
  for (const RimEdge& edge : rim) {
    least = std::min(least, effective_clearance(edge.from));
    mean += mesh_.vertices[edge.from].clearance / static_cast<float>(rim.size());
    new_clearance_ = std::min(new_clearance_, bound(edge.from));
  }
  new_clearance_ = std::min(new_clearance_, mean);
  return least;
}

// Tests the whole star against the triangle beyond an edge of the rim, if the mesh turns by more than a right angle at
// that edge.
bool CrossingGuard::folds(const Vec3& p, std::span<const RimEdge> rim) {
  for (const RimEdge& edge : rim) {
    if (edge.outer == kNoSide) continue;
    const std::uint32_t beyond = edge.outer >> 2;
    const Vec3 &from = mesh_.vertices[edge.from].point, &to = mesh_.vertices[edge.to].point;
    const auto [a, b, c] = mesh_.corner_points(mesh_.triangles[beyond].corners);
    if (dot(cross(from - p, to - p), cross(b - a, c - a)) >= 0) continue;
    const PlacedTriangle across = placed(beyond);
    for (const RimEdge& other : rim) {
      const PlacedTriangle s = star_triangle(p, other);
      if (has_area(s.points) && meets(s, across)) return true;
    }
  }
  return false;
}

// Whether the star, projected along `up`, goes around p exactly once: then no two of its triangles meet.
bool CrossingGuard::lies_around(const Vec3& p, const Vec3& up) const {
  // If all triangles turn left around p, a closed star passes the half-plane on one side of p once per turn.
  if (star_.front().corners[1] != star_.back().corners[2]) return false;
  const Vec3 across = cross(up, star_.front().points[1] - p);
  int turns = 0;
  for (const PlacedTriangle& s : star_) {
    const Vec3 from = s.points[1] - p, to = s.points[2] - p;
    if (!(dot(cross(from, to), up) > 0)) return false;
    turns += dot(across, from) < 0 && dot(across, to) >= 0 ? 1 : 0;
  }
  return turns == 1;
}

bool CrossingGuard::star_meets_itself() const {
  for (const std::size_t i : tight_in_star_) {
    for (std::size_t j = 0; j < star_.size(); ++j) {
      if (j != i && meets(star_[i], star_[j])) return true;
    }
  }
  return false;
}

bool CrossingGuard::crosses(const Vec3& p, const Vec3& up, double moved, const RefinementDisk& disk) {
  const std::span<const RimEdge> rim = disk.rim();
  const float least = clearance_at(p, rim);
  if (moved > kFoldingMove * distance(p, mesh_.vertices[rim.front().from].point) && folds(p, rim)) return true;
  if (least > kReach * moved) return false;

  // The tight triangles of the star must not meet other triangles of the star,
  star_.clear();
  tight_in_star_.clear();
  Box3 box;
  for (const RimEdge& edge : rim) {
    const float clearance =
        std::min(new_clearance_, std::min(effective_clearance(edge.from), effective_clearance(edge.to)));
    const PlacedTriangle& s = star_.emplace_back(star_triangle(p, edge));
    if (!deliso::is_tight(squared_longest_edge(s.points), clearance)) continue;
    if (!has_area(s.points)) return true;
    tight_in_star_.push_back(star_.size() - 1);
    box.extend(s.box.low);
    box.extend(s.box.high);
  }
  if (tight_in_star_.empty()) return false;
  if (!lies_around(p, up) && star_meets_itself()) return true;
  // nor tight triangles that stay in the mesh.
  near_.clear();
  tight_.append_near(box, near_);
  return std::any_of(near_.begin(), near_.end(), [&](std::uint32_t t) {
    if (mesh_.triangles[t].attempt == disk.attempt()) return false;
    const PlacedTriangle other = placed(t);
    return std::any_of(tight_in_star_.begin(), tight_in_star_.end(),
                       [&](std::size_t i) { return meets(star_[i], other); });
  });
}

bool CrossingGuard::crosses_flipped(const std::array<std::uint32_t, 3>& s, const std::array<std::uint32_t, 3>& t,
                                    std::uint32_t old_s, std::uint32_t old_t) {
  for (const PlacedTriangle& flipped : {placed(s), placed(t)}) {
    if (!has_area(flipped.points)) return true;
    near_.clear();
    tight_.append_near(flipped.box, near_);
    for (const std::uint32_t other : near_) {
      if (other != old_s && other != old_t && meets(flipped, placed(other))) return true;
    }
  }
  return false;
}

}  // namespace deliso

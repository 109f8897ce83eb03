// E of stage 2 (Dey and Levine, section 2.2.2, Figure 3): the triangles that an insertion replaces, and the rim around
// them. The disk D, which replaces them, is made by RefineLoop::plan_star and RefineLoop::replace_disk.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/refine/disk/refinement_candidates.h"
#include "surface/refine/disk/refinement_mesh.h"

namespace deliso {

// An edge of the rim, directed as in the triangle of E, and the side of the triangle beyond.
struct RimEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  TriangleSide outer = kNoSide;
};

// Grown anew for every attempted insertion; marks triangles and vertices of the mesh with the attempt's number.
class RefinementDisk {
 public:
  enum class Shape { kDisk, kNotADisk, kRepeatedVertex };

  // The first `frozen` triangles of the mesh must not be replaced.
  explicit RefinementDisk(RefinementMesh& mesh, std::uint32_t frozen = 0) : mesh_(mesh), frozen_(frozen) {}

  // Finds E: the triangles reached from the candidate's seed whose balls hold its point, or the two at a halved edge;
  // and the edges around E. ball_of(t) gives B_sigma; its result for triangles already in E does not matter.
  template <class BallOf>
  void grow(const RefinementCandidate& candidate, BallOf&& ball_of);

  // Brings the rim into order. E is a disk without inner vertices, so that none is lost, when the rim is one cycle (for
  // a boundary split, one path) that passes every vertex once and has as many edges as such a disk.
  [[nodiscard]] Shape order_rim(const RefinementCandidate& candidate);

  // A boundary edge of E whose diametral ball holds the point; or, if the point lies beyond the box, any boundary edge
  // of E.
  [[nodiscard]] std::optional<TriangleSide> encroached_boundary_edge(const RefinementCandidate& candidate,
                                                                     const Box3& box) const;
  // Whether E would include a frozen triangle.
  [[nodiscard]] bool is_blocked() const { return is_blocked_; }
  // Takes all triangles around the vertex at a corner (3 t + i) for E, whose rim is then in order: rim()[i] is that of
  // triangles()[i]. False when one of them is frozen, or the vertex is on the boundary.
  [[nodiscard]] bool take_star(std::uint32_t corner);
  // The sum of the normals of E's triangles, each as long as twice its area.
  [[nodiscard]] Vec3 normal_sum() const;
  // The largest distance of p from the planes of E's triangles.
  [[nodiscard]] double distance_to(const Vec3& p) const;

  [[nodiscard]] std::uint32_t attempt() const { return attempt_; }
  [[nodiscard]] std::span<const std::uint32_t> triangles() const { return std::span(triangles_).first(size_); }
  [[nodiscard]] bool holds(std::uint32_t triangle) const { return mesh_.triangles[triangle].attempt == attempt_; }
  [[nodiscard]] std::span<const RimEdge> rim() const { return std::span(rim_).first(rim_size_); }

 private:
  // Adds a triangle to E if `is_so`, without a branch, because this is unpredictable. There must be room.
  void take_if(bool is_so, std::uint32_t triangle) {
    std::uint32_t& attempt = mesh_.triangles[triangle].attempt;
    attempt = is_so ? attempt_ : attempt;
    is_blocked_ |= is_so & (triangle < frozen_);
    triangles_[size_] = triangle;
    size_ += static_cast<std::size_t>(is_so);
  }
  void find_rim(const RefinementCandidate& candidate);

  RefinementMesh& mesh_;
  std::uint32_t frozen_;
  std::uint32_t attempt_ = 0;
  bool is_blocked_ = false;
  std::vector<std::uint32_t> triangles_;  // E is the first size_ elements; the rest is room
  std::size_t size_ = 0;
  std::vector<RimEdge> rim_;  // the rim is the first rim_size_ elements; the rest is room
  std::size_t rim_size_ = 0;
  std::vector<RimEdge> ordered_;
};

template <class BallOf>
void RefinementDisk::grow(const RefinementCandidate& candidate, BallOf&& ball_of) {
  ++attempt_;
  is_blocked_ = false;
  size_ = 0;
  triangles_.resize(std::max<std::size_t>(triangles_.size(), 8));
  take_if(true, candidate.seed);
  if (candidate.halved != kNoSide) {
    take_if(true, mesh_.triangles[candidate.halved >> 2].neighbours[candidate.halved & 3u] >> 2);
  } else {
    for (std::size_t i = 0; i < size_; ++i) {
      if (size_ + 3 > triangles_.size()) triangles_.resize(2 * triangles_.size());
      const std::uint32_t within = triangles_[i];
      for (const TriangleSide side : mesh_.triangles[within].neighbours) {
        const std::uint32_t t = side == kNoSide ? within : side >> 2;
        const SurfaceDelaunayBall ball = ball_of(t);
        const bool is_near = squared_distance(candidate.point, ball.center) < ball.squared_radius;
        take_if(!holds(t) & is_near, t);
      }
    }
  }
  find_rim(candidate);
}

}  // namespace deliso

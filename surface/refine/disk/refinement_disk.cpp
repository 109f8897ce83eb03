#include "surface/refine/disk/refinement_disk.h"

#include <algorithm>
#include <utility>

namespace deliso {

void RefinementDisk::find_rim(const RefinementCandidate& candidate) {
  // Which sides are on the rim is unpredictable: all are written, and those not on the rim are overwritten.
  std::size_t size = 0;
  if (rim_.size() < 3 * size_) rim_.resize(3 * size_);
  for (const std::uint32_t t : triangles()) {
    const RefinementMesh::Triangle& triangle = mesh_.triangles[t];
    for (unsigned i = 0; i < 3; ++i) {
      const TriangleSide outer = triangle.neighbours[i];
      const bool is_inner = outer != kNoSide && holds(outer >> 2);
      rim_[size] = {triangle.corners[(i + 1) % 3], triangle.corners[(i + 2) % 3], outer};
      size += static_cast<std::size_t>(!is_inner) & static_cast<std::size_t>(4 * t + i != candidate.split);
    }
  }
  rim_size_ = size;
}

RefinementDisk::Shape RefinementDisk::order_rim(const RefinementCandidate& candidate) {
  const bool closed = candidate.split == kNoSide;
  if (rim_size_ != size_ + (closed ? 2 : 1)) return Shape::kNotADisk;
  for (std::uint32_t i = 0; i < rim_size_; ++i) {
    RefinementMesh::Vertex& from = mesh_.vertices[rim_[i].from];
    if (from.attempt == attempt_) return Shape::kRepeatedVertex;
    from.attempt = attempt_;
    from.rim_place = i;
  }
  std::uint32_t at = rim_.front().from;
  if (!closed) at = mesh_.triangles[candidate.split >> 2].corners[((candidate.split & 3u) + 2) % 3];
  ordered_.clear();
  while (ordered_.size() < rim_size_ && mesh_.vertices[at].attempt == attempt_) {
    ordered_.push_back(rim_[mesh_.vertices[at].rim_place]);
    at = ordered_.back().to;
    if (closed && at == rim_.front().from) break;
  }
  if (ordered_.size() != rim_size_) return Shape::kNotADisk;
  if (!closed && mesh_.vertices[at].attempt == attempt_) return Shape::kRepeatedVertex;
  std::swap(rim_, ordered_);
  return Shape::kDisk;
}

std::optional<TriangleSide> RefinementDisk::encroached_boundary_edge(const RefinementCandidate& candidate,
                                                                     const Box3& box) const {
  const bool outside = !box.contains(candidate.point);
  for (const std::uint32_t t : triangles()) {
    for (unsigned i = 0; i < 3; ++i) {
      if (mesh_.triangles[t].neighbours[i] != kNoSide) continue;
      const Vec3& a = mesh_.corner(t, i + 1);
      const Vec3& b = mesh_.corner(t, i + 2);
      if (outside || dot(a - candidate.point, b - candidate.point) < 0) return 4 * t + i;
    }
  }
  return std::nullopt;
}

bool RefinementDisk::take_star(std::uint32_t corner) {
  ++attempt_;
  size_ = rim_size_ = 0;
  for (std::uint32_t at = corner;;) {
    const std::uint32_t t = at / 3, i = at % 3;
    RefinementMesh::Triangle& triangle = mesh_.triangles[t];
    if (t < frozen_) return false;
    if (triangles_.size() <= size_) triangles_.resize(2 * size_ + 8);
    if (rim_.size() <= rim_size_) rim_.resize(2 * rim_size_ + 8);
    triangle.attempt = attempt_;
    triangles_[size_++] = t;
    rim_[rim_size_++] = {triangle.corners[(i + 1) % 3], triangle.corners[(i + 2) % 3], triangle.neighbours[i]};
    const TriangleSide next = triangle.neighbours[(i + 1) % 3];
    if (next == kNoSide) return false;
    at = 3 * (next >> 2) + ((next & 3u) + 1) % 3;
    if (at == corner) return true;
  }
}

Vec3 RefinementDisk::normal_sum() const {
  Vec3 sum;
  for (const std::uint32_t t : triangles()) {
    const auto [a, b, c] = mesh_.corner_points(mesh_.triangles[t].corners);
    sum += cross(b - a, c - a);
  }
  return sum;
}

double RefinementDisk::distance_to(const Vec3& p) const {
  double farthest = 0;
  for (const std::uint32_t t : triangles()) {
    const auto [a, b, c] = mesh_.corner_points(mesh_.triangles[t].corners);
    const Vec3 normal = cross(b - a, c - a);
    farthest = std::max(farthest, std::abs(dot(normal, p - a)) / std::max(norm(normal), 1e-300));
  }
  return farthest;
}

}  // namespace deliso

#include "surface/refine/disk/refinement_candidates.h"

#include <algorithm>
#include <cmath>

namespace deliso {

namespace {

// A boundary edge is split only at least this far from its ends, as a fraction of its length.
constexpr double kNearestEnd = 0.2;
// And only where it is not that much shorter than its triangle's other edges: the triangle would become a fan of needles
// that are as long as it is.
constexpr double kShortest = 0.1;
// A halved edge may have a vertex this near to its middle, as a fraction of its length: coarse slivers have one there.
constexpr double kNearestToMiddle = 0.03;
// Edges shorter than this (mesh-space units) may not: they are halved for their distance, not for their shape.
constexpr double kLongEdge = 1.5, kNearestToShort = 0.4;

// A coverage target is not inserted so near to a vertex (mesh-space units).
constexpr double kTargetToVertex = 0.3;
// The radius that stands for that of a ball, in distances from the nearest triangle: folded disks lie farther off the
// target.
constexpr double kTargetRadius = 2;

}  // namespace

RefinementCandidate target_candidate(const MissedTarget& missed, double r_min) {
  const double radius = kTargetRadius * std::sqrt(missed.squared_distance);
  return {missed.point, radius, std::max(kTargetToVertex, r_min), missed.triangle, kNoSide, kNoSide, true};
}

std::optional<RefinementCandidate> boundary_candidate(const RefinementMesh& mesh, const Isosurface& isosurface,
                                                      TriangleSide side, double r_min, SearchCounters& counters) {
  const std::uint32_t t = side >> 2;
  const Vec3& a = mesh.corner(t, (side & 3u) + 1);
  const Vec3& b = mesh.corner(t, (side & 3u) + 2);
  const Box3& box = isosurface.box();
  Vec3 outward;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a[axis] == box.low[axis] && b[axis] == box.low[axis]) outward[axis] = -1;
    if (a[axis] == box.high[axis] && b[axis] == box.high[axis]) outward[axis] = 1;
  }
  if (squared_norm(outward) != 1) return std::nullopt;
  // Seen from below the mesh lies left of ab and the box's outside right of it.
  const Vec3 towards_lower = cross(outward, b - a);
  const Vec3& apex = mesh.corner(t, side & 3u);
  const double length = distance(a, b);
  if (length <= std::max(r_min, kShortest * std::max(distance(a, apex), distance(b, apex)))) return std::nullopt;
  const Line line{0.5 * (a + b), towards_lower / norm(towards_lower)};
  const auto hit = isosurface.nearest_falling_hit(line, length, counters);
  if (!hit || !box.contains(line.at(*hit))) return std::nullopt;
  return RefinementCandidate{line.at(*hit), 2 * kNearestEnd * length, kNearestEnd * length, t, side};
}

std::optional<RefinementCandidate> halving_candidate(const RefinementMesh& mesh, const Isosurface& isosurface,
                                                     std::uint32_t triangle, double least_edge, double r_min,
                                                     SearchCounters& counters) {
  const auto length = [&](unsigned i) { return distance(mesh.corner(triangle, i + 1), mesh.corner(triangle, i + 2)); };
  unsigned longest = 0;
  for (unsigned i = 1; i < 3; ++i) {
    if (length(i) > length(longest)) longest = i;
  }
  const double edge = length(longest);
  const TriangleSide across = mesh.triangles[triangle].neighbours[longest];
  if (edge < std::max(least_edge, 2 * r_min) || across == kNoSide) return std::nullopt;
  const Vec3& a = mesh.corner(triangle, longest + 1);
  const Vec3& b = mesh.corner(triangle, longest + 2);
  const auto normal = [&](std::uint32_t t) {
    const Vec3 n = cross(mesh.corner(t, 1) - mesh.corner(t, 0), mesh.corner(t, 2) - mesh.corner(t, 0));
    return n / std::max(norm(n), 1e-300);
  };
  const Vec3 sum = normal(triangle) + normal(across >> 2);
  if (!(norm(sum) > 0)) return std::nullopt;
  const Line line{0.5 * (a + b), sum / norm(sum)};
  const auto hit = isosurface.nearest_falling_hit(line, 0.5 * edge, counters);
  if (!hit || !isosurface.box().contains(line.at(*hit))) return std::nullopt;
  const double nearest = std::max((edge < kLongEdge ? kNearestToShort : kNearestToMiddle) * edge, r_min);
  return RefinementCandidate{line.at(*hit), 0.5 * edge, nearest, triangle, kNoSide, 4 * triangle + longest};
}

}  // namespace deliso

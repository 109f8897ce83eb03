// Refinement: insertion of coverage targets that the mesh has missed.
#include <algorithm>
#include <cmath>
#include <vector>

#include "raycast/gradients_at.h"
#include "surface/refine/disk/coverage_targets.h"
#include "surface/refine/refine_loop.h"

namespace deliso {

// Inserts points that are x_sigma of no triangle. For each triangle that is nearest to missed coverage targets, tries
// them from the farthest on, and inserts the first that passes the checks. Returns whether any was inserted.
bool RefineLoop::insert_coverage_targets(Controls& controls, int threads) {
  if (part_.coverage_targets.empty() || controls.poll()) return false;
  const bool is_bounded = std::isfinite(options_.max_distance);
  const bool is_all = options_.target_reach > 0;
  const double usual = std::max(options_.r_min, is_bounded ? options_.max_distance : 0);
  // Balls that are not stored are searched again, and these searches are counted.
  const std::vector<MissedTarget> missed = missed_targets(
      part_.coverage_targets, mesh_, [this](std::uint32_t t) { return ball_of(t); },
      is_all ? options_.target_reach : usual, options_.store_hits ? threads : 1, is_all);
  if (missed.empty()) return false;
  if (!guard_) guard_.emplace(mesh_, threads);
  const auto generation = [&](const MissedTarget& m) {
    return mesh_.triangles[m.triangle].state | RefinementMesh::Triangle::kFlags;
  };
  std::vector<std::uint32_t> generations;  // of the nearest triangles
  generations.reserve(missed.size());
  for (const MissedTarget& m : missed) generations.push_back(generation(m));
  const std::int64_t before = stats_.coverage_targets;
  for (std::size_t i = 0; i < missed.size(); ++i) {
    if (controls.must_stop("refine", mesh_.vertices.size(), missed.size() - i)) break;
    if (generation(missed[i]) != generations[i]) continue;
    if (insert(target_candidate(missed[i], options_.r_min), nullptr)) continue;
    wake_neighbours();
    ++stats_.insertions;
    ++stats_.coverage_targets;
  }
  return stats_.coverage_targets > before;
}

// The direction from which all triangles of the star must be seen counterclockwise: that of the gradient. At the tip of
// a thin finger the gradient jumps. There the normal of the disk E, on which the finger stands, is more reliable,
// unless the mean gradient around the tip contradicts it.
Vec3 RefineLoop::upwards(const Candidate& candidate) const {
  if (!candidate.is_coverage_target) return isosurface_.gradient(candidate.point);
  Vec3 mean;
  for_each_gradient_at(isosurface_, candidate.point,
                       [&](const Vec3& gradient) { mean += gradient / std::max(norm_of_any_size(gradient), 1e-300); });
  const Vec3 down = disk_.normal_sum();
  return dot(mean, down) < 0 ? -down : mean;
}

}  // namespace deliso

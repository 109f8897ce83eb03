#include "surface/refine.h"

#include <span>
#include <utility>
#include <vector>

#include "delaunay/base/parallel.h"
#include "surface/crossing_guard.h"
#include "surface/refinement.h"
#include "surface/refinement_slabs.h"
#include "surface/self_intersection.h"

namespace deliso {

namespace {

// Starts again at most this often, with at most so many new suspects of a kind.
constexpr std::int64_t kMostRestarts = 3;
constexpr std::size_t kMostSuspects = 1000;

// Refines the slabs apart from each other. Of their counters those of insertions count; what they refused is tried
// again in the whole.
void refine_slabs(RefinementMesh& mesh, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
                  RefineStats& stats) {
  RefinementSlabs slabs(mesh, options.slab_triangles);
  std::vector<RefinementPart>& parts = slabs.parts();
  if (parts.empty()) return;
  std::vector<RefineStats> counted(parts.size());
  std::vector<Controls> limits;
  for (const RefinementPart& part : parts) {
    const std::size_t vertices = mesh.vertices.size();
    limits.push_back(controls.for_part(1.0 / static_cast<double>(parts.size()), vertices, part.mesh.vertices.size()));
  }
  run_tasks(parts.size(), options.threads,
            [&](std::size_t k) { Refinement(parts[k], isosurface, options, counted[k]).run(limits[k]); });
  slabs.join(mesh);
  controls.poll();  // what made parts stop stops the rest
  for (const RefineStats& part : counted) {
    stats.insertions += part.insertions;
    stats.boundary_splits += part.boundary_splits;
    stats.halvings += part.halvings;
    stats.search += part.search;
  }
}

// Adds the places where triangles of the mesh cross or touch; false when there are none.
bool add_crossings(const SurfaceMesh& mesh, int threads, std::vector<Vec3>& suspects) {
  const SelfIntersections found = self_intersections(mesh.points, mesh.triangles, kMostSuspects, threads);
  for (const auto* pairs : {&found.crossing, &found.touching}) {
    for (const TrianglePair& pair : *pairs) suspects.push_back(pair.position);
  }
  return !found.crossing.empty() || !found.touching.empty();
}

struct Refined {
  SurfaceMesh mesh;
  std::vector<SurfaceDelaunayBall> balls;
  RefineStats stats;
};

// Refines from the start, with no trust near the suspects.
Refined refined_once(const SurfaceMesh& start, const Isosurface& isosurface, const RefineOptions& options,
                     std::span<const Vec3> suspects, Controls& controls, bool with_balls) {
  Refined result;
  RefinementMesh mesh(start);
  set_clearances(mesh, suspects);
  Refinement(mesh, isosurface, options, result.stats).measure_all();
  refine_slabs(mesh, isosurface, options, controls, result.stats);
  Refinement rest(mesh, isosurface, options, result.stats);
  rest.run(controls);
  rest.count_stopped();
  for (std::size_t t = 0; with_balls && t < mesh.triangles.size(); ++t) result.balls.push_back(mesh.triangles[t].ball);
  mesh.move_to(result.mesh);
  return result;
}

}  // namespace

void refine(SurfaceMesh& mesh, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
            RefineStats& stats, std::vector<SurfaceDelaunayBall>* balls) {
  if (controls.stopped()) return;
  std::vector<Vec3> suspects;
  SearchCounters searches;
  Refined last;
  for (std::int64_t restarts = 0;; ++restarts) {
    Refined refined = refined_once(mesh, isosurface, options, suspects, controls, balls != nullptr);
    searches += refined.stats.search;
    refined.stats.restarts = restarts;
    // A restart that had to stop half-way is worth less than what was finished before.
    if (restarts == 0 || !controls.stopped()) last = std::move(refined);
    const bool may_restart = options.restart_at_crossings && restarts < kMostRestarts && !controls.poll();
    if (!may_restart || !add_crossings(last.mesh, options.threads, suspects)) break;
  }
  mesh = std::move(last.mesh);
  if (balls != nullptr) *balls = std::move(last.balls);
  last.stats.seconds = stats.seconds;
  last.stats.search = stats.search;
  last.stats.search += searches;
  stats = last.stats;
}

}  // namespace deliso

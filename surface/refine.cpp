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
void refine_slabs(RefinementMesh& mesh, const Isosurface& isosurface, const RefineOptions& options,
                  const Controls& controls, RefineStats& stats) {
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

// Refines from the start, with no trust near the suspects.
SurfaceMesh refined_once(const SurfaceMesh& start, const Isosurface& isosurface, const RefineOptions& options,
                         std::span<const Vec3> suspects, Controls& controls, RefineStats& stats,
                         std::vector<SurfaceDelaunayBall>* balls) {
  RefinementMesh mesh(start);
  set_clearances(mesh, suspects);
  Refinement(mesh, isosurface, options, stats).measure_all();
  refine_slabs(mesh, isosurface, options, controls, stats);
  Refinement rest(mesh, isosurface, options, stats);
  rest.run(controls);
  rest.count_stopped();
  if (balls != nullptr) {
    balls->clear();
    for (const RefinementMesh::Triangle& t : mesh.triangles) balls->push_back(t.ball);
  }
  SurfaceMesh refined;
  mesh.move_to(refined);
  return refined;
}

}  // namespace

void refine(SurfaceMesh& mesh, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
            RefineStats& stats, std::vector<SurfaceDelaunayBall>* balls) {
  const RefineStats before = stats;
  std::vector<Vec3> suspects;
  for (std::int64_t restarts = 0;; ++restarts) {
    const SearchCounters searches = stats.search;
    stats = before;
    stats.search = searches;
    stats.restarts = restarts;
    SurfaceMesh refined = refined_once(mesh, isosurface, options, suspects, controls, stats, balls);
    const bool is_last = !options.restart_at_crossings || restarts == kMostRestarts || controls.stopped();
    if (is_last || !add_crossings(refined, options.threads, suspects)) {
      mesh = std::move(refined);
      return;
    }
  }
}

}  // namespace deliso

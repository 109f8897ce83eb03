#include "surface/refine.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/base/parallel.h"
#include "surface/crossing_guard.h"
#include "surface/refinement.h"
#include "surface/refinement_crossings.h"
#include "surface/refinement_slabs.h"

namespace deliso {

namespace {

// Starts again at most this often.
constexpr std::int64_t kMostRestarts = 3;

std::int64_t count_of(const SelfIntersections& found) { return found.crossing_pairs + found.touching_pairs; }

void add_places(const SelfIntersections& found, std::vector<Vec3>& suspects) {
  for (const auto* pairs : {&found.crossing, &found.touching}) {
    for (const TrianglePair& pair : *pairs) suspects.push_back(pair.position);
  }
}

// Refines a part; again from where it began, with no trust around them, when more triangles of the result meet than
// before. What has the fewest such pairs stays.
void refine_part(RefinementPart& part, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
                 int threads, RefineStats& stats) {
  const auto run = [&](RefineStats& counted) { Refinement(part, isosurface, options, counted).run(controls); };
  const RefinementMesh start = options.restart_at_crossings ? part.mesh : RefinementMesh();
  run(stats);
  if (!options.restart_at_crossings) return;
  SelfIntersections found = meeting_pairs(part.mesh, threads);
  std::int64_t fewest = count_of(found);
  if (fewest == 0) return;
  const std::int64_t before = count_of(meeting_pairs(start, threads));
  std::vector<Vec3> suspects;
  for (std::int64_t restarts = 1; restarts <= kMostRestarts && fewest > before && !controls.poll(); ++restarts) {
    add_places(found, suspects);
    RefinementMesh least = std::exchange(part.mesh, start);
    distrust(part.mesh, suspects);
    RefineStats counted;
    run(counted);
    found = meeting_pairs(part.mesh, threads);
    counted.search += stats.search;
    // A restart that had to stop half-way is worth less than what was finished before.
    if (count_of(found) < fewest && !controls.stopped()) {
      fewest = count_of(found);
      stats = counted;
    } else {
      stats.search = counted.search;
      part.mesh = std::move(least);
    }
    stats.restarts = restarts;
  }
}

// Refines in the whole what the slabs refused. Where new triangles meet others, all of it is taken back and done again
// with no trust around them, up to three times.
void refine_rest(RefinementMesh& mesh, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
                 RefineStats& stats) {
  for (std::int64_t restarts = 0;; ++restarts) {
    RefineStats counted;
    Refinement rest(mesh, isosurface, options, counted);
    rest.run_on_trial(controls);
    stats.search += counted.search;
    SelfIntersections found;
    if (options.restart_at_crossings) found = meeting_pairs_of_renewed(mesh, options.threads);
    if (count_of(found) == 0 || restarts == kMostRestarts || controls.poll()) {
      stats.add_insertions(counted);
      stats.refused = counted.refused;
      stats.restarts += restarts;
      return;
    }
    std::vector<Vec3> suspects;
    add_places(found, suspects);
    rest.take_back();
    distrust(mesh, suspects);
  }
}

// Refines the slabs apart from each other, then the rest. Of the counters of slabs those of insertions count.
void refine_slabs(RefinementMesh& mesh, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
                  RefineStats& stats) {
  RefinementSlabs slabs(mesh, options.slab_triangles);
  std::vector<RefinementPart>& parts = slabs.parts();
  std::vector<RefineStats> counted(parts.size());
  std::vector<Controls> limits;
  for (const RefinementPart& part : parts) {
    const std::size_t vertices = mesh.vertices.size();
    limits.push_back(controls.for_part(1.0 / static_cast<double>(parts.size()), vertices, part.mesh.vertices.size()));
  }
  // A mesh in one part uses the limits and the threads of the whole.
  const bool is_whole = parts.size() == 1;
  run_tasks(parts.size(), options.threads, [&](std::size_t k) {
    refine_part(parts[k], isosurface, options, is_whole ? controls : limits[k], is_whole ? options.threads : 1,
                counted[k]);
  });
  slabs.join(mesh);
  controls.poll();  // what made parts stop stops the rest
  for (const RefineStats& part : counted) {
    stats.add_insertions(part);
    stats.restarts += part.restarts;
    stats.search += part.search;
  }
  if (is_whole) {
    stats.refused = counted.front().refused;
  } else {
    refine_rest(mesh, isosurface, options, controls, stats);
  }
}

}  // namespace

void refine(SurfaceMesh& mesh, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
            RefineStats& stats, std::vector<SurfaceDelaunayBall>* balls) {
  if (controls.stopped()) return;
  RefinementMesh refined(mesh);
  set_clearances(refined);
  Refinement(refined, isosurface, options, stats).measure_all();
  refine_slabs(refined, isosurface, options, controls, stats);
  Refinement(refined, isosurface, options, stats).count_stopped();
  if (balls != nullptr) {
    balls->clear();
    for (const RefinementMesh::Triangle& t : refined.triangles) balls->push_back(t.ball);
  }
  refined.move_to(mesh);
}

}  // namespace deliso

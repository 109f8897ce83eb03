#include "surface/refine/refine.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/memory.h"
#include "surface/refine/guard/clearances.h"
#include "surface/refine/guard/refinement_crossings.h"
#include "surface/refine/refine_loop.h"
#include "surface/refine/slabs/refinement_planes.h"
#include "surface/refine/slabs/refinement_slabs.h"

namespace deliso {

namespace {

// The largest number of restarts.
constexpr std::int64_t kMostRestarts = 3;

// Memory that slabs leave behind in small pieces matters only if they are nearly all of the mesh; giving it back takes
// time.
constexpr std::size_t kSlabsNearPeak = 1;

// kSeams: along the planes between slabs, where few triangles of a part are renewed. kSlabs: in the slabs, or in the
// whole if it is one slab, where most are renewed. kRest: in the whole, what slabs have left coarse; again few
// triangles.
enum class Round { kSeams, kSlabs, kRest };

// What all rounds of a refinement share.
struct Task {
  const Isosurface& isosurface;
  const RefineOptions& options;
  Controls& controls;
  RefineStats& stats;
};

// Divides the threads among the parts that are not finished. The last parts get more than one thread each.
class SharedThreads {
 public:
  SharedThreads(int threads, std::size_t parts) : threads_(threads), parts_left_(static_cast<int>(parts)) {}
  void part_ends() { --parts_left_; }
  // The number of threads that a part may use now.
  [[nodiscard]] int count() const { return std::max(1, threads_ / std::max(1, parts_left_.load())); }

 private:
  int threads_;
  std::atomic<int> parts_left_;
};

void add_places(const SelfIntersections& found, std::vector<Vec3>& suspects) {
  for (const auto* pairs : {&found.crossing, &found.touching}) {
    for (const TrianglePair& pair : *pairs) suspects.push_back(pair.position);
  }
}

// Refines a part. If more triangles meet than before, it takes everything back and refines again, with clearances of 0
// near the places where they met, and in the last restart with clearances of 0 everywhere. The result with the fewest
// such pairs is kept.
void refine_part(RefinementPart& part, Round round, const Task& task, Controls& controls, const SharedThreads& threads,
                 RefineStats& stats) {
  const auto meeting = [&] {
    return round == Round::kSlabs ? meeting_pairs(part.mesh, threads.count())
                                  : meeting_pairs_of_renewed(part.mesh, threads.count());
  };
  if (task.options.smoothing_passes > 0 && round != Round::kSeams)
    part.smoothing = round == Round::kSlabs ? Smoothing::kAll : Smoothing::kRest;
  RefinementChange least;
  std::int64_t fewest = 0, before = 0;
  std::vector<Vec3> suspects;
  for (std::int64_t restarts = 0;; ++restarts) {
    RefineStats counted;
    RefineLoop loop(part, task.isosurface, task.options, counted);
    loop.run(controls, threads.count());
    if (round == Round::kRest) release_free_memory();  // the peak memory may be in the check
    // Of a run that is stopped nothing is promised, and its time is over. A slab that has used up its share of the
    // vertices does not stop the run.
    if (!task.options.restart_at_crossings || (restarts == 0 && controls.stopped() && task.controls.is_over())) {
      stats = counted;
      return;
    }
    const SelfIntersections found = meeting();
    counted.search += stats.search;
    stats.search = counted.search;
    stats.restarts = counted.restarts = restarts;
    // A restart that was stopped before its end does not replace a finished result.
    const bool is_best = restarts == 0 || (found.meeting_pairs() < fewest && !controls.stopped());
    if (is_best) {
      fewest = found.meeting_pairs();
      stats = counted;
      stats.meeting_pairs = fewest;
    }
    if (is_best && fewest <= before) return;
    RefinementChange change = loop.take_back();
    if (task.options.observer != nullptr) task.options.observer->restarted();
    if (is_best) least = std::move(change);
    if (restarts == 0 && round == Round::kSlabs) before = meeting_pairs(part.mesh, threads.count()).meeting_pairs();
    if (fewest <= before || restarts == kMostRestarts || controls.poll()) break;
    if (restarts + 1 == kMostRestarts) {
      clear_all_clearances(part.mesh);
    } else {
      add_places(found, suspects);
      clear_clearances_near(part.mesh, suspects);
    }
  }
  least.redo(part.mesh);
}

// Refines disjoint slabs independently: all coarse triangles in them or, if planes are given, those that meet the
// slab's plane.
void refine_apart(RefinementMesh& mesh, const std::vector<Slab>& slabs, std::span<const double> planes,
                  std::span<const float> work, const Task& task) {
  const Round round = planes.empty() ? Round::kSlabs : Round::kSeams;
  std::vector<RefineStats> counted(slabs.size());
  const double share = 1.0 / static_cast<double>(slabs.size());
  std::vector<Controls> limits(slabs.size(), task.controls.for_part(share, mesh.vertices.size()));
  SharedThreads threads(task.options.threads, slabs.size());
  const auto refine = [&](std::size_t k, RefinementPart& part) {
    if (round == Round::kSlabs && k + kSlabsNearPeak >= slabs.size()) release_free_memory();
    if (round == Round::kSeams) part.plane = planes[k];
    limits[k].part_begins_with(part.mesh.vertices.size());
    refine_part(part, round, task, limits[k], threads, counted[k]);
    threads.part_ends();
  };
  RefinementSlabs(mesh, slabs, work, task.options.threads).refine_each(refine);
  task.controls.poll();  // the limit that stopped parts also stops the rest
  for (const RefineStats& part : counted) task.stats.add(part);
}

// Slabs cannot refine the triangles that their planes meet. So these are refined first, while the mesh is coarse.
void refine_slabs(RefinementMesh& mesh, const std::vector<Slab>& slabs, std::vector<float> work, const Task& task) {
  std::vector<double> planes;
  for (std::size_t k = 0; k + 1 < slabs.size(); ++k) planes.push_back(slabs[k].high);
  refine_apart(mesh, seams_between(slabs, mesh, task.options.threads), planes, work, task);
  if (task.controls.stopped()) return;
  // The estimates are used to reserve memory and to order the slabs; a reused slot keeps its old estimate.
  work.resize(mesh.triangles.size());
  refine_apart(mesh, most_work_first(slabs, mesh, work), {}, work, task);
  release_free_memory();
}

// Refines the remaining coarse triangles in the whole mesh.
void refine_whole(RefinementMesh& mesh, Round round, const Task& task) {
  RefinementPart whole;
  std::swap(whole.mesh, mesh);
  whole.coverage_targets = task.options.coverage_targets;
  RefineStats counted;
  refine_part(whole, round, task, task.controls, {task.options.threads, 1}, counted);
  std::swap(whole.mesh, mesh);
  task.stats.add(counted);
}

[[noreturn]] void refuse_to_be_observed(std::size_t triangles) {
  throw InputError("the mesh after stage 1 has " + std::to_string(triangles) +
                   " triangles, which stage 2 refines in slabs, several steps at a time: steps can be followed up to " +
                   "about 6000 triangles; take a smaller volume or a crop");
}

}  // namespace

void refine_geometry(SurfaceMesh& mesh, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
                     RefineStats& stats, std::vector<SurfaceDelaunayBall>* balls) {
  if (controls.stopped()) return;
  if (options.observer != nullptr) options.observer->meshed(mesh, criteria_of(options));
  const Task task{isosurface, options, controls, stats};
  RefinementPart whole;
  RefinementMesh& refined = whole.mesh;
  refined = RefinementMesh(mesh, options.threads);
  mesh = {};  // not needed until all is refined; the peak memory of a whole run may be in between
  set_clearances(refined);
  std::vector<float> work = RefineLoop(whole, isosurface, options, stats).measure_all(options.threads);
  const std::vector<Slab> slabs = slabs_of_equal_work(refined, work, options.slab_triangles, options.threads);
  if (options.observer != nullptr && slabs.size() > 1) refuse_to_be_observed(refined.triangles.size());
  if (slabs.size() == 1) {
    refine_whole(refined, Round::kSlabs, task);
  } else {
    refine_slabs(refined, slabs, std::move(work), task);
    if (!controls.stopped()) refine_whole(refined, Round::kRest, task);
  }
  if (options.observer != nullptr) options.observer->refined(refined);
  release_free_memory();
  stats.stopped_at_r_min = std::count_if(refined.triangles.begin(), refined.triangles.end(),
                                         [](const RefinementMesh::Triangle& t) { return t.is_too_small(); });
  if (balls != nullptr) {
    balls->clear();
    for (const RefinementMesh::Triangle& t : refined.triangles) balls->push_back(t.ball);
  }
  refined.move_to(mesh, options.threads, options.keep_neighbours);
}

}  // namespace deliso

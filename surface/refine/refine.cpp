#include "surface/refine/refine.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/base/memory.h"
#include "surface/refine/guard/clearances.h"
#include "surface/refine/guard/refinement_crossings.h"
#include "surface/refine/refine_loop.h"
#include "surface/refine/slabs/refinement_planes.h"
#include "surface/refine/slabs/refinement_slabs.h"

namespace deliso {

namespace {

// Starts again at most this often.
constexpr std::int64_t kMostRestarts = 3;

// What slabs leave behind in small pieces matters only beside nearly all of the whole: giving it back takes time.
constexpr std::size_t kSlabsNearPeak = 1;

// Along the planes between slabs, which renews few triangles of a part; in slabs, or in the whole where that is one,
// which renews most; and in the whole what slabs have left coarse, which again are few.
enum class Round { kSeams, kSlabs, kRest };

// What all rounds of a refinement share.
struct Task {
  const Isosurface& isosurface;
  const RefineOptions& options;
  Controls& controls;
  RefineStats& stats;
};

// The threads that parts share, as long as there are parts for them; the last ones have more than one each.
class SharedThreads {
 public:
  SharedThreads(int threads, std::size_t parts) : threads_(threads), parts_left_(static_cast<int>(parts)) {}
  void part_ends() { --parts_left_; }
  // Those that a part may use.
  [[nodiscard]] int count() const { return std::max(1, threads_ / std::max(1, parts_left_.load())); }

 private:
  int threads_;
  std::atomic<int> parts_left_;
};

std::int64_t count_of(const SelfIntersections& found) { return found.crossing_pairs + found.touching_pairs; }

void add_places(const SelfIntersections& found, std::vector<Vec3>& suspects) {
  for (const auto* pairs : {&found.crossing, &found.touching}) {
    for (const TrianglePair& pair : *pairs) suspects.push_back(pair.position);
  }
}

// Refines a part; where more triangles came to meet than before, takes all back and does it again, with no trust around
// them, and at last with none at all. What has the fewest such pairs stays.
void refine_part(RefinementPart& part, Round round, const Task& task, Controls& controls, const SharedThreads& threads,
                 RefineStats& stats) {
  const auto meeting = [&] {
    return round == Round::kSlabs ? meeting_pairs(part.mesh, threads.count())
                                  : meeting_pairs_of_renewed(part.mesh, threads.count());
  };
  RefinementChange least;
  std::int64_t fewest = 0, before = 0;
  std::vector<Vec3> suspects;
  for (std::int64_t restarts = 0;; ++restarts) {
    RefineStats counted;
    RefineLoop loop(part, task.isosurface, task.options, counted);
    loop.run(controls, threads.count());
    if (round == Round::kRest) release_free_memory();  // the peak may lie in the check
    if (!task.options.restart_at_crossings) {
      stats = counted;
      return;
    }
    const SelfIntersections found = meeting();
    counted.search += stats.search;
    stats.search = counted.search;
    stats.restarts = counted.restarts = restarts;
    // A restart that had to stop half-way is worth less than what was finished before.
    const bool is_best = restarts == 0 || (count_of(found) < fewest && !controls.stopped());
    if (is_best) {
      fewest = count_of(found);
      stats = counted;
    }
    if (is_best && fewest <= before) return;
    RefinementChange change = loop.take_back();
    if (is_best) least = std::move(change);
    if (restarts == 0 && round == Round::kSlabs) before = count_of(meeting_pairs(part.mesh, threads.count()));
    if (fewest <= before || restarts == kMostRestarts || controls.poll()) break;
    if (restarts + 1 == kMostRestarts) {
      distrust_all(part.mesh);
    } else {
      add_places(found, suspects);
      distrust(part.mesh, suspects);
    }
  }
  least.redo(part.mesh);
}

// Refines disjoint slabs apart from each other: all that is coarse in them or, given a plane for each, what meets that.
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
  task.controls.poll();  // what made parts stop stops the rest
  for (const RefineStats& part : counted) task.stats.add(part);
}

// Slabs would leave coarse what their planes meet. So that is refined before them, while the mesh is coarse.
void refine_slabs(RefinementMesh& mesh, const std::vector<Slab>& slabs, std::vector<float> work, const Task& task) {
  std::vector<double> planes;
  for (std::size_t k = 0; k + 1 < slabs.size(); ++k) planes.push_back(slabs[k].high);
  refine_apart(mesh, seams_between(slabs, mesh, task.options.threads), planes, work, task);
  if (task.controls.stopped()) return;
  // Estimates serve for room and for the order of the slabs: that of a slot which was taken anew stands.
  work.resize(mesh.triangles.size());
  refine_apart(mesh, most_work_first(slabs, mesh, work), {}, work, task);
  release_free_memory();
}

// Refines in the whole what is still coarse.
void refine_whole(RefinementMesh& mesh, Round round, const Task& task) {
  RefinementPart whole;
  std::swap(whole.mesh, mesh);
  whole.coverage_targets = task.options.coverage_targets;
  RefineStats counted;
  refine_part(whole, round, task, task.controls, {task.options.threads, 1}, counted);
  std::swap(whole.mesh, mesh);
  task.stats.add(counted);
}

}  // namespace

void refine_geometry(SurfaceMesh& mesh, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
                     RefineStats& stats, std::vector<SurfaceDelaunayBall>* balls) {
  if (controls.stopped()) return;
  const Task task{isosurface, options, controls, stats};
  RefinementPart whole;
  RefinementMesh& refined = whole.mesh;
  refined = RefinementMesh(mesh, options.threads);
  mesh = {};  // not needed until all is refined; the peak of a whole run may lie in between
  set_clearances(refined);
  std::vector<float> work = RefineLoop(whole, isosurface, options, stats).measure_all(options.threads);
  const std::vector<Slab> slabs = slabs_of_equal_work(refined, work, options.slab_triangles, options.threads);
  if (slabs.size() == 1) {
    refine_whole(refined, Round::kSlabs, task);
  } else {
    refine_slabs(refined, slabs, std::move(work), task);
    if (!controls.stopped()) refine_whole(refined, Round::kRest, task);
  }
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

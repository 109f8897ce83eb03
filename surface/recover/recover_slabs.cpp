// Stage 1 on several threads: rounds, each of which refines slabs of the volume independently.
//
// The whole triangulation plans a round alone; then parts of it that do not meet do the work (see BowyerWatson). So the
// result does not depend on the number of threads. An insertion that would reach across a plane between slabs is
// blocked. At the end of the round the whole makes blocked insertions itself, or leaves them to the next round, whose
// planes lie across another axis.
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "delaunay/base/parallel.h"
#include "surface/recover/recover_loop.h"

namespace deliso {

namespace {

// The number of slabs in a round. With more slabs, planes block more insertions.
constexpr std::size_t kSlabs = 2;
// A round needs so many vertices that most conflict regions are small enough to lie within a slab: at least
// kFewestVertices, and a fourth more than the vertices that lay on the box at the beginning, which alone make
// tetrahedra from one face of the box to another. (An eighth or a half more are as good on gyroids. Without any margin,
// stage 1 takes two to four times as long there.)
constexpr std::size_t kFewestVertices = 256;
constexpr std::size_t kApartFromBox = 4;
// A round is worthwhile when at least kFewestWaiting triangles wait for refinement, and this fraction of the number of
// vertices, and when it inserts that fraction.
constexpr std::size_t kFewestWaiting = 128;
constexpr double kLeastGrowth = 1.0 / 64;
// A slab inserts at most kMostPerTriangle points for each waiting triangle, and this fraction of the number of
// vertices. So slabs become equally fine, and little of the reserved room is left unused, which would have to be
// skipped.
constexpr std::size_t kMostPerTriangle = 2;
constexpr double kMostGrowth = 0.5;

}  // namespace

void RecoverLoop::run_in_slabs(Controls& controls) {
  const std::size_t on_box = count_on_box();
  run(controls, std::max(kFewestVertices, on_box + on_box / kApartFromBox));
  for (std::size_t round = 0; !controls.stopped(); ++round) {
    const double enough = kLeastGrowth * static_cast<double>(delaunay_.vertex_count());
    if (static_cast<double>(run_round(round % 3, controls)) < enough) return;
  }
}

std::size_t RecoverLoop::count_on_box() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < delaunay_.vertex_count(); ++i) {
    const VertexId v(i);
    if (!restricted_.is_virtual(v) && SignedDelaunay::on_box(isosurface_.box(), delaunay_.point(v))) ++count;
  }
  return count;
}

std::int64_t RecoverLoop::run_round(std::size_t axis, Controls& controls) {
  // Step 1: plan.
  const std::vector<Violation> waiting = take_waiting();
  const std::vector<Slab> slabs = slabs_of(waiting, axis);
  const auto parts = restricted_.parts(slabs, most_insertions(waiting), options_.threads);
  if (parts.empty()) {
    for (const Violation& violation : waiting) queue_.put_back(violation);
    return 0;
  }
  std::vector<RecoverStats> counted(parts.size());
  std::vector<RecoverLoop> work;
  work.reserve(parts.size());
  std::vector<Controls> limits;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    work.emplace_back(*parts[k], options_, counted[k]);
    work[k].umbrella_queued_ = umbrella_queued_;
    limits.push_back(controls.for_part(1.0 / static_cast<double>(parts.size()), delaunay_.vertex_count()));
    limits[k].part_begins_with(work[k].delaunay_.vertex_count());
  }
  const std::vector<Violation> between = hand_out(waiting, slabs, work);

  // Step 2: refine the slabs independently.
  const int threads = restricted_.observer() != nullptr ? 1 : options_.threads;
  run_tasks(parts.size(), threads, [&](std::size_t k) { work[k].run(limits[k]); });
  controls.poll();  // the limit that stopped parts also stops the rest

  // Step 3: take in the results of the parts, and what they left.
  const std::vector<VertexId> renamed = restricted_.join(parts);
  umbrella_queued_.assign(delaunay_.vertex_count(), false);
  std::int64_t inserted = 0;
  std::vector<Violation> blocked;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    take_back(work[k].queue_.take_all(), renamed);
    blocked.insert(blocked.end(), work[k].blocked_.begin(), work[k].blocked_.end());
    stats_.add(counted[k]);
    inserted += counted[k].insertions;
  }
  stats_.in_slabs += inserted;
  take_back(between, renamed);
  mend_blocked(blocked, renamed, controls);
  return inserted;
}

// The whole makes blocked insertions one by one, but not the insertions that follow from them. If blocked triangles
// stayed coarse, they would block all finer insertions around them, round after round.
void RecoverLoop::mend_blocked(std::span<const Violation> blocked, std::span<const VertexId> renamed,
                               Controls& controls) {
  ViolationQueue in_order(options_.order);
  for (Violation violation : blocked) {
    if (violation.kind == ViolationKind::kExtractManifold) violation.element = renamed[violation.element].value;
    in_order.put_back(violation);
  }
  while (!controls.must_stop("recover", delaunay_.vertex_count(), queue_.size() + in_order.size())) {
    const std::optional<Violation> violation = in_order.pop();
    if (!violation) break;
    treat(*violation);
  }
}

// Empties the queue, and drops violations that have been repaired or whose element is gone.
std::vector<Violation> RecoverLoop::take_waiting() {
  std::vector<Violation> waiting = queue_.take_all();
  std::erase_if(waiting, [&](const Violation& violation) {
    return violation.kind != ViolationKind::kExtractManifold &&
           restricted_.dual_edge(DualEdgeId(violation.element)).generation != violation.generation;
  });
  return waiting;
}

// The limit of insertions for each slab; 0 when a round is not worthwhile. Umbrellas are not counted: they are many,
// and nearly all of them are disks.
std::size_t RecoverLoop::most_insertions(std::span<const Violation> waiting) const {
  const auto triangles = static_cast<std::size_t>(std::count_if(
      waiting.begin(), waiting.end(), [](const Violation& v) { return v.kind != ViolationKind::kExtractManifold; }));
  const auto vertices = static_cast<double>(delaunay_.vertex_count());
  if (triangles < kFewestWaiting || static_cast<double>(triangles) < kLeastGrowth * vertices) return 0;
  return std::min(kMostPerTriangle * triangles, static_cast<std::size_t>(kMostGrowth * vertices));
}

// Slabs with about the same number of waiting triangles.
std::vector<Slab> RecoverLoop::slabs_of(std::span<const Violation> waiting, std::size_t axis) const {
  std::vector<double> places;
  for (const Violation& violation : waiting) {
    if (violation.kind == ViolationKind::kExtractManifold) continue;
    places.push_back(delaunay_.point(vertices_of(violation)[0])[axis]);
  }
  std::vector<Slab> slabs(kSlabs);
  for (std::size_t k = 0; k < kSlabs; ++k) {
    slabs[k].axis = axis;
    if (k == 0 || places.empty()) continue;
    const auto plane = places.begin() + static_cast<std::ptrdiff_t>(k * places.size() / kSlabs);
    std::nth_element(places.begin(), plane, places.end());
    slabs[k - 1].high = slabs[k].low = *plane;
  }
  return slabs;
}

// The vertices of the facet that belongs to the dual edge; for an umbrella its vertex, three times.
std::array<VertexId, 3> RecoverLoop::vertices_of(const Violation& violation) const {
  if (violation.kind != ViolationKind::kExtractManifold)
    return restricted_.dual_edge(DualEdgeId(violation.element)).vertices;
  const VertexId v(violation.element);
  return {v, v, v};
}

// Gives each violation to the part whose slab it lies in; returns those that lie in no slab.
std::vector<Violation> RecoverLoop::hand_out(std::span<const Violation> waiting, std::span<const Slab> slabs,
                                             std::span<RecoverLoop> parts) const {
  std::vector<Violation> between;
  for (const Violation& violation : waiting) {
    const std::array<VertexId, 3> v = vertices_of(violation);
    std::size_t k = 0;
    const auto lies_within = [&](VertexId corner) { return slabs[k].contains(delaunay_.point(corner)); };
    while (k < slabs.size() && !std::all_of(v.begin(), v.end(), lies_within)) ++k;
    if (k < slabs.size()) {
      parts[k].queue_.put_back(violation);
    } else {
      between.push_back(violation);
    }
  }
  return between;
}

void RecoverLoop::take_back(std::span<const Violation> left, std::span<const VertexId> renamed) {
  for (Violation violation : left) {
    if (violation.kind == ViolationKind::kExtractManifold) {
      violation.element = renamed[violation.element].value;
      if (umbrella_queued_[violation.element]) continue;
      umbrella_queued_[violation.element] = true;
    }
    queue_.put_back(violation);
  }
}

}  // namespace deliso

// The loop of stage 1: how the four lines of Figure 5 become one queue is said in recover_loop.h.
#include "surface/recover/recover.h"

#include <cmath>
#include <limits>
#include <optional>

#include "surface/recover/recover_loop.h"

namespace deliso {

void RecoverLoop::run(Controls& controls, std::size_t enough) {
  while (delaunay_.vertex_count() < enough && restricted_.has_room() &&
         !controls.must_stop("recover", delaunay_.vertex_count(), queue_.size())) {
    const std::optional<Violation> violation = queue_.pop();
    if (!violation) break;
    if (violation->kind == ViolationKind::kExtractManifold) umbrella_queued_[violation->element] = false;
    treat(*violation);
  }
}

void RecoverLoop::treat(const Violation& violation) {
  // What was queued may have been mended or destroyed meanwhile.
  std::optional<RefinementPoint> candidate;
  if (violation.kind == ViolationKind::kExtractManifold) {
    candidate = extract_manifold(VertexId(violation.element));
  } else {
    const DualEdgeId e(violation.element);
    if (restricted_.dual_edge(e).generation != violation.generation) return;
    candidate = violation.kind == ViolationKind::kMultiIntersect ? multi_intersect(e) : approximate_geometry(e);
  }
  if (!candidate || !insert(violation, *candidate)) return;

  inherit_pole_height();
  queue_touched();
  // A dual edge that is only cut back leaves the umbrella as it was.
  if (violation.kind == ViolationKind::kExtractManifold) queue_umbrella(VertexId(violation.element));
}

std::int64_t RecoverLoop::insert_points(std::span<const Vec3> points, Controls& controls) {
  std::int64_t inserted = 0;
  for (const Vec3& p : points) {
    if (controls.must_stop("recover", delaunay_.vertex_count(), queue_.size())) break;
    const TetId start = delaunay_.incident_tet(restricted_.last_vertex());
    Observer* const observer = restricted_.observer();
    if (observer != nullptr) observer->violation(restricted_, {.limits = &options_.geometry});
    if (restricted_.insert(p, start, options_.size_bound) != RestrictedDelaunay::Outcome::kInserted) {
      if (observer != nullptr) observer->refused(restricted_, "size_bound");
      continue;
    }
    ++inserted;
    queue_touched();
  }
  stats_.insertions += inserted;
  stats_.uncovered += inserted;
  return inserted;
}

void RecoverLoop::queue_everything() {
  for (std::size_t i = 0; i < restricted_.dual_edge_slots(); ++i) {
    if (restricted_.is_alive(DualEdgeId(i))) queue_edge(DualEdgeId(i));
  }
  for (std::size_t i = 0; i < delaunay_.vertex_count(); ++i) {
    if (!restricted_.is_virtual(VertexId(i))) queue_umbrella(VertexId(i));
  }
}

void RecoverLoop::queue_edge(DualEdgeId e) {
  if (!restricted_.is_alive(e)) return;
  const DualEdge& edge = restricted_.dual_edge(e);
  if (edge.hits.size() > 1) {
    const double farthest = std::abs(farthest_hit(edge));
    queue_.push({ViolationKind::kMultiIntersect, e.value, edge.generation}, farthest, edge.radius, edge.dual.origin);
  }
  const double badness = geometric_badness(edge);
  if (badness > 1) {
    queue_.push({ViolationKind::kApproximateGeometry, e.value, edge.generation}, badness, edge.radius,
                edge.dual.origin);
  }
}

// What the last insertion has changed.
void RecoverLoop::queue_touched() {
  for (const DualEdgeId e : restricted_.touched_edges()) queue_edge(e);
  for (const VertexId q : restricted_.touched_vertices()) queue_umbrella(q);
}

void RecoverLoop::queue_umbrella(VertexId q) {
  if (umbrella_queued_.size() < delaunay_.vertex_count()) umbrella_queued_.resize(delaunay_.vertex_count(), false);
  if (umbrella_queued_[q.index()]) return;
  umbrella_queued_[q.index()] = true;
  queue_.push({ViolationKind::kExtractManifold, q.value, 0}, 0, 0, {});
}

bool RecoverLoop::insert(const Violation& violation, const RefinementPoint& candidate) {
  Observer* const observer = restricted_.observer();
  if (observer != nullptr) tell_observer(violation);
  const std::optional<Vec3> p = onto_surface(candidate.point);
  if (!p) {
    if (observer != nullptr) observer->refused(restricted_, "off_surface");
    return false;
  }
  const RestrictedDelaunay::Outcome outcome = restricted_.insert(*p, candidate.start, options_.size_bound);
  if (outcome == RestrictedDelaunay::Outcome::kBlocked) {
    blocked_.push_back(violation);
    if (observer != nullptr) observer->refused(restricted_, "blocked");
    return false;
  }
  if (outcome != RestrictedDelaunay::Outcome::kInserted) {
    ++stats_.refused_by_size_bound;
    if (observer != nullptr) observer->refused(restricted_, "size_bound");
    return false;
  }
  ++stats_.insertions;
  if (SignedDelaunay::on_box(isosurface_.box(), *p)) ++stats_.boundary_splits;
  switch (violation.kind) {
    case ViolationKind::kMultiIntersect:
      ++stats_.multi_intersect;
      break;
    case ViolationKind::kExtractManifold:
      ++stats_.extract_manifold;
      break;
    case ViolationKind::kApproximateGeometry:
      ++stats_.approximate_geometry;
      break;
  }
  return true;
}

// For an umbrella, umbrella_ holds D_q (is_disk).
void RecoverLoop::tell_observer(const Violation& violation) const {
  ObservedViolation seen{.limits = &options_.geometry};
  switch (violation.kind) {
    case ViolationKind::kMultiIntersect:
      seen.step = RecoverStep::kMultiIntersect;
      break;
    case ViolationKind::kExtractManifold:
      seen.step = RecoverStep::kExtractManifold;
      seen.umbrella = VertexId(violation.element);
      seen.disk = umbrella_.facets();
      break;
    case ViolationKind::kApproximateGeometry:
      seen.step = RecoverStep::kApproximateGeometry;
      break;
  }
  if (violation.kind != ViolationKind::kExtractManifold)
    seen.sigma = &restricted_.dual_edge(DualEdgeId(violation.element));
  restricted_.observer()->violation(restricted_, seen);
}

// A new vertex takes the mean pole height of its neighbours on the surface, or that of the nearest of them.
void RecoverLoop::inherit_pole_height() {
  if (pole_heights_ == nullptr) return;
  const VertexId q = restricted_.last_vertex();
  umbrella_.inspect(q);
  double sum = 0, count = 0;
  double nearest = std::numeric_limits<double>::infinity();
  double nearest_height = 0;
  for (const FacetId f : umbrella_.facets()) {
    for (const unsigned slot : kFacetSlots[f.face()]) {
      const VertexId v = delaunay_.vertices(f.tet())[slot];
      if (v == q || restricted_.is_virtual(v)) continue;
      const double height = (*pole_heights_)[v.index()];
      sum += height;
      count += 1;
      const double squared = squared_distance(delaunay_.point(q), delaunay_.point(v));
      if (squared >= nearest) continue;
      nearest = squared;
      nearest_height = height;
    }
  }
  const double inherited = options_.new_pole == NewPole::kMean ? sum / count : nearest_height;
  pole_heights_->push_back(count > 0 ? inherited : isosurface_.box().diagonal());
}

void recover(RestrictedDelaunay& restricted, const RecoverOptions& options, Controls& controls, RecoverStats& stats,
             std::vector<double>* pole_heights) {
  RecoverLoop loop(restricted, options, stats, pole_heights);
  loop.queue_everything();
  if (pole_heights == nullptr) loop.run_in_slabs(controls);
  loop.run(controls);
}

void take_counters(const RestrictedDelaunay& restricted, RecoverStats& stats) {
  stats.search += restricted.counters();
  stats.restricted_seconds = restricted.restricted_seconds();
  stats.hits_against_signs = restricted.hits_against_signs();
}

std::int64_t recover_with(RestrictedDelaunay& restricted, std::span<const Vec3> points, const RecoverOptions& options,
                          Controls& controls, RecoverStats& stats) {
  RecoverLoop loop(restricted, options, stats);
  const std::int64_t inserted = loop.insert_points(points, controls);
  loop.run_in_slabs(controls);
  loop.run(controls);
  return inserted;
}

}  // namespace deliso

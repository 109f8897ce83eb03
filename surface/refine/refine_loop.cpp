#include "surface/refine/refine_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace deliso {

namespace {

// A refinement point nearer to a vertex than this fraction of its ball's radius shows that the ball was not empty.
constexpr double kNearestVertex = 0.5;
// A point farther off the planes of E's triangles than this fraction of its ball's radius would make a spike.
constexpr double kFarthestMove = 0.8;
// How often coverage targets are inserted; in between, the mesh is refined.
constexpr int kCoverageTargetRounds = 4;
// Edges are halved from this length on (mesh-space units); with h_min, when what is coarse is far off, any is.
constexpr double kHalvedEdge = 1.5;

}  // namespace

void RefineLoop::run(Controls& controls, int threads) {
  start_.emplace(mesh_);
  if (controls.must_stop("refine", mesh_.vertices.size(), 0)) return;
  queue_coarse_triangles();
  if (queue_.size() > 0) {
    guard_.emplace(mesh_, threads);
    refine_queued(controls);
  }
  if (flip_edges(controls, threads)) refine_queued(controls);
  for (int i = 0; i < kCoverageTargetRounds && insert_coverage_targets(controls, threads); ++i) refine_queued(controls);
  if (part_.smoothing != Smoothing::kNone && !controls.stopped()) smooth_vertices(controls, threads);
  guard_.reset();
}

void RefineLoop::refine_queued(Controls& controls) {
  while (!controls.must_stop("refine", mesh_.vertices.size(), queue_.size())) {
    const auto popped = queue_.pop();
    if (!popped && !retry_crossed()) break;
    // The cost of a pop is the wait for its triangle's memory; that triangle's neighbours can be prefetched once it is
    // there.
    const auto next = queue_.next();
    if (next) __builtin_prefetch(&mesh_.triangles[*next]);
    if (!popped || mesh_.triangles[popped->queued.element].state != popped->queued.generation) continue;
    if (treat(popped->queued.element)) wake_neighbours();
    if (next) mesh_.prefetch_around(*next);
  }
}

// Whether a coarse triangle is to be refined in this part.
bool RefineLoop::is_wanted(std::uint32_t triangle) const {
  return !part_.plane || mesh_.extent_of(triangle, part_.slab.axis).holds(*part_.plane);
}

// Triangles that another part left coarse are tried again; frozen triangles are not.
void RefineLoop::queue_coarse_triangles() {
  for (std::uint32_t t = part_.frozen; t < mesh_.triangles.size(); ++t) {
    if (mesh_.triangles[t].is_coarse() && is_wanted(t)) requeue(t);
  }
}

void RefineLoop::queue(std::uint32_t triangle, const NewTriangle& measured) {
  const QueuedElement queued{triangle, mesh_.triangles[triangle].state};
  if (options_.order == QueueOrder::kFirstInFirstOut) {
    queue_.push_by_age(queued);
  } else {
    const double key = options_.order == QueueOrder::kWorstFirst ? measured.badness : measured.radius;
    queue_.push(block_rank(key, measured.ball.center), queued);
  }
}

// Inserts x_sigma of one triangle, or a point of the boundary curve where x_sigma would come too near to a boundary
// edge.
bool RefineLoop::treat(std::uint32_t triangle) {
  const SurfaceDelaunayBall ball = ball_of(triangle);
  const double radius = std::sqrt(ball.squared_radius);
  const Candidate candidate{ball.center, radius, kNearestVertex * radius, triangle, kNoSide};
  const std::uint32_t state = mesh_.triangles[triangle].state;
  TriangleSide encroached = kNoSide;
  is_blocked_ = false;
  const auto tell_of_refused_attempt = [&] {
    if (options_.observer != nullptr) options_.observer->attempt_refused(mesh_, disk_, candidate);
  };
  std::optional<Refusal> refusal = insert(candidate, &encroached);
  if (refusal) tell_of_refused_attempt();
  if (encroached != kNoSide) {
    const auto on_boundary = boundary_candidate(mesh_, isosurface_, encroached, options_.r_min, stats_.search);
    refusal = on_boundary ? insert(*on_boundary, nullptr) : Refusal::kNoHit;
    if (!refusal) ++stats_.boundary_splits;
    const bool is_inside = isosurface_.box().contains(candidate.point);
    if (refusal && !is_blocked_ && is_inside) {
      refusal = insert(candidate, nullptr);
      if (refusal) tell_of_refused_attempt();
    }
  }
  if (refusal && !is_blocked_) {
    const auto halving = halving_candidate(mesh_, isosurface_, triangle, options_.h_min > 0 ? 0 : kHalvedEdge,
                                           options_.r_min, stats_.search);
    if (halving && !insert(*halving, nullptr)) {
      ++stats_.halvings;
      refusal.reset();
    }
  }
  if (refusal) {
    // In another part it may be refined; so the triangle keeps its state only here.
    start_->keep(triangle, mesh_);
    mesh_.triangles[triangle].set(RefinementMesh::Triangle::kRefused, true);
    mesh_.triangles[triangle].set(RefinementMesh::Triangle::kCoarse, is_blocked_);
    if (!is_blocked_) ++stats_.refused[static_cast<std::size_t>(*refusal)];
    if (options_.observer != nullptr)
      options_.observer->disk_refused(mesh_, triangle, kRefusalNames[static_cast<std::size_t>(*refusal)]);
    guard_->mark_if_far_off(triangle);
    if (refusal == Refusal::kCrossingTriangle) crossed_.push_back(triangle);
    return false;
  }
  ++stats_.insertions;
  // An insertion on the boundary may have left the triangle unchanged.
  if (mesh_.triangles[triangle].state == state) requeue(triangle);
  return true;
}

// Tries one insertion. When the point lies beyond the box or in the diametral ball of a boundary edge, that edge is
// reported and nothing is inserted.
std::optional<Refusal> RefineLoop::insert(Candidate candidate, TriangleSide* encroached_edge) {
  disk_.grow(candidate, [this](std::uint32_t t) {
    // If balls are not stored, the balls of E's triangles are not searched again where they are not needed.
    return options_.store_hits || !disk_.holds(t) ? ball_of(t) : SurfaceDelaunayBall{};
  });
  if (disk_.is_blocked() || !part_.slab.contains(candidate.point)) {
    is_blocked_ = true;
    return Refusal::kNotADisk;
  }
  if (encroached_edge != nullptr) {
    if (const auto side = disk_.encroached_boundary_edge(candidate, isosurface_.box())) {
      *encroached_edge = *side;
      return std::nullopt;
    }
    if (!isosurface_.box().contains(candidate.point)) return Refusal::kNoHit;
  }
  const RefinementDisk::Shape shape = disk_.order_rim(candidate);
  if (shape == RefinementDisk::Shape::kNotADisk) return Refusal::kNotADisk;
  if (shape == RefinementDisk::Shape::kRepeatedVertex) return Refusal::kRepeatedVertex;
  const Vec3 gradient = upwards(candidate);  // at a wall it is that of the wall, which is crossed a little beyond it
  candidate.point = isosurface_.settled(candidate.point);
  if (const auto failed = plan_star(candidate, gradient)) return failed;
  if (options_.observer != nullptr) options_.observer->disk(mesh_, disk_, candidate);
  replace_disk(candidate);
  return std::nullopt;
}

// Refuses the star of p over the rim when a triangle degenerates or turns against the gradient, a vertex is too near,
// or triangles would cross.
std::optional<Refusal> RefineLoop::refusal_of_star(const Candidate& candidate, const Vec3& gradient) {
  const Vec3& p = candidate.point;
  const double nearest = candidate.nearest * candidate.nearest;
  distances_.assign(1, squared_distance(p, mesh_.vertices[disk_.rim().front().from].point));
  for (const RimEdge& edge : disk_.rim()) {
    const Vec3& a = mesh_.vertices[edge.from].point;
    const Vec3& b = mesh_.vertices[edge.to].point;
    distances_.push_back(squared_distance(p, b));
    if (distances_[distances_.size() - 2] < nearest || distances_.back() < nearest) return Refusal::kTooClose;
    if (!(dot(cross(a - p, b - p), gradient) < 0)) return Refusal::kFlippedTriangle;
  }
  const bool closed = candidate.split == kNoSide;
  const double moved = disk_.distance_to(p);
  if (closed && moved > kFarthestMove * candidate.ball_radius) return Refusal::kTooFar;
  if (guard_->crosses(p, -gradient, moved, disk_)) return Refusal::kCrossingTriangle;
  return std::nullopt;
}

// Measures the star of p over the rim without building it.
std::optional<Refusal> RefineLoop::plan_star(const Candidate& candidate, const Vec3& gradient) {
  if (const auto refusal = refusal_of_star(candidate, gradient)) return refusal;
  const Vec3& p = candidate.point;
  star_pole_height_ = inherited_pole_height(candidate.split == kNoSide);
  shapes_.clear();
  for (const RimEdge& edge : disk_.rim()) {
    const RefinementMesh::Vertex &a = mesh_.vertices[edge.from], &b = mesh_.vertices[edge.to];
    shapes_.push_back({{p, a.point, b.point}, (star_pole_height_ + a.pole_height + b.pole_height) / 3});
  }
  star_.resize(shapes_.size());
  measure(shapes_, star_);
  return std::nullopt;
}

// The pole height of a new vertex, from its neighbours: the corners of the rim.
double RefineLoop::inherited_pole_height(bool closed) const {
  double nearest = std::numeric_limits<double>::infinity(), of_nearest = 0, sum = 0;
  const std::size_t count = disk_.rim().size() + (closed ? 0 : 1);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t v = i < disk_.rim().size() ? disk_.rim()[i].from : disk_.rim().back().to;
    const double height = mesh_.vertices[v].pole_height;
    sum += height;
    of_nearest = distances_[i] < nearest ? height : of_nearest;
    nearest = std::min(nearest, distances_[i]);
  }
  return options_.new_pole == NewPole::kMean ? sum / static_cast<double>(count) : of_nearest;
}

// Replaces E by the star of the new vertex. The star's triangles take the slots of E first, then new ones.
void RefineLoop::replace_disk(const Candidate& candidate) {
  const bool closed = candidate.split == kNoSide;
  const auto p = static_cast<std::uint32_t>(mesh_.vertices.size());
  const std::span<const std::uint32_t> old = disk_.triangles();
  const std::span<const RimEdge> rim = disk_.rim();
  for (const std::uint32_t t : old) {
    start_->keep(t, mesh_);
    guard_->forget(t);
  }
  mesh_.vertices.push_back({candidate.point, star_pole_height_, guard_->new_clearance()});
  const std::size_t count = rim.size();
  slots_.assign(old.begin(), old.end());
  check_triangle_count(mesh_.triangles.size() + count);
  while (slots_.size() < count) {
    slots_.push_back(static_cast<std::uint32_t>(mesh_.triangles.size()));
    mesh_.triangles.emplace_back();
  }
  std::uint32_t before = slots_.back();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t t = slots_[i], after = i + 1 < count ? slots_[i + 1] : slots_.front();
    const RimEdge& edge = rim[i];
    const bool first = !closed && i == 0;
    const bool last = !closed && i + 1 == count;
    RefinementMesh::Triangle& triangle = mesh_.triangles[t];
    triangle.corners = {p, edge.from, edge.to};
    triangle.neighbours = {edge.outer, last ? kNoSide : 4 * after + 2, first ? kNoSide : 4 * before + 1};
    before = t;
    if (edge.outer != kNoSide) {
      start_->keep(edge.outer >> 2, mesh_);
      mesh_.triangles[edge.outer >> 2].neighbours[edge.outer & 3u] = 4 * t;
    }
    triangle.renew();
    learn(t, star_[i]);
    guard_->learn(t, star_[i].squared_longest);
    if (triangle.is_coarse() && is_wanted(t)) queue(t, star_[i]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!star_[i].has_hit) guard_->mark_if_far_off(slots_[i]);
  }
}

// Triangles refused because of a crossing: the other sheet may be finer now. True when a triangle was queued again.
bool RefineLoop::retry_crossed() {
  if (stats_.insertions == insertions_at_retry_) return false;
  insertions_at_retry_ = stats_.insertions;
  bool any = false;
  for (const std::uint32_t t : std::exchange(crossed_, {})) {
    if (!mesh_.triangles[t].is_refused()) continue;
    any = true;
    requeue(t);
  }
  return any;
}

void RefineLoop::requeue(std::uint32_t triangle) {
  start_->keep(triangle, mesh_);
  RefinementMesh::Triangle& t = mesh_.triangles[triangle];
  t.set(RefinementMesh::Triangle::kRefused, false);
  t.set(RefinementMesh::Triangle::kCoarse, true);
  queue(triangle, measured(triangle));
}

// Queues triangles around the new star that were refused before; in the whole mesh also frozen ones.
void RefineLoop::wake_neighbours() {
  for (const RimEdge& edge : disk_.rim()) {
    const std::uint32_t t = edge.outer >> 2;
    if (edge.outer == kNoSide || !mesh_.triangles[t].is_refused()) continue;
    if (t >= part_.frozen) {
      requeue(t);
    } else {
      start_->keep(t, mesh_);
      mesh_.triangles[t].set(RefinementMesh::Triangle::kCoarse, true);
    }
  }
}

}  // namespace deliso

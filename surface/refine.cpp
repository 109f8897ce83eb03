#include "surface/refine.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/constructions.h"
#include "surface/crossing_guard.h"
#include "surface/refinement_candidates.h"
#include "surface/self_intersection.h"
#include "surface/triangle_queue.h"

namespace deliso {

namespace {

// A refinement point nearer to a vertex than this fraction of its ball's radius means that the ball was not empty.
constexpr double kNearestVertex = 0.5;
// A point farther off E's triangles than this fraction of its ball's radius would raise a spike.
constexpr double kFarthestMove = 0.8;
// Starts again at most this often, with at most so many new suspects of a kind.
constexpr std::int64_t kMostRestarts = 3;
constexpr std::size_t kMostSuspects = 1000;

class Refinement {
 public:
  Refinement(SurfaceMesh& mesh, const Isosurface& isosurface, const RefineOptions& options,
             std::span<const Vec3> suspects, RefineStats& stats)
      : mesh_(mesh),
        isosurface_(isosurface),
        options_(options),
        stats_(stats),
        queue_(options.order),
        guard_(mesh, suspects) {}

  void run(Controls& controls);

 private:
  using Candidate = RefinementCandidate;
  struct RimEdge {
    std::uint32_t from, to;
    TriangleSide outer;
  };
  // A triangle to be, with its ball and what the criteria say.
  struct NewTriangle {
    SurfaceDelaunayBall ball;
    double badness;
    double radius;
  };

  void queue_everything();
  bool treat(std::uint32_t triangle);
  std::optional<Refusal> insert(const Candidate& candidate, TriangleSide* encroached_edge);

  void grow_disk(const Candidate& candidate);
  [[nodiscard]] bool order_rim(const Candidate& candidate, Refusal& refusal);
  [[nodiscard]] std::optional<TriangleSide> encroached_boundary_edge(const Candidate& candidate) const;
  [[nodiscard]] std::optional<Refusal> plan_star(const Candidate& candidate);
  [[nodiscard]] double distance_to_disk(const Vec3& p) const;
  void replace_disk(const Candidate& candidate);
  void wake_neighbours();
  bool retry_crossed();
  void requeue(std::uint32_t triangle);

  [[nodiscard]] NewTriangle measure(const Vec3& p, const Vec3& a, const Vec3& b, double mean_pole);
  [[nodiscard]] double badness(double h, double r, double l, double mean_pole) const;
  [[nodiscard]] double badness_of(std::uint32_t triangle, double& radius);
  [[nodiscard]] double inherited_pole_height(const Vec3& p, bool closed) const;
  // B_sigma as it is kept; or found anew, the same to the last bit.
  [[nodiscard]] SurfaceDelaunayBall ball_of(std::uint32_t triangle) {
    if (options_.store_hits) return mesh_.balls[triangle];
    return measure(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2), 1).ball;
  }
  [[nodiscard]] const Vec3& corner(std::uint32_t triangle, unsigned i) const {
    return mesh_.points[mesh_.triangles[triangle][i % 3]];
  }

  SurfaceMesh& mesh_;
  const Isosurface& isosurface_;
  const RefineOptions& options_;
  RefineStats& stats_;
  TriangleQueue queue_;
  CrossingGuard guard_;

  std::vector<std::uint32_t> generation_;     // of each triangle: grows when its slot is taken anew
  std::vector<bool> refused_;                 // of each triangle: waits for a change around it
  std::vector<std::uint32_t> in_disk_;        // of each triangle: the attempt that took it into E
  std::vector<std::uint32_t> on_rim_;         // of each vertex: the attempt whose rim passes it
  std::vector<std::uint32_t> rim_edge_from_;  // of each vertex: index of the rim edge that leaves it
  std::uint32_t attempt_ = 0;

  std::vector<std::uint32_t> disk_;  // E
  std::vector<RimEdge> rim_;         // boundary of E, in order after order_rim
  std::vector<RimEdge> ordered_;
  std::vector<CrossingGuard::Edge> rim_edges_;
  std::vector<NewTriangle> star_;       // D, one for each rim edge
  std::vector<std::uint32_t> crossed_;  // triangles whose refinement a crossing prevented
  double star_pole_height_ = 0;
  std::int64_t insertions_at_retry_ = 0;
};

void Refinement::run(Controls& controls) {
  queue_everything();
  while (!controls.must_stop("refine", mesh_.points.size(), queue_.size())) {
    const auto entry = queue_.pop();
    if (!entry && !retry_crossed()) break;
    if (!entry) continue;
    if (generation_[entry->triangle] != entry->generation || refused_[entry->triangle]) continue;
    if (treat(entry->triangle)) wake_neighbours();
  }
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    double radius = 0;
    if (badness_of(t, radius) > 1 && radius <= options_.r_min) ++stats_.stopped_at_r_min;
  }
}

void Refinement::queue_everything() {
  const std::size_t count = mesh_.triangles.size();
  generation_.assign(count, 0);
  refused_.assign(count, false);
  in_disk_.assign(count, 0);
  on_rim_.assign(mesh_.points.size(), 0);
  rim_edge_from_.assign(mesh_.points.size(), 0);
  mesh_.balls.resize(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    double mean_pole = 0;
    for (const std::uint32_t v : mesh_.triangles[t]) mean_pole += mesh_.pole_heights[v] / 3;
    const NewTriangle measured = measure(corner(t, 0), corner(t, 1), corner(t, 2), mean_pole);
    mesh_.balls[t] = measured.ball;
    if (measured.badness > 1 && measured.radius > options_.r_min) {
      queue_.push({t, 0}, measured.badness, measured.radius);
    }
  }
}

// Inserts x_sigma of one triangle, or a point of the boundary curve where x_sigma would come too near to a boundary
// edge.
bool Refinement::treat(std::uint32_t triangle) {
  const SurfaceDelaunayBall ball = ball_of(triangle);
  const Candidate candidate{ball.center, std::sqrt(ball.squared_radius), triangle, kNoSide};
  TriangleSide encroached = kNoSide;
  std::optional<Refusal> refusal = insert(candidate, &encroached);
  if (encroached != kNoSide) {
    const auto on_boundary = boundary_candidate(mesh_, isosurface_, encroached, options_.r_min, stats_.search);
    refusal = on_boundary ? insert(*on_boundary, nullptr) : Refusal::kNoHit;
    if (!refusal) ++stats_.boundary_splits;
    if (refusal && isosurface_.box().contains(candidate.point)) refusal = insert(candidate, nullptr);
  }
  if (refusal) {
    const auto halving = halving_candidate(mesh_, isosurface_, triangle, options_.r_min, stats_.search);
    if (halving && !insert(*halving, nullptr)) {
      ++stats_.halvings;
      refusal.reset();
    }
  }
  if (refusal) {
    ++stats_.refused[static_cast<std::size_t>(*refusal)];
    refused_[triangle] = true;
    if (refusal == Refusal::kCrossingTriangle) crossed_.push_back(triangle);
    return false;
  }
  ++stats_.insertions;
  return true;
}

// Tries one insertion. When the point lies beyond the box or in the diametral ball of a boundary edge, that edge is
// reported and nothing is inserted.
std::optional<Refusal> Refinement::insert(const Candidate& candidate, TriangleSide* encroached_edge) {
  ++attempt_;
  grow_disk(candidate);
  if (encroached_edge != nullptr) {
    if (const auto side = encroached_boundary_edge(candidate)) {
      *encroached_edge = *side;
      return std::nullopt;
    }
    if (!isosurface_.box().contains(candidate.point)) return Refusal::kNoHit;
  }
  Refusal refusal = Refusal::kNotADisk;
  if (!order_rim(candidate, refusal)) return refusal;
  if (const auto failed = plan_star(candidate)) return failed;
  replace_disk(candidate);
  return std::nullopt;
}

// E: the triangles reached from the seed whose balls hold the point; and the edges around them.
void Refinement::grow_disk(const Candidate& candidate) {
  disk_.assign(1, candidate.seed);
  in_disk_[candidate.seed] = attempt_;
  const bool may_grow = candidate.halved == kNoSide;
  if (!may_grow) {
    disk_.push_back(mesh_.neighbours[candidate.halved >> 2][candidate.halved & 3u] >> 2);
    in_disk_[disk_.back()] = attempt_;
  }
  for (std::size_t i = 0; i < disk_.size() && may_grow; ++i) {
    for (const TriangleSide side : mesh_.neighbours[disk_[i]]) {
      if (side == kNoSide) continue;
      const std::uint32_t t = side >> 2;
      if (in_disk_[t] == attempt_) continue;
      const SurfaceDelaunayBall ball = ball_of(t);
      if (squared_distance(candidate.point, ball.center) >= ball.squared_radius) continue;
      in_disk_[t] = attempt_;
      disk_.push_back(t);
    }
  }
  rim_.clear();
  for (const std::uint32_t t : disk_) {
    for (unsigned i = 0; i < 3; ++i) {
      const TriangleSide outer = mesh_.neighbours[t][i];
      if (outer != kNoSide && in_disk_[outer >> 2] == attempt_) continue;
      if (4 * t + i == candidate.split) continue;
      rim_.push_back({mesh_.triangles[t][(i + 1) % 3], mesh_.triangles[t][(i + 2) % 3], outer});
    }
  }
}

// A boundary edge of E whose diametral ball holds the point; or any boundary edge of E when the point lies beyond the
// box.
std::optional<TriangleSide> Refinement::encroached_boundary_edge(const Candidate& candidate) const {
  const bool outside = !isosurface_.box().contains(candidate.point);
  for (const std::uint32_t t : disk_) {
    for (unsigned i = 0; i < 3; ++i) {
      if (mesh_.neighbours[t][i] != kNoSide) continue;
      const Vec3& a = corner(t, i + 1);
      const Vec3& b = corner(t, i + 2);
      if (outside || dot(a - candidate.point, b - candidate.point) < 0) return 4 * t + i;
    }
  }
  return std::nullopt;
}

// Brings the rim into order and checks that E is a disk none of whose vertices gets lost: one cycle (for a boundary
// split, one path) that passes every vertex once and has as many edges as a disk without inner vertices.
bool Refinement::order_rim(const Candidate& candidate, Refusal& refusal) {
  const bool closed = candidate.split == kNoSide;
  if (rim_.size() != disk_.size() + (closed ? 2 : 1)) return false;
  on_rim_.resize(mesh_.points.size(), 0);
  rim_edge_from_.resize(mesh_.points.size(), 0);
  for (std::uint32_t i = 0; i < rim_.size(); ++i) {
    if (on_rim_[rim_[i].from] == attempt_) {
      refusal = Refusal::kRepeatedVertex;
      return false;
    }
    on_rim_[rim_[i].from] = attempt_;
    rim_edge_from_[rim_[i].from] = i;
  }
  std::uint32_t at = rim_.front().from;
  if (!closed) at = mesh_.triangles[candidate.split >> 2][((candidate.split & 3u) + 2) % 3];
  ordered_.clear();
  while (ordered_.size() < rim_.size() && on_rim_[at] == attempt_) {
    ordered_.push_back(rim_[rim_edge_from_[at]]);
    at = ordered_.back().to;
    if (closed && at == rim_.front().from) break;
  }
  if (ordered_.size() != rim_.size()) return false;
  if (!closed && on_rim_[at] == attempt_) {
    refusal = Refusal::kRepeatedVertex;
    return false;
  }
  std::swap(rim_, ordered_);
  return true;
}

// Measures the star of p over the rim without building it; refuses it when a triangle degenerates or turns against the
// gradient, or a vertex is too near.
std::optional<Refusal> Refinement::plan_star(const Candidate& candidate) {
  const Vec3& p = candidate.point;
  const double nearest = kNearestVertex * candidate.ball_radius;
  const Vec3 gradient = isosurface_.gradient(p);
  for (const RimEdge& edge : rim_) {
    const Vec3& a = mesh_.points[edge.from];
    const Vec3& b = mesh_.points[edge.to];
    if (squared_distance(p, a) < nearest * nearest || squared_distance(p, b) < nearest * nearest) {
      return Refusal::kTooClose;
    }
    if (!(dot(cross(a - p, b - p), gradient) < 0)) return Refusal::kFlippedTriangle;
  }
  rim_edges_.clear();
  for (const RimEdge& edge : rim_) rim_edges_.push_back({edge.from, edge.to});
  const double moved = distance_to_disk(p);
  if (candidate.split == kNoSide && moved > kFarthestMove * candidate.ball_radius) return Refusal::kTooFar;
  if (guard_.crosses(p, moved, rim_edges_, in_disk_, attempt_)) return Refusal::kCrossingTriangle;
  star_pole_height_ = inherited_pole_height(p, candidate.split == kNoSide);
  star_.clear();
  for (const RimEdge& edge : rim_) {
    const double mean_pole = (star_pole_height_ + mesh_.pole_heights[edge.from] + mesh_.pole_heights[edge.to]) / 3;
    star_.push_back(measure(p, mesh_.points[edge.from], mesh_.points[edge.to], mean_pole));
  }
  return std::nullopt;
}

// How far p lies off the planes of E's triangles at most.
double Refinement::distance_to_disk(const Vec3& p) const {
  double farthest = 0;
  for (const std::uint32_t t : disk_) {
    const Vec3& a = corner(t, 0);
    const Vec3 normal = cross(corner(t, 1) - a, corner(t, 2) - a);
    farthest = std::max(farthest, std::abs(dot(normal, p - a)) / std::max(norm(normal), 1e-300));
  }
  return farthest;
}

// The pole height of a new vertex, from its neighbours: the corners of the rim.
double Refinement::inherited_pole_height(const Vec3& p, bool closed) const {
  std::uint32_t nearest = rim_.front().from;
  double sum = 0;
  double count = 0;
  const auto visit = [&](std::uint32_t v) {
    sum += mesh_.pole_heights[v];
    count += 1;
    if (squared_distance(p, mesh_.points[v]) < squared_distance(p, mesh_.points[nearest])) nearest = v;
  };
  for (const RimEdge& edge : rim_) visit(edge.from);
  if (!closed) visit(rim_.back().to);
  return options_.new_pole == NewPole::kMean ? sum / count : mesh_.pole_heights[nearest];
}

// Ball and badness of the triangle pab; a dual line without a falling hit gives its circumball and no further
// refinement.
Refinement::NewTriangle Refinement::measure(const Vec3& p, const Vec3& a, const Vec3& b, double mean_pole) {
  const Circumcircle circle = circumcircle(p, a, b);
  const Vec3 normal = cross(a - p, b - p);
  if (!std::isfinite(circle.radius) || !(norm(normal) > 0)) return {{p, 0}, 0, 0};  // nothing can be measured on it
  const Line dual{circle.center, normal / norm(normal)};
  const auto t = isosurface_.nearest_falling_hit(dual, isosurface_.box().diagonal(), stats_.search);
  if (!t) return {{circle.center, circle.radius * circle.radius}, 0, circle.radius};
  const Vec3 x = dual.at(*t);
  const double shortest = std::sqrt(std::min({squared_distance(p, a), squared_distance(a, b), squared_distance(b, p)}));
  return {{x, squared_distance(x, p)}, badness(std::abs(*t), circle.radius, shortest, mean_pole), circle.radius};
}

// The largest of the criteria's ratios to their thresholds: above 1 the triangle is too coarse.
double Refinement::badness(double h, double r, double l, double mean_pole) const {
  const double size = options_.criterion2 == Criterion2::kCircumradius ? r : l;
  return std::max({h / (r * options_.epsilon1), size / (mean_pole * options_.epsilon2), r / (l * options_.rho),
                   h / options_.max_distance});
}

double Refinement::badness_of(std::uint32_t triangle, double& radius) {
  const Vec3& a = corner(triangle, 0);
  const Vec3& b = corner(triangle, 1);
  const Vec3& c = corner(triangle, 2);
  const Circumcircle circle = circumcircle(a, b, c);
  radius = circle.radius;
  const double shortest = std::sqrt(std::min({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)}));
  double mean_pole = 0;
  for (const std::uint32_t v : mesh_.triangles[triangle]) mean_pole += mesh_.pole_heights[v] / 3;
  return badness(distance(ball_of(triangle).center, circle.center), radius, shortest, mean_pole);
}

// Replaces E by the star of the new vertex: the slots of E are taken first, then new ones.
void Refinement::replace_disk(const Candidate& candidate) {
  const bool closed = candidate.split == kNoSide;
  const auto p = static_cast<std::uint32_t>(mesh_.points.size());
  for (const std::uint32_t t : disk_) guard_.forget(t);
  mesh_.points.push_back(candidate.point);
  mesh_.pole_heights.push_back(star_pole_height_);
  guard_.add_vertex();
  while (disk_.size() < rim_.size()) {
    disk_.push_back(static_cast<std::uint32_t>(mesh_.triangles.size()));
    mesh_.triangles.emplace_back();
    mesh_.neighbours.emplace_back();
    mesh_.balls.emplace_back();
    generation_.push_back(0);
    refused_.push_back(false);
    in_disk_.push_back(0);
  }
  const std::size_t count = rim_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t t = disk_[i];
    const RimEdge& edge = rim_[i];
    const bool first = !closed && i == 0;
    const bool last = !closed && i + 1 == count;
    mesh_.triangles[t] = {p, edge.from, edge.to};
    mesh_.neighbours[t] = {edge.outer, last ? kNoSide : 4 * disk_[(i + 1) % count] + 2,
                           first ? kNoSide : 4 * disk_[(i + count - 1) % count] + 1};
    if (edge.outer != kNoSide) mesh_.neighbours[edge.outer >> 2][edge.outer & 3u] = 4 * t;
    mesh_.balls[t] = star_[i].ball;
    guard_.learn(t);
    ++generation_[t];
    refused_[t] = false;
    if (star_[i].badness > 1 && star_[i].radius > options_.r_min) {
      queue_.push({t, generation_[t]}, star_[i].badness, star_[i].radius);
    }
  }
}

// The sheet in the way may be finer now. True when a triangle was queued again.
bool Refinement::retry_crossed() {
  if (stats_.insertions == insertions_at_retry_) return false;
  insertions_at_retry_ = stats_.insertions;
  bool any = false;
  for (const std::uint32_t t : std::exchange(crossed_, {})) {
    if (!refused_[t]) continue;
    any = true;
    requeue(t);
  }
  return any;
}

void Refinement::requeue(std::uint32_t triangle) {
  refused_[triangle] = false;
  double radius = 0;
  const double bad = badness_of(triangle, radius);
  queue_.push({triangle, generation_[triangle]}, bad, radius);
}

// Triangles around the new star that were refused before get another chance.
void Refinement::wake_neighbours() {
  for (const RimEdge& edge : rim_) {
    if (edge.outer != kNoSide && refused_[edge.outer >> 2]) requeue(edge.outer >> 2);
  }
}

}  // namespace

void refine(SurfaceMesh& mesh, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
            RefineStats& stats) {
  if (!options.restart_at_crossings) {
    Refinement(mesh, isosurface, options, {}, stats).run(controls);
    return;
  }
  const SurfaceMesh start = mesh;
  const RefineStats before = stats;
  std::vector<Vec3> suspects;
  for (std::int64_t restarts = 0;; ++restarts) {
    const SearchCounters searches = stats.search;
    stats = before;
    stats.search = searches;
    stats.restarts = restarts;
    Refinement(mesh, isosurface, options, suspects, stats).run(controls);
    if (restarts == kMostRestarts || controls.stopped()) return;
    const SelfIntersections found = self_intersections(mesh.points, mesh.triangles, kMostSuspects);
    if (found.crossing.empty() && found.touching.empty()) return;
    for (const auto* pairs : {&found.crossing, &found.touching}) {
      for (const TrianglePair& pair : *pairs) suspects.push_back(pair.position);
    }
    mesh = start;
  }
}

}  // namespace deliso

#include "surface/recover.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "surface/umbrella.h"
#include "surface/violation_queue.h"

namespace deliso {

namespace {

// A point to insert and where the search for its conflict region may begin.
struct RefinementPoint {
  Vec3 point;
  TetId start;
};

// A refinement point farther than this from the isosurface (mesh-space units) is moved onto it, or dropped.
constexpr double kOnSurface = 1e-7;

class Recovery {
 public:
  Recovery(RestrictedDelaunay& restricted, const RecoverOptions& options, RecoverStats& stats,
           std::vector<double>* pole_heights)
      : restricted_(restricted),
        delaunay_(restricted.delaunay()),
        isosurface_(restricted.isosurface()),
        options_(options),
        stats_(stats),
        pole_heights_(pole_heights),
        umbrella_(restricted),
        queue_(options.order) {}

  void run(Controls& controls);

 private:
  void queue_everything();
  void queue_edge(DualEdgeId e);
  void queue_umbrella(VertexId q);
  std::optional<RefinementPoint> multi_intersect(DualEdgeId e) const;
  std::optional<RefinementPoint> extract_manifold(VertexId q);
  std::optional<RefinementPoint> approximate_geometry(DualEdgeId e) const;

  [[nodiscard]] double geometric_badness(const DualEdge& edge) const;
  [[nodiscard]] double mean_pole_height(const DualEdge& edge) const;
  std::optional<RefinementPoint> farthest_of_umbrella(VertexId q) const;
  std::optional<RefinementPoint> farthest_in_voronoi_cell(VertexId q);
  [[nodiscard]] std::optional<Vec3> onto_surface(const Vec3& p) const;
  bool insert(ViolationKind kind, const RefinementPoint& candidate);
  void inherit_pole_height();

  RestrictedDelaunay& restricted_;
  const Tetrahedralization& delaunay_;
  const Isosurface& isosurface_;
  const RecoverOptions& options_;
  RecoverStats& stats_;
  std::vector<double>* pole_heights_;
  UmbrellaInspector umbrella_;
  ViolationQueue queue_;
  std::vector<bool> umbrella_queued_;  // of each vertex
  std::vector<Hit> hits_;
};

void Recovery::run(Controls& controls) {
  queue_everything();
  while (!controls.must_stop("recover", delaunay_.vertex_count(), queue_.size())) {
    const std::optional<Violation> violation = queue_.pop();
    if (!violation) break;

    // What was queued may have been mended or destroyed meanwhile.
    std::optional<RefinementPoint> candidate;
    if (violation->kind == ViolationKind::kExtractManifold) {
      umbrella_queued_[violation->element] = false;
      candidate = extract_manifold(VertexId(violation->element));
    } else {
      const DualEdgeId e(violation->element);
      if (restricted_.dual_edge(e).generation != violation->generation) continue;
      candidate = violation->kind == ViolationKind::kMultiIntersect ? multi_intersect(e) : approximate_geometry(e);
    }
    if (!candidate || !insert(violation->kind, *candidate)) continue;

    inherit_pole_height();
    for (const DualEdgeId e : restricted_.touched_edges()) queue_edge(e);
    for (const VertexId q : restricted_.touched_vertices()) queue_umbrella(q);
  }
}

void Recovery::queue_everything() {
  for (std::size_t i = 0; i < restricted_.dual_edge_slots(); ++i) {
    if (restricted_.is_alive(DualEdgeId(i))) queue_edge(DualEdgeId(i));
  }
  for (std::size_t i = 0; i < delaunay_.vertex_count(); ++i) {
    if (!restricted_.is_virtual(VertexId(i))) queue_umbrella(VertexId(i));
  }
}

void Recovery::queue_edge(DualEdgeId e) {
  if (!restricted_.is_alive(e)) return;
  const DualEdge& edge = restricted_.dual_edge(e);
  if (edge.hits.size() > 1) {
    const double farthest = std::max(std::abs(edge.hits.front().t), std::abs(edge.hits.back().t));
    queue_.push({ViolationKind::kMultiIntersect, e.value, edge.generation}, farthest, edge.radius, edge.dual.origin);
  }
  const double badness = geometric_badness(edge);
  if (badness > 1) {
    queue_.push({ViolationKind::kApproximateGeometry, e.value, edge.generation}, badness, edge.radius,
                edge.dual.origin);
  }
}

void Recovery::queue_umbrella(VertexId q) {
  umbrella_queued_.resize(delaunay_.vertex_count(), false);
  if (umbrella_queued_[q.index()]) return;
  umbrella_queued_[q.index()] = true;
  queue_.push({ViolationKind::kExtractManifold, q.value, 0}, 0, 0, {});
}

// MultiIntersect: a dual edge with several hits gives the one farthest from its facet.
std::optional<RefinementPoint> Recovery::multi_intersect(DualEdgeId e) const {
  const DualEdge& edge = restricted_.dual_edge(e);
  if (edge.hits.size() < 2) return std::nullopt;
  const double first = edge.hits.front().t;
  const double last = edge.hits.back().t;
  return RefinementPoint{edge.dual.at(std::abs(first) > std::abs(last) ? first : last), edge.facet.tet()};
}

// ExtractManifold: an umbrella that is no disk gives its x_sigma farthest from the vertex. On the box a half disk will
// do.
std::optional<RefinementPoint> Recovery::extract_manifold(VertexId q) {
  const auto will_do = [&](UmbrellaShape shape) {
    return shape == UmbrellaShape::kDisk || (shape == UmbrellaShape::kHalfDisk && restricted_.is_on_box(q));
  };
  if (will_do(restricted_.quick_umbrella_shape(q)) || will_do(umbrella_.inspect(q))) return std::nullopt;
  if (auto candidate = farthest_of_umbrella(q)) return candidate;
  return farthest_in_voronoi_cell(q);
}

std::optional<RefinementPoint> Recovery::farthest_of_umbrella(VertexId q) const {
  std::optional<RefinementPoint> farthest;
  double longest = 0;
  for (const FacetId f : umbrella_.facets()) {
    const DualEdgeId e = restricted_.dual_edge_of(f);
    if (e.is_none()) continue;
    const DualEdge& edge = restricted_.dual_edge(e);
    for (const Hit& hit : edge.hits) {
      const Vec3 x = edge.dual.at(hit.t);
      const double length = squared_distance(x, delaunay_.point(q));
      if (length <= longest) continue;
      longest = length;
      farthest = RefinementPoint{x, edge.facet.tet()};
    }
  }
  return farthest;
}

// A vertex without restricted triangles: its Voronoi cell swallows a piece of the surface. Rays from the vertex along
// the gradient and in a dozen other directions look for the farthest point of that piece.
std::optional<RefinementPoint> Recovery::farthest_in_voronoi_cell(VertexId q) {
  constexpr double kGolden = 1.618033988749895;
  const Vec3 from = delaunay_.point(q);
  const Vec3 gradient = isosurface_.gradient(from);
  const std::array<Vec3, 7> axes = {gradient / std::max(norm(gradient), 1e-300),
                                    Vec3{0, 1, kGolden},
                                    Vec3{0, 1, -kGolden},
                                    Vec3{1, kGolden, 0},
                                    Vec3{1, -kGolden, 0},
                                    Vec3{kGolden, 0, 1},
                                    Vec3{kGolden, 0, -1}};
  std::optional<RefinementPoint> farthest;
  double longest = 0;
  for (const Vec3& axis : axes) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 direction = side * axis / std::max(norm(axis), 1e-300);
      // The cell ends where the ray meets the nearest bisector.
      double end = isosurface_.box().diagonal();
      for (const TetId t : umbrella_.star()) {
        for (const VertexId v : delaunay_.vertices(t)) {
          if (v == q || v == kInfiniteVertex) continue;
          const Vec3 d = delaunay_.point(v) - from;
          if (dot(direction, d) > 0) end = std::min(end, squared_norm(d) / (2 * dot(direction, d)));
        }
      }
      if (end <= options_.size_bound) continue;
      const Line ray{from, direction};
      isosurface_.all_hits(ray, 1e-6, end, hits_, stats_.search);
      for (const Hit& hit : hits_) {
        const Vec3 x = ray.at(hit.t);
        if (hit.t <= longest || !isosurface_.box().contains(x)) continue;
        longest = hit.t;
        farthest = RefinementPoint{x, delaunay_.incident_tet(q)};
      }
    }
  }
  return farthest;
}

// ApproximateGeom: a triangle too coarse gives its x_sigma.
std::optional<RefinementPoint> Recovery::approximate_geometry(DualEdgeId e) const {
  const DualEdge& edge = restricted_.dual_edge(e);
  if (geometric_badness(edge) <= 1) return std::nullopt;
  return RefinementPoint{edge.dual.at(surface_hit(edge)), edge.facet.tet()};
}

// The largest of the criteria's ratios to their thresholds: above 1 the triangle is too coarse.
double Recovery::geometric_badness(const DualEdge& edge) const {
  const GeometryCriterion& limit = options_.geometry;
  if (!restricted_.is_dual_to_surface(edge.facet) || edge.radius <= limit.r_min) return 0;
  const double h = std::abs(surface_hit(edge));
  if (std::hypot(h, edge.radius) < options_.size_bound) return 0;
  const Vec3& a = delaunay_.point(edge.vertices[0]);
  const Vec3& b = delaunay_.point(edge.vertices[1]);
  const Vec3& c = delaunay_.point(edge.vertices[2]);
  const double shortest = std::sqrt(std::min({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)}));
  double badness = std::max(h / (edge.radius * limit.epsilon), edge.radius / (shortest * limit.rho));
  badness = std::max(badness, h / limit.max_distance);
  if (std::isfinite(limit.epsilon2)) {
    const double size = limit.criterion2 == Criterion2::kCircumradius ? edge.radius : shortest;
    badness = std::max(badness, size / (mean_pole_height(edge) * limit.epsilon2));
  }
  return badness;
}

double Recovery::mean_pole_height(const DualEdge& edge) const {
  double sum = 0;
  for (const VertexId v : edge.vertices) sum += (*pole_heights_)[v.index()];
  return sum / 3;
}

// A new vertex takes the mean pole height of its neighbours on the surface, or that of the nearest of them.
void Recovery::inherit_pole_height() {
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
  const double inherited = options_.geometry.new_pole == NewPole::kMean ? sum / count : nearest_height;
  pole_heights_->push_back(count > 0 ? inherited : isosurface_.box().diagonal());
}

// A hit outside the box stands for the point of the boundary curve that it is clamped to. A hit that the signs alone
// forced may lie off the surface; it is moved onto it along the gradient.
std::optional<Vec3> Recovery::onto_surface(const Vec3& p) const {
  const Vec3 inside = isosurface_.box().clamp(p);
  const Vec3 gradient = isosurface_.gradient(inside);
  const double steepness = norm(gradient);
  if (std::abs(isosurface_.value(inside)) <= kOnSurface * steepness) return inside;
  if (!(steepness > 0)) return std::nullopt;
  const Line down{inside, -gradient / steepness};
  const auto t = isosurface_.nearest_falling_hit(down, options_.size_bound, stats_.search);
  if (!t || !isosurface_.box().contains(down.at(*t))) return std::nullopt;
  return down.at(*t);
}

bool Recovery::insert(ViolationKind kind, const RefinementPoint& candidate) {
  const std::optional<Vec3> p = onto_surface(candidate.point);
  if (!p) return false;
  if (restricted_.insert(*p, candidate.start, options_.size_bound) != RestrictedDelaunay::Outcome::kInserted) {
    ++stats_.refused_by_size_bound;
    return false;
  }
  ++stats_.insertions;
  if (SignedDelaunay::on_box(isosurface_.box(), *p)) ++stats_.boundary_splits;
  switch (kind) {
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

}  // namespace

void recover(RestrictedDelaunay& restricted, const RecoverOptions& options, Controls& controls, RecoverStats& stats,
             std::vector<double>* pole_heights) {
  Recovery(restricted, options, stats, pole_heights).run(controls);
}

}  // namespace deliso

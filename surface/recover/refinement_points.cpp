// The points that stage 1 inserts: what MultiIntersect, ExtractManifold and ApproximateGeom (Dey and Levine, Figure 5
// and section 3.1) ask for, one violation at a time. The loop over them is in recover.cpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "surface/recover/recover_loop.h"

namespace deliso {

namespace {

// A refinement point farther than this from the isosurface (mesh-space units) is moved onto it, or dropped.
constexpr double kOnSurface = 1e-7;

}  // namespace

// Figure 5, line 2, MultiIntersect: when V_sigma meets the surface in several points, the one farthest from sigma is
// inserted.
std::optional<RefinementPoint> RecoverLoop::multi_intersect(DualEdgeId e) const {
  const DualEdge& v_sigma = restricted_.dual_edge(e);
  if (v_sigma.hits.size() <= 1) return std::nullopt;
  return point_at(v_sigma, farthest_hit(v_sigma));
}

// Lines 3 and 5, ExtractManifold: when D_q is no topological disk, the x_sigma, sigma in D_q, farthest from q is
// inserted. If the size bound has left several hits on a dual edge, all of them are compared. When D_q is empty (the
// paper leaves that out), a point in the Voronoi cell of q is inserted.
std::optional<RefinementPoint> RecoverLoop::extract_manifold(VertexId q) {
  if (is_disk(q)) return std::nullopt;
  if (const auto farthest = farthest_of_umbrella(q)) return farthest;
  return farthest_in_voronoi_cell(q);
}

// Line 4, ApproximateGeom: when r > r_min and h / r > epsilon or r / l > rho, x_sigma is inserted.
std::optional<RefinementPoint> RecoverLoop::approximate_geometry(DualEdgeId e) const {
  const DualEdge& v_sigma = restricted_.dual_edge(e);
  if (geometric_badness(v_sigma) <= 1) return std::nullopt;
  return point_at(v_sigma, surface_hit(v_sigma));
}

// A point on a dual edge lies in the circumball of the tetrahedron at that end which is on its side of the facet.
RefinementPoint RecoverLoop::point_at(const DualEdge& edge, double t) const {
  const FacetId f = t > 0 ? delaunay_.mirror(edge.facet) : edge.facet;
  return {edge.dual.at(t), f.tet()};
}

double RecoverLoop::farthest_hit(const DualEdge& edge) {
  const double first = edge.hits.front().t, last = edge.hits.back().t;
  return std::abs(first) > std::abs(last) ? first : last;
}

// The Disk() test of section 5: on the box a half disk will do. When it fails, umbrella_ holds D_q.
bool RecoverLoop::is_disk(VertexId q) {
  const auto will_do = [&](UmbrellaShape shape) {
    return shape == UmbrellaShape::kDisk || (shape == UmbrellaShape::kHalfDisk && restricted_.is_on_box(q));
  };
  return will_do(restricted_.quick_umbrella_shape(q)) || will_do(umbrella_.inspect(q));
}

std::optional<RefinementPoint> RecoverLoop::farthest_of_umbrella(VertexId q) const {
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
      farthest = point_at(edge, hit.t);
    }
  }
  return farthest;
}

// A vertex without restricted triangles: its Voronoi cell swallows a piece of the surface. Rays from the vertex along
// the gradient and in a dozen other directions look for the farthest point of that piece.
std::optional<RefinementPoint> RecoverLoop::farthest_in_voronoi_cell(VertexId q) {
  constexpr double kGolden = 1.618033988749895;
  const Vec3 from = delaunay_.point(q);
  const Vec3 gradient = isosurface_.gradient(from);
  const std::array<Vec3, 7> axes = {gradient / std::max(norm_of_any_size(gradient), 1e-300),
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
        farthest = RefinementPoint{x, umbrella_.star().front()};
      }
    }
  }
  // It lies in the Voronoi cell, so one of the tetrahedra around the vertex is in conflict with it.
  if (farthest) {
    const auto star = umbrella_.star();
    const auto start =
        std::find_if(star.begin(), star.end(), [&](TetId t) { return restricted_.in_conflict(t, farthest->point); });
    if (start != star.end()) farthest->start = *start;
  }
  return farthest;
}

// How far a restricted triangle is beyond the criteria (surface/base/criteria.h): above 1 x_sigma is to be inserted.
double RecoverLoop::geometric_badness(const DualEdge& edge) const {
  const Criteria& limit = options_.geometry;
  if (!restricted_.is_dual_to_surface(edge.facet) || !exceeds_r_min(edge.radius, limit)) return 0;
  TriangleMeasures sigma{.h = std::abs(surface_hit(edge)), .r = edge.radius};
  if (is_below_size_bound(sigma)) return 0;
  const Vec3& a = delaunay_.point(edge.vertices[0]);
  const Vec3& b = delaunay_.point(edge.vertices[1]);
  const Vec3& c = delaunay_.point(edge.vertices[2]);
  sigma.l = std::sqrt(std::min({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)}));
  if (std::isinf(limit.epsilon2)) return approximate_geometry_badness(sigma, limit);
  sigma.h_mean = mean_pole_height(edge);
  return refine_geometry_badness(sigma, limit);
}

// Is x_sigma nearer to the vertices of sigma than the size bound allows?
bool RecoverLoop::is_below_size_bound(const TriangleMeasures& sigma) const {
  // Squares tell, but for near ties.
  const double bound = options_.size_bound;
  const bool may_be = sigma.h * sigma.h + sigma.r * sigma.r <= 1.001 * (bound * bound);
  return may_be && std::hypot(sigma.h, sigma.r) < bound;
}

double RecoverLoop::mean_pole_height(const DualEdge& edge) const {
  double sum = 0;
  for (const VertexId v : edge.vertices) sum += (*pole_heights_)[v.index()];
  return sum / 3;
}

// A hit outside the box stands for the point of the boundary curve that it is clamped to. A hit that the signs alone
// forced may lie off the surface; it is moved onto it along the gradient.
std::optional<Vec3> RecoverLoop::onto_surface(const Vec3& p) const {
  const Vec3 inside = isosurface_.box().clamp(p);
  const Vec3 gradient = isosurface_.gradient(inside);
  const double steepness = norm_of_any_size(gradient);
  if (std::abs(isosurface_.value(inside)) <= kOnSurface * steepness) return inside;
  if (!(steepness > 0)) return std::nullopt;
  const Line down{inside, -gradient / steepness};
  const auto t = isosurface_.nearest_falling_hit(down, options_.size_bound, stats_.search);
  if (!t || !isosurface_.box().contains(down.at(*t))) return std::nullopt;
  return down.at(*t);
}

}  // namespace deliso

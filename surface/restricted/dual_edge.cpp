// Dual edges and their hits: the part of RestrictedDelaunay that queries the isosurface.
#include "surface/restricted/restricted_delaunay.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "delaunay/constructions.h"

namespace deliso {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A hit this near to an end of its dual edge (mesh-space units, or this fraction of the edge's distance from the facet)
// may be an artefact of rounded circumcenters.
constexpr double kEndTolerance = 1e-7;

}  // namespace

double surface_hit(const DualEdge& edge) {
  // Hits alternate between the two directions; the first one crosses in the direction of the facet.
  double nearest = edge.hits.front().t;
  for (std::size_t i = 2; i < edge.hits.size(); i += 2) {
    if (std::abs(edge.hits[i].t) < std::abs(nearest)) nearest = edge.hits[i].t;
  }
  return nearest;
}

// The same as search_facet, for a facet between two tetrahedra of equal sign with these dual points. Most such dual
// edges lie far from the isosurface and need no search.
void RestrictedDelaunay::search_clear_facet(FacetId f, const DualEnd& from, const DualEnd& to) {
  if (has_virtual_vertex(f)) return;
  if (from.is_finite && to.is_finite ? isosurface_.is_clear(from.point, from.place, to.point, to.place)
                                     : isosurface_.is_clear_box(from.place, to.place)) {
    ++counters_.searches;
    return;
  }
  search_facet(f);
}

// Computes V_sigma and Sigma for a facet. Stores its dual edge when it has hits.
void RestrictedDelaunay::search_facet(FacetId f) {
  if (has_virtual_vertex(f)) return;
  const std::array<VertexId, 3> v = delaunay_.facet_vertices(f);
  const Vec3& a = delaunay_.point(v[0]);
  const Vec3& b = delaunay_.point(v[1]);
  const Vec3& c = delaunay_.point(v[2]);
  const Circumcircle circle = circumcircle(a, b, c);
  isosurface_.prefetch(isosurface_.place_of(circle.center));  // hits are often near it
  const Vec3 normal = cross(b - a, c - a);
  const double length = norm(normal);
  DualEdge& edge = scratch_;
  edge.facet = f;
  edge.vertices = v;
  edge.hits.clear();
  if (std::isfinite(circle.radius) && length > 0) {
    edge.dual = {circle.center, normal / length};
    edge.radius = circle.radius;
    edge.t_begin = dual_end(edge, f.tet(), -1);
    edge.t_end = std::max(edge.t_begin, dual_end(edge, delaunay_.mirror(f).tet(), +1));
    isosurface_.all_hits(edge.dual, edge.t_begin, edge.t_end, edge.hits, counters_);
  } else {
    // A nearly degenerate facet (needle): nothing can be measured on its dual line.
    edge.dual = {(a + b + c) / 3, {0, 0, 0}};
    edge.radius = kInfinity;
    edge.t_begin = edge.t_end = 0;
  }
  settle_hits(edge);
  if (edge.hits.empty()) return;
  const DualEdgeId e = make_edge();
  DualEdge& kept = dual_edges_[e.index()];
  const std::uint32_t generation = kept.generation;
  std::swap(kept, edge);
  kept.generation = generation;
  tets_[f.tet().index()].edges[f.face()] = e;
  const FacetId mirror = delaunay_.mirror(f);
  tets_[mirror.tet().index()].edges[mirror.face()] = e;
  touched_edges_.push_back(e);
  if (rule_ == FacetRule::kHits && is_dual_to_surface(f)) add_restricted(f);
}

// The parameter of the Voronoi vertex of t on the dual line of one of its facets; `side` is -1 when the line leaves t
// through the facet, +1 when it enters. The apex d satisfies |x(t) - d| = |x(t) - a|, which gives t = (|d - c|^2 - r^2)
// / (2 n.(d - c)); the sign of n.(d - c) is known exactly, so a rounded one that disagrees counts as 0.
double RestrictedDelaunay::dual_end(const DualEdge& edge, TetId t, int side) const {
  // The XOR leaves the fourth vertex when the facet's three cancel out; its slot is unpredictable, so there is no
  // branch.
  const auto& v = delaunay_.vertices(t);
  VertexId apex;
  apex.value = v[0].value ^ v[1].value ^ v[2].value ^ v[3].value ^ edge.vertices[0].value ^ edge.vertices[1].value ^
               edge.vertices[2].value;
  if (apex == kInfiniteVertex) return side * kInfinity;
  const Vec3 d = delaunay_.point(apex) - edge.dual.origin;
  const double height = std::max(side * dot(edge.dual.direction, d), std::numeric_limits<double>::min());
  return side * (squared_norm(d) - edge.radius * edge.radius) / (2 * height);
}

// The signs of the two tetrahedra overrule the search (unless the facet rule is kHits). If the first or last hit
// contradicts them, a hit within rounding of that end is dropped; if there is none, a hit is added at the end.
void RestrictedDelaunay::settle_hits(DualEdge& edge) {
  const bool begin_above = is_above(edge.facet.tet());
  const bool end_above = is_above(delaunay_.mirror(edge.facet).tet());
  auto& hits = edge.hits;
  const bool agree =
      hits.empty() ? begin_above == end_above : hits.front().falling == begin_above && hits.back().falling != end_above;
  if (agree) return;
  ++hits_against_signs_;
  if (rule_ == FacetRule::kHits) return;
  const auto clamped_end = [&](double t) {
    const double reach = edge.radius + isosurface_.box().diagonal();
    return std::isfinite(edge.radius) ? std::clamp(t, -reach, reach) : 0;
  };
  const auto is_near = [](double t, double end) {
    return std::abs(t - end) <= kEndTolerance * std::max(1.0, std::abs(end));
  };
  if (!hits.empty() && hits.front().falling != begin_above) {
    if (is_near(hits.front().t, edge.t_begin)) {
      hits.erase(hits.begin());
    } else {
      hits.insert(hits.begin(), {clamped_end(edge.t_begin), begin_above});
    }
  }
  const bool state = hits.empty() ? begin_above : !hits.back().falling;
  if (state == end_above) return;
  if (!hits.empty() && is_near(hits.back().t, edge.t_end)) {
    hits.pop_back();
  } else if (!hits.empty()) {
    hits.push_back({clamped_end(edge.t_end), state});
  } else {
    const double begin = clamped_end(edge.t_begin);
    const double end = clamped_end(edge.t_end);
    const bool at_begin =
        std::abs(isosurface_.value(edge.dual.at(begin))) < std::abs(isosurface_.value(edge.dual.at(end)));
    hits.push_back({at_begin ? begin : end, state});
  }
}

DualEdgeId RestrictedDelaunay::make_edge() {
  DualEdgeId e;
  if (free_edges_.empty()) {
    e = DualEdgeId(dual_edges_.size());
    dual_edges_.emplace_back();
  } else {
    e = free_edges_.back();
    free_edges_.pop_back();
  }
  ++dual_edges_[e.index()].generation;
  return e;
}

void RestrictedDelaunay::release_edge(DualEdgeId e) {
  DualEdge& edge = dual_edges_[e.index()];
  const FacetId mirror = delaunay_.mirror(edge.facet);
  tets_[edge.facet.tet().index()].edges[edge.facet.face()] = DualEdgeId::none();
  tets_[mirror.tet().index()].edges[mirror.face()] = DualEdgeId::none();
  edge.hits.clear();
  ++edge.generation;
  free_edges_.push_back(e);
}

}  // namespace deliso

#include "surface/restricted/restricted_delaunay.h"

#include <algorithm>
#include <cmath>

#include "delaunay/base/stopwatch.h"

namespace deliso {

namespace {

struct RestrictedFacet {
  std::array<VertexId, 3> vertices;
  bool is_seen_from_above = false;  // counterclockwise seen from outside the tetrahedron above

  // The edge of a vertex's link, with the same orientation for all facets.
  [[nodiscard]] LinkEdge link_edge(unsigned i) const {
    const VertexId next = vertices[(i + 1) % 3], last = vertices[(i + 2) % 3];
    return is_seen_from_above ? LinkEdge{next, last} : LinkEdge{last, next};
  }
};

}  // namespace

RestrictedDelaunay::RestrictedDelaunay(const Isosurface& isosurface, std::span<const Vec3> points, FacetRule rule,
                                       int threads)
    : SignedDelaunay(isosurface, points, threads), rule_(rule) {
  const Stopwatch watch;
  search_everything();
  touched_vertices_.clear();  // with the rule kHits, searches have touched some vertices
  link_changes_.clear();
  restricted_seconds_ += watch.seconds();
}

void RestrictedDelaunay::search_everything() {
  const std::size_t slots = delaunay_.tet_slots();
  tets_.resize(slots);
  touches_.resize(delaunay_.vertex_count());
  umbrellas_.resize(delaunay_.vertex_count());
  std::vector<DualEnd> dual_ends(slots);
  for (std::size_t i = 0; i < slots; ++i) {
    if (delaunay_.is_live(TetId(i))) dual_ends[i] = dual_end_at(dual_point(TetId(i)), TetId(i));
  }
  for (std::size_t i = 0; i < slots; ++i) {
    if (!delaunay_.is_live(TetId(i))) continue;
    for (unsigned face = 0; face < 4; ++face) {
      const FacetId f(TetId(i), face);
      const FacetId mirror = delaunay_.mirror(f);
      if (mirror < f) continue;
      if (is_dual_to_surface(f)) count_restricted(is_above(f.tet()) ? f : mirror);
      if (is_restricted(f)) {
        search_facet(f);
      } else {
        search_clear_facet(f, dual_ends[i], dual_ends[mirror.tet().index()]);
      }
    }
  }
}

RestrictedDelaunay::Outcome RestrictedDelaunay::insert(const Vec3& point, TetId start, double min_distance) {
  const Vec3 p = snapped(point);
  if (delaunay_.find_conflicts(p, start)) return Outcome::kDuplicate;
  if (delaunay_.is_blocked()) return Outcome::kBlocked;
  if (std::sqrt(delaunay_.nearest_squared_distance()) < min_distance) {
    delaunay_.abandon_cavity();
    return Outcome::kTooClose;
  }
  // Each facet of the star may have a dual edge: at most five facets for two edges of the rim.
  if (is_part_ && edges_left() < 3 * delaunay_.rim().size()) {
    delaunay_.abandon_cavity();
    return Outcome::kBlocked;
  }
  if (observer_ != nullptr) observer_->cavity(*this, p);
  ++stamp_;
  touched_edges_.clear();
  touched_vertices_.clear();
  forget_region();
  delaunay_.fill_cavity();
  const Stopwatch watch;
  renew_star();
  restricted_seconds_ += watch.seconds();
  if (observer_ != nullptr) observer_->inserted(*this);
  return Outcome::kInserted;
}

// Call before the conflict region is destroyed: releases the dual edges inside it and notes those of its rim.
void RestrictedDelaunay::forget_region() {
  rim_edges_.clear();
  for (const FacetId f : delaunay_.rim()) {
    const DualEdgeId e = dual_edge_of(f);
    rim_edges_.push_back({e, is_dual_to_surface(f)});
    prefetch(e);
  }
  const std::span<const TetId> region = delaunay_.conflict_region();
  rim_faces_.assign(region.size(), 0);
  for (const std::uint32_t from : delaunay_.rim_from_inside()) {
    rim_faces_[from >> 2] = static_cast<std::uint8_t>(rim_faces_[from >> 2] | 1u << (from & 3u));
  }
  for (const FacetId f : facets_once(region, 0, rim_faces_)) {
    if (is_dual_to_surface(f)) remove_restricted(f);
    if (const DualEdgeId e = dual_edge_of(f); !e.is_none()) release_edge(e);
  }
}

// The facets of some tetrahedra, from face `first_face` on, except those of `left_out` (bits for each tetrahedron, or
// empty); each facet is listed from one of its two sides. Which side is unpredictable: so all are written, and the
// unwanted ones are overwritten.
std::span<const FacetId> RestrictedDelaunay::facets_once(std::span<const TetId> tets, unsigned first_face,
                                                         std::span<const std::uint8_t> left_out) {
  facets_once_.resize(4 * tets.size() + 1);
  std::size_t count = 0;
  for (std::size_t i = 0; i < tets.size(); ++i) {
    const unsigned wanted = left_out.empty() ? ~0u : ~static_cast<unsigned>(left_out[i]);
    for (unsigned face = first_face; face < 4; ++face) {
      const FacetId f(tets[i], face);
      facets_once_[count] = f;
      count += static_cast<unsigned>(f < delaunay_.mirror(f)) & (wanted >> face);
    }
  }
  return std::span(facets_once_).first(count);
}

RestrictedDelaunay::DualEnd RestrictedDelaunay::dual_end_at(const Vec3& dual_point, TetId t) const {
  const DualEnd end{dual_point, isosurface_.place_of(dual_point), !delaunay_.is_ghost(t)};
  isosurface_.prefetch(end.place);
  return end;
}

// Call after the cavity is filled: computes the signs of the new tetrahedra, then their facets, the rim first.
void RestrictedDelaunay::renew_star() {
  sign_.resize(delaunay_.tet_slots());
  tets_.resize(delaunay_.tet_slots());
  touches_.resize(delaunay_.vertex_count());
  umbrellas_.resize(delaunay_.vertex_count());
  const std::span<const TetId> created = delaunay_.created();
  dual_ends_.resize(created.size());
  circumcenters_.resize(created.size());
  delaunay_.circumcenters_of_star(circumcenters_);
  for (std::size_t i = 0; i < created.size(); ++i) {
    const TetId t = created[i];
    tets_[t.index()] = {{}, static_cast<std::uint32_t>(i)};
    dual_ends_[i] = dual_end_at(delaunay_.is_ghost(t) ? dual_point(t) : circumcenters_[i], t);
  }
  for (std::size_t i = 0; i < created.size(); ++i) {
    const bool is_above = isosurface_.is_above(dual_ends_[i].point, dual_ends_[i].place);
    sign_[created[i].index()] = is_above ? Sign::kAbove : Sign::kBelow;
  }
  for (std::size_t i = 0; i < created.size(); ++i) {
    const RimEdge& rim = rim_edges_[i];
    // Most facets of the rim are far from the surface: one branch skips them.
    const unsigned concerns = static_cast<unsigned>(!rim.edge.is_none()) | static_cast<unsigned>(rim.was_restricted) |
                              static_cast<unsigned>(is_dual_to_surface(FacetId(created[i], 0)));
    if (concerns != 0) renew_rim_facet(created[i], rim);
  }
  for (const FacetId f : facets_once(created, 1, {})) {
    const TetId across = delaunay_.mirror(f).tet();
    const bool restricted = sign_[f.tet().index()] != sign_[across.index()];
    if (rule_ == FacetRule::kSigns ? restricted : is_dual_to_surface(f)) add_restricted(f);
    if (restricted) {
      search_facet(f);
    } else {
      search_clear_facet(f, dual_ends_[tets_[f.tet().index()].position], dual_ends_[tets_[across.index()].position]);
    }
  }
  touch(last_vertex());
  if (rule_ == FacetRule::kSigns) judge_umbrellas();
}

void RestrictedDelaunay::renew_rim_facet(TetId created, const RimEdge& rim) {
  const FacetId f(created, 0);
  const bool has_other_hits = !rim.edge.is_none() && cut_back(rim, f);
  const bool restricted = is_dual_to_surface(f);
  if (restricted && !rim.was_restricted) add_restricted(f);
  if (!restricted && rim.was_restricted) remove_restricted(f);
  const DualEdgeId e = dual_edge_of(f);
  if (e.is_none()) {
    if (restricted) search_facet(f);  // the search found nothing, but the signs differ: the signs win
  } else if (has_other_hits || restricted != rim.was_restricted) {
    dual_edges_[e.index()].generation += 2;
    touched_edges_.push_back(e);
  }
}

// The dual edge of a facet on the rim is a part of the old dual edge: so its old hits are filtered, not searched again.
// Returns whether their number changed; an edge without hits is released.
bool RestrictedDelaunay::cut_back(const RimEdge& rim, FacetId f) {
  DualEdge& edge = dual_edges_[rim.edge.index()];
  tets_[f.tet().index()].edges[f.face()] = rim.edge;
  // Seen from inside the region, before that was destroyed.
  const bool begins_inside = edge.facet != delaunay_.mirror(f);
  if (begins_inside) {
    edge.facet = f;
    edge.t_begin = std::min(dual_end(edge, f.tet(), -1), edge.t_end);
  } else {
    edge.t_end = std::max(dual_end(edge, f.tet(), +1), edge.t_begin);
  }
  const std::size_t before = edge.hits.size();
  std::erase_if(edge.hits, [&](const Hit& hit) { return hit.t < edge.t_begin || hit.t > edge.t_end; });
  settle_hits(edge);
  const bool changed = edge.hits.size() != before;
  if (edge.hits.empty()) release_edge(rim.edge);
  return changed;
}

// For the rule kHits; a facet with a virtual vertex is decided by its signs.
bool RestrictedDelaunay::has_odd_hits(FacetId f) const {
  return RestrictedDelaunay::falls_through(f) || RestrictedDelaunay::falls_through(delaunay_.mirror(f));
}

bool RestrictedDelaunay::falls_through(FacetId f) const {
  if (rule_ == FacetRule::kSigns || has_virtual_vertex(f)) return SignedDelaunay::falls_through(f);
  const DualEdgeId e = dual_edge_of(f);
  if (e.is_none()) return false;
  const DualEdge& edge = dual_edges_[e.index()];
  return edge.hits.size() % 2 == 1 && edge.hits.front().falling == (edge.facet == f);
}

bool RestrictedDelaunay::has_virtual_vertex_or_guard(FacetId f) const {
  const std::array<VertexId, 3> v = delaunay_.facet_vertices(f);
  return is_virtual(v[0]) || is_virtual(v[1]) || is_virtual(v[2]);
}

void RestrictedDelaunay::count_restricted(FacetId from_above) {
  for (const VertexId v : delaunay_.facet_vertices(from_above)) {
    if (is_virtual(v)) continue;
    ++umbrellas_[v.index()].size;
    umbrellas_[v.index()].facet = from_above;
  }
}

void RestrictedDelaunay::add_restricted(FacetId f) {
  count_restricted(is_above(f.tet()) ? f : delaunay_.mirror(f));
  const RestrictedFacet facet{delaunay_.facet_vertices(f), is_above(f.tet())};
  for (unsigned i = 0; i < 3; ++i) {
    if (!is_virtual(facet.vertices[i])) touch(facet.vertices[i]).gain(facet.link_edge(i));
  }
}

// On the rim the sign inside the region has changed by now; the sign beyond it tells how the facet was oriented. (With
// the rule kHits this may be wrong, but it is not used.)
void RestrictedDelaunay::remove_restricted(FacetId f) {
  const RestrictedFacet facet{delaunay_.facet_vertices(f), !is_above(delaunay_.mirror(f).tet())};
  for (unsigned i = 0; i < 3; ++i) {
    const VertexId v = facet.vertices[i];
    if (is_virtual(v)) continue;
    --umbrellas_[v.index()].size;
    touch(v).lose(facet.link_edge(i));
  }
}

// Finds which umbrellas are certainly disks after the insertion.
void RestrictedDelaunay::judge_umbrellas() {
  const VertexId newest = last_vertex();
  for (std::size_t i = 0; i < touched_vertices_.size(); ++i) {
    Umbrella& umbrella = umbrellas_[touched_vertices_[i].index()];
    umbrella.is_disk = touched_vertices_[i] == newest
                           ? link_changes_[i].is_new_cycle(umbrella.size, [&](VertexId v) { return is_virtual(v); })
                           : umbrella.is_disk && link_changes_[i].keeps_cycle(newest);
  }
}

UmbrellaShape RestrictedDelaunay::quick_umbrella_shape(VertexId q) {
  if (rule_ == FacetRule::kHits) return UmbrellaShape::kBroken;  // the walk uses signs
  auto& [size, facet, is_disk] = umbrellas_[q.index()];
  if (is_disk) return UmbrellaShape::kDisk;
  if (size == 0) return UmbrellaShape::kEmpty;
  // The stored facet may be gone, and its slot reused by another one.
  if (facet.is_none() || !delaunay_.is_live(facet.tet()) || !is_above(facet.tet()) || !is_restricted(facet))
    return UmbrellaShape::kBroken;
  const std::array<VertexId, 3> v = delaunay_.facet_vertices(facet);
  if (v[0] != q && v[1] != q && v[2] != q) return UmbrellaShape::kBroken;
  const UmbrellaShape shape = shape_by_walk(*this, q, facet, size);
  is_disk = shape == UmbrellaShape::kDisk;
  return shape;
}

// Returns the record of the changes of the vertex's link.
LinkChange& RestrictedDelaunay::touch(VertexId v) {
  Touch& touch = touches_[v.index()];
  if (touch.stamp != stamp_) {
    touch = {stamp_, static_cast<std::uint32_t>(touched_vertices_.size())};
    touched_vertices_.push_back(v);
    if (link_changes_.size() < touched_vertices_.size()) link_changes_.emplace_back();
    link_changes_[touch.place].clear();
  }
  return link_changes_[touch.place];
}

}  // namespace deliso

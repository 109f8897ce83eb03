// The Delaunay triangulation restricted to the isosurface, kept up to date under insertions (stage 1).
//
// For every facet whose dual edge meets the isosurface we keep all hits: MultiIntersect needs all of them, and when an
// insertion shortens a dual edge its hits are filtered, not searched again.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "delaunay/base/counters.h"
#include "delaunay/base/shared_array.h"
#include "surface/base/observer.h"
#include "surface/restricted/link_change.h"
#include "surface/restricted/signed_delaunay.h"
#include "surface/restricted/umbrella.h"

namespace deliso {

// The rule that tells which facets are restricted. kSigns: those whose two tetrahedra differ in sign. kHits, for
// comparison, is nearer to the paper: those whose own dual edge was found to have an odd number of hits, whatever the
// signs at its ends. (In the paper any hit makes a facet restricted, and after MultiIntersect there is at most one.)
enum class FacetRule { kSigns, kHits };

using DualEdgeId = StrongId<struct DualEdgeTag>;

// The dual edge of a finite facet that is restricted or has hits. x(t) = dual.at(t), t in mesh-space units.
struct DualEdge {
  FacetId facet;                     // seen from the tetrahedron at the t_begin end
  std::array<VertexId, 3> vertices;  // of the facet, counterclockwise seen from the t_end side
  Line dual;                         // circumcenter of the facet and its unit normal, pointing towards t_end
  double radius = 0;                 // circumradius r of the facet
  double t_begin = 0;                // where the dual edge begins and ends: infinite towards a ghost
  double t_end = 0;
  std::vector<Hit> hits;         // V_sigma and Sigma: ascending, alternating; by kSigns consistent with the two signs
  std::uint32_t generation = 0;  // odd while alive; every change increases it, so a queue can recognize stale entries
};

// x_sigma of a restricted facet: the hit nearest to its plane among those that cross in the direction of the facet.
double surface_hit(const DualEdge& edge);

class RestrictedDelaunay : public SignedDelaunay {
 public:
  // See SignedDelaunay.
  RestrictedDelaunay(const Isosurface& isosurface, std::span<const Vec3> points, FacetRule rule = FacetRule::kSigns,
                     int threads = 1);

  enum class Outcome { kInserted, kDuplicate, kTooClose, kBlocked };
  // Inserts the point unless a vertex is nearer than `min_distance`. `start` is a tetrahedron that is probably in
  // conflict with it. The outcome kBlocked occurs only in parts.
  Outcome insert(const Vec3& point, TetId start, double min_distance);

  // Whether inserting the point would destroy t.
  [[nodiscard]] bool in_conflict(TetId t, const Vec3& point) const { return delaunay_.in_conflict(t, snapped(point)); }

  // Tells it of every insertion, also of those in parts made afterwards; null for none.
  void set_observer(Observer* observer) { observer_ = observer; }
  [[nodiscard]] Observer* observer() const { return observer_; }
  // Whether this is one of parts(): its new vertices have ids with gaps, until it has joined.
  [[nodiscard]] bool is_part() const { return is_part_; }
  // Of the insertion under way: see BowyerWatson.
  [[nodiscard]] std::span<const TetId> conflict_region() const { return delaunay_.conflict_region(); }
  [[nodiscard]] std::span<const FacetId> rim() const { return delaunay_.rim(); }
  [[nodiscard]] std::span<const TetId> created() const { return delaunay_.created(); }

  // What the last successful insertion changed: the dual edges that are new or changed, and the vertices whose umbrella
  // changed.
  [[nodiscard]] std::span<const DualEdgeId> touched_edges() const { return touched_edges_; }
  [[nodiscard]] std::span<const VertexId> touched_vertices() const { return touched_vertices_; }
  [[nodiscard]] VertexId last_vertex() const { return VertexId(delaunay_.vertex_count() - 1); }

  // Parts for several threads, one in each of some disjoint slabs, with room for so many insertions each (see
  // BowyerWatson). Returns no parts when there is no room. This object must not be used until the parts have joined.
  std::vector<std::unique_ptr<RestrictedDelaunay>> parts(std::span<const Slab> slabs, std::size_t insertions,
                                                         int threads = 1);
  // Whether there is room for an insertion; in a part a very large one may still not fit.
  [[nodiscard]] bool has_room() const {
    return !is_part_ || (delaunay_.has_room() && edges_left() >= kFewestEdgesLeft);
  }
  // Takes in the results of the parts. Returns the new id of each vertex.
  std::vector<VertexId> join(std::span<const std::unique_ptr<RestrictedDelaunay>> parts);

  // Slots of dual edges; `is_alive` tells the used ones.
  [[nodiscard]] std::size_t dual_edge_slots() const { return dual_edges_.size(); }
  [[nodiscard]] bool is_alive(DualEdgeId e) const { return (dual_edges_[e.index()].generation & 1u) != 0; }
  [[nodiscard]] const DualEdge& dual_edge(DualEdgeId e) const { return dual_edges_[e.index()]; }
  // The dual edge of a facet, or none when it has no hit.
  [[nodiscard]] DualEdgeId dual_edge_of(FacetId f) const { return tets_[f.tet().index()].edges[f.face()]; }

  // Whether the facet is restricted by the rule. Facets with a virtual vertex have no dual edge: their signs decide.
  [[nodiscard]] bool is_dual_to_surface(FacetId f) const {
    return rule_ == FacetRule::kSigns ? is_restricted(f) : has_odd_hits(f);
  }
  [[nodiscard]] bool falls_through(FacetId f) const override;

  // The shape of a vertex's umbrella, as far as recorded changes or a quick walk can tell it (see link_change.h,
  // shape_by_walk). Precondition: only insert() has changed signs.
  [[nodiscard]] UmbrellaShape quick_umbrella_shape(VertexId q);

  [[nodiscard]] const SearchCounters& counters() const { return counters_; }
  // How often the hits of a dual edge contradicted the signs at its ends.
  [[nodiscard]] std::int64_t hits_against_signs() const { return hits_against_signs_; }
  // Wall-clock time spent deciding which facets are restricted; that of parts is added up.
  [[nodiscard]] double restricted_seconds() const { return restricted_seconds_; }

 private:
  static constexpr std::size_t kFewestEdgesLeft = 256;

  struct EdgeRoom {
    Range edges;
    std::vector<DualEdgeId> free;
  };
  RestrictedDelaunay(RestrictedDelaunay& whole, const PartRoom& room, const EdgeRoom& edges);
  void make_room(const PartRoom& last, std::size_t edges, int threads);
  void forget_facets_gone();
  void rename(std::span<const VertexId> renamed);
  [[nodiscard]] std::size_t edges_left() const { return free_edges_.size() + dual_edges_.room_left(); }

  struct RimEdge {
    DualEdgeId edge;  // of a facet on the rim, or none
    bool was_restricted = false;
  };

  [[nodiscard]] bool has_odd_hits(FacetId f) const;
  void search_everything();
  void forget_region();
  [[nodiscard]] std::span<const FacetId> facets_once(std::span<const TetId> tets, unsigned first_face,
                                                     std::span<const std::uint8_t> left_out);
  void renew_star();
  void renew_rim_facet(TetId created, const RimEdge& rim);
  void search_facet(FacetId f);
  bool cut_back(const RimEdge& rim, FacetId f);
  void settle_hits(DualEdge& edge);
  [[nodiscard]] double dual_end(const DualEdge& edge, TetId t, int side) const;
  // Where the dual edges of a tetrahedron end.
  struct DualEnd {
    Vec3 point;
    Isosurface::Place place;
    bool is_finite = false;
  };
  [[nodiscard]] DualEnd dual_end_at(const Vec3& dual_point, TetId t) const;
  void search_clear_facet(FacetId f, const DualEnd& from, const DualEnd& to);
  // Constant time when there are no guards, which is the rule.
  [[nodiscard]] bool has_virtual_vertex(FacetId f) const {
    return guards_ == 0 ? f.face() != 3 && delaunay_.is_ghost(f.tet()) : has_virtual_vertex_or_guard(f);
  }
  [[nodiscard]] bool has_virtual_vertex_or_guard(FacetId f) const;
  void count_restricted(FacetId from_above);
  void add_restricted(FacetId f);
  void remove_restricted(FacetId f);
  LinkChange& touch(VertexId v);
  void judge_umbrellas();
  // Prefetches a dual edge, if there is one, without a branch on whether there is.
  void prefetch(DualEdgeId e) const {
    if (!dual_edges_.empty()) __builtin_prefetch(&dual_edges_[std::min(e.index(), dual_edges_.size() - 1)]);
  }
  DualEdgeId make_edge();
  void release_edge(DualEdgeId e);

  FacetRule rule_;
  Observer* observer_ = nullptr;
  struct TetRecord {
    std::array<DualEdgeId, 4> edges;  // of its facets
    std::uint32_t position = 0;       // in created(), if it is one of them
  };
  SharedArray<TetRecord> tets_;
  struct Touch {
    std::uint32_t stamp = 0;  // the last insertion that touched the vertex; 0 for none
    std::uint32_t place = 0;  // index in touched_vertices_, valid if that insertion is the last one
  };
  SharedArray<Touch> touches_;  // of each vertex
  std::uint32_t stamp_ = 1;
  std::vector<Vec3> circumcenters_;      // of created(), but for ghosts
  std::vector<DualEnd> dual_ends_;       // of created()
  std::vector<FacetId> facets_once_;     // the latest
  std::vector<std::uint8_t> rim_faces_;  // of each tetrahedron of the conflict region: one bit for each face on the rim
  // The umbrella of each vertex: its number of restricted facets, and one of them, which may be stale.
  struct Umbrella {
    std::uint32_t size = 0;
    FacetId facet;
    bool is_disk = false;  // whether it is known to be one by the rule kSigns
  };
  SharedArray<Umbrella> umbrellas_;

  SharedArray<DualEdge> dual_edges_;
  std::vector<DualEdgeId> free_edges_;
  std::vector<DualEdgeId> touched_edges_;
  std::vector<VertexId> touched_vertices_;
  std::vector<LinkChange> link_changes_;  // of touched_vertices_; further elements are kept for later insertions

  std::vector<RimEdge> rim_edges_;
  DualEdge scratch_;
  SearchCounters counters_;
  std::int64_t hits_against_signs_ = 0;
  double restricted_seconds_ = 0;
  bool is_part_ = false;
};

}  // namespace deliso

// Incremental Delaunay triangulation in space (Bowyer 1981, Watson 1981) with ghost tetrahedra and exact predicates.
//
// An insertion has two steps, so that a caller that keeps data on the tetrahedra can read it before they are destroyed:
//   find_conflicts(p, t)   the conflict region of p, found from a tetrahedron in conflict or, failing that, by a walk;
//   fill_cavity()          replaces the region by the star of p.
// A removal has one step: remove(v), which may remove other vertices along with v. After insertions and removals in any
// order the triangulation is that of the remaining points, as if it had been built from them in the order of their
// vertices.
//
// Parts. Several threads may insert at the same time, each through a part: a triangulation that shares the arrays of
// the whole, but destroys only tetrahedra within its slab. A tetrahedron lies within a slab if all its finite vertices
// lie strictly between the slab's planes. Parts treat all other tetrahedra as *frozen*. A neighbour of a tetrahedron
// within a slab shares two or three finite vertices with it, so it lies within the same slab or within none: parts
// never meet. An insertion whose conflict region has a frozen tetrahedron is *blocked*, and left to the whole. The
// result of a part depends neither on threads nor on other parts.
//
// Ties. orient3d is zero exactly for coplanar points. A zero insphere is resolved by a symbolic perturbation of the
// lifted coordinate by vertex index (Devillers, Teillaud: Perturbations for Delaunay and weighted Delaunay 3D
// triangulations, 2011), which amounts to infinitesimal weights. So the perturbed insphere is never zero, and a flat
// tetrahedron never appears. A point coplanar with a hull facet is in conflict with the facet's ghost exactly when it
// is in conflict with the tetrahedron inside.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/slab.h"
#include "delaunay/lifted_rows.h"
#include "delaunay/point_location.h"
#include "delaunay/rim_edges.h"
#include "delaunay/static_filter.h"
#include "delaunay/tetrahedralization.h"

namespace deliso {

// Where a part works: its slab, and its ranges for new vertices and tetrahedra.
struct PartRoom {
  Slab slab;
  Range vertices;
  Range tets;
  std::vector<TetId> free;  // free slots, in addition to the range
};

class BowyerWatson : public Tetrahedralization {
 public:
  // All later points must lie in `box` (for the static filters); a point outside throws InternalError.
  explicit BowyerWatson(const Box3& box);

  // Builds from scratch. Vertex i of the result is points[i] unless it duplicates an earlier point; vertex_of[i], when
  // asked for, tells the vertex of each input point. Inserts in BRIO + Hilbert order. Returns false and leaves the
  // triangulation empty when all points are coplanar (fewer than four included).
  bool build(std::span<const Vec3> points, std::vector<VertexId>* vertex_of = nullptr) {
    return build(points, vertex_of, std::nullopt);
  }
  // The same triangulation. With many points most of it is made by parts in two slabs (build_in_slabs.cpp). Its
  // tetrahedra are in other slots than build() gives them, but in the same slots for any number of threads.
  bool build_in_slabs(std::span<const Vec3> points, std::vector<VertexId>* vertex_of, int threads) {
    return build(points, vertex_of, threads);
  }

  // The tetrahedron (perhaps a ghost) that contains p, by a visibility walk from `hint` (any live tetrahedron).
  [[nodiscard]] TetId locate(const Vec3& p, TetId hint) const;
  // The same for p moved by an infinitesimal (x, y^2, z^3), where x, y and z have the given signs. The moved point lies
  // in one finite tetrahedron, or beyond the hull; a finite answer does not depend on `hint`, a ghost may.
  [[nodiscard]] TetId locate_moved(const Vec3& p, const Signs& signs, TetId hint) const;
  // The tetrahedra that a segment moved in this way enters after `from` (point_location.h).
  void append_passed_moved(const Vec3& a, const Vec3& b, const Signs& signs, TetId from,
                           std::vector<Passage>& passed) const;
  // Whether p is in conflict with t (perturbed as if p were inserted next).
  [[nodiscard]] bool in_conflict(TetId t, const Vec3& p) const;

  // Finds the conflict region of p. `start` is a live tetrahedron, preferably one in conflict with p; otherwise a walk
  // from it finds one. Returns the vertex that p duplicates, if any; then there is no region. In a part there may also
  // be none because the insertion is blocked, see is_blocked().
  std::optional<VertexId> find_conflicts(const Vec3& p, TetId start);
  // Of a part: whether find_conflicts() gave up. It does so if the region reaches beyond the slab, is not found at
  // `start`, or there is no room to fill it.
  [[nodiscard]] bool is_blocked() const { return is_blocked_; }
  [[nodiscard]] std::span<const TetId> conflict_region() const { return std::span(region_).first(region_size_); }
  // The facets around the region, each seen from the tetrahedron outside.
  [[nodiscard]] std::span<const FacetId> rim() const { return std::span(rim_).first(rim_size_); }

  // The same facets seen from the region: 4 * position in conflict_region() + face.
  [[nodiscard]] std::span<const std::uint32_t> rim_from_inside() const { return std::span(rim_from_).first(rim_size_); }

  // The squared distance of p from the nearest vertex, which always lies on the rim.
  [[nodiscard]] double nearest_squared_distance() const { return rows_.nearest_squared(); }

  // Stars p over the rim. The new tetrahedra are created(): created()[i] has p in slot 0, and its face 0 is the mirror
  // of what was rim()[i]. Their ids may be those of destroyed tetrahedra.
  VertexId fill_cavity();
  [[nodiscard]] std::span<const TetId> created() const { return created_; }
  // Right after fill_cavity(): centers[i] = the circumcenter of created()[i], as circumcenter() has it; those of ghosts
  // are left alone. Precondition: as many centers as tetrahedra.
  void circumcenters_of_star(std::span<Vec3> centers) const;
  // Drops the region without an insertion.
  void abandon_cavity();

  // Removes v and fills the hole that its star leaves (vertex_removal.cpp). `others` marks, by vertex, more vertices to
  // remove (it may be shorter than the number of vertices). Those among them that are connected with v by edges may be
  // removed in the same call, which takes less time than one by one; their marks are reset. The new tetrahedra are
  // created(), the old ones destroyed(). A removed vertex keeps its number, without a tetrahedron, until close_gaps().
  // Returns false and changes nothing when all remaining points are coplanar.
  enum class Going : std::uint8_t { kNo, kYes, kNow };  // kNow is set by remove() alone
  bool remove(VertexId v, std::span<Going> others = {});
  // Slots; some may hold tetrahedra that are created().
  [[nodiscard]] std::span<const TetId> destroyed() const { return hole_.star; }
  // Renumbers the vertices without the removed ones, in the same order. Returns the new id of each old one. destroyed()
  // is empty afterwards.
  std::vector<VertexId> close_gaps();

  // The slots that an insertion of a part needs on average; with fewer, the part ends sooner.
  static constexpr double kTetsPerInsertion = 7;
  // Rooms for parts in disjoint slabs, each for so many insertions; none when there would be too many tetrahedra.
  // Precondition: no removed vertex waits for close_gaps().
  std::vector<PartRoom> make_rooms(std::span<const Slab> slabs, std::size_t insertions, int threads = 1,
                                   double tets_per_insertion = kTetsPerInsertion);
  // A part of `whole`. `whole` must not move or change until it has joined its parts.
  BowyerWatson(BowyerWatson& whole, const PartRoom& room);
  // Whether there is room for an insertion, unless it is a very large one.
  [[nodiscard]] bool has_room() const { return points_.room_left() > 0 && tets_left() >= kFewestLeft; }
  // Takes in one part after the other, in the order of their rooms. Then finish_join() renumbers the vertices without
  // gaps, in the same order, and returns the new id of each.
  void join(BowyerWatson& part);
  std::vector<VertexId> finish_join() { return close_gaps(); }

 private:
  // A face of a tetrahedron whose neighbour has yet to be tested, and the same facet seen from the neighbour.
  struct Untested {
    FacetId mirror;
    unsigned face = 0;
  };

  // Positions in rows_ of the vertices of a tetrahedron.
  using Corners = std::array<std::uint32_t, 4>;

  // While the region grows, the two highest bits of a tetrahedron's first mirror say what is known about it.
  enum Mark : std::uint32_t { kUnknown = 0, kInside = 1, kOutside = 2 };
  static constexpr unsigned kMarkShift = 30;
  static constexpr std::uint32_t kMirrorMask = (1u << kMarkShift) - 1;
  static constexpr std::size_t kMostTets = std::size_t{1} << (kMarkShift - 2);
  static constexpr std::size_t kFewestLeft = 256;  // slots

  // A frozen tetrahedron has no mark; it must not be read plainly, for another part may be writing its first mirror.
  [[nodiscard]] std::uint32_t mark(TetId t) const {
    std::uint32_t& value = const_cast<std::uint32_t&>(tets_[t.index()].mirrors[0].value);  // NOLINT: only read
    return std::atomic_ref(value).load(std::memory_order_relaxed) >> kMarkShift;
  }
  void set_mark(TetId t, Mark mark) {
    FacetId& mirror = tets_[t.index()].mirrors[0];
    mirror.value = (mirror.value & kMirrorMask) | (mark << kMarkShift);
  }

  // Precondition: t has no mark yet, or the same one.
  void add_mark(TetId t, Mark mark) {
    tets_[t.index()].mirrors[0].value |= static_cast<std::uint32_t>(mark) << kMarkShift;
  }

  [[nodiscard]] VertexId perturbation_rank(VertexId v) const { return ranks_.empty() ? v : ranks_[v.index()]; }
  [[nodiscard]] bool conflicts(TetId t, const Vec3& p, VertexId p_rank) const;
  std::optional<VertexId> find_conflicts_from_located(const Vec3& p, VertexId p_rank, TetId located);
  template <bool kIsPart>
  void grow_region(const Vec3& p, VertexId p_rank, TetId first);
  void reserve_more();
  template <bool kIsPart>
  void test_neighbours(std::uint32_t i, const Vec3& p, VertexId p_rank);
  template <bool kIsPart>
  void test_unknown_neighbours(std::uint32_t i, std::span<const Untested> untested, const Vec3& p, VertexId p_rank);
  void find_conflicts_of_part(const Vec3& p, TetId start);
  void grow_region_of_part(const Vec3& p, VertexId p_rank, TetId first);
  // Precondition: `mirror` is the mirror of a facet of a tetrahedron within the slab.
  [[nodiscard]] bool is_frozen(FacetId mirror) const {
    const VertexId far = vertices(mirror.tet())[mirror.face()];
    return far != kInfiniteVertex && !slab_->contains(point(far));
  }
  [[nodiscard]] std::size_t tets_left() const { return free_.size() + tets_.room_left(); }
  void take_slots(std::span<const TetId> old, std::size_t count);
  void star_rim(VertexId apex);
  template <class EdgeTable>
  void star_rim(VertexId apex, EdgeTable& edges);
  void take_along(VertexId v);
  [[nodiscard]] bool goes_now(VertexId v) const;
  void find_star();
  void add_star(VertexId v);
  bool triangulate_link();
  void find_fill();
  void glue_fill();
  // Builds in one go, or by parts on so many threads.
  bool build(std::span<const Vec3> points, std::vector<VertexId>* vertex_of, std::optional<int> threads_of_parts);
  void make_first_tet();
  // Points of the input in their insertion order, and the vertex of each inserted one.
  struct Insertions {
    std::span<const Vec3> points;
    std::span<const std::uint32_t> order;
    std::span<VertexId> vertices;

    [[nodiscard]] Insertions part(std::size_t first, std::size_t last) const {
      return {points, order.subspan(first, last - first), vertices.subspan(first, last - first)};
    }
  };
  void insert_all(const Insertions& all, std::optional<int> threads_of_parts);
  VertexId add_vertex(std::uint32_t input, const Vec3& p);
  // Inserts those that have no vertex yet.
  void insert_in_order(const Insertions& some);
  void insert_in_slabs(const Insertions& some, int threads);
  // Of a part: inserts those in its slab that are not blocked; `before` is the number of vertices before all parts.
  void insert_within(const Insertions& some, std::size_t before);
  [[nodiscard]] TetId locate_within(const Vec3& p, TetId hint) const;
  void number_as_input(std::span<const Vec3> points, std::vector<VertexId>& vertex_of);
  void clear();

  Box3 box_;
  StaticFilter filter_;
  std::optional<Slab> slab_;  // of a part
  bool is_blocked_ = false;
  std::vector<TetId> free_;  // free slots
  // Only the first region_size_ and rim_size_ elements count; the rest is room for appending without branches.
  std::vector<TetId> region_;
  std::vector<FacetId> rim_;
  std::uint32_t region_size_ = 0;
  std::uint32_t rim_size_ = 0;
  std::vector<TetId> created_;
  Vec3 pending_;  // the point of the open cavity

  LiftedRows rows_;                      // of the vertices met by the last search
  std::vector<Corners> region_corners_;  // of region_[i]
  std::vector<std::uint32_t> rim_from_;  // rim_[i] seen from inside, as 4 * position in region_ + face
  SquareEdgeTable edges_;
  // The scratch memory of remove().
  struct Hole {
    std::span<Going> others;
    std::vector<VertexId> gone;       // vertices removed together, the one asked for first
    std::vector<TetId> star;          // the tetrahedra at them
    std::vector<TetId> at_vertex;     // those at one of them
    std::vector<std::uint32_t> seen;  // of each tetrahedron: the latest walk around a vertex that reached it
    std::uint32_t walk = 0;
    std::vector<FacetId> rim;                     // seen from the star
    std::vector<FacetId> beyond;                  // seen from the tetrahedra around the star
    std::vector<VertexId> vertices;               // of the link, and perhaps of the tetrahedra around it; ascending
    std::vector<Vec3> points;                     // of these vertices
    std::unique_ptr<BowyerWatson> triangulation;  // of the points
    // The facets of the rim, named by their vertices in that triangulation.
    std::vector<std::pair<std::array<VertexId, 3>, std::uint32_t>> names;
    std::vector<std::uint32_t> first;   // of each of these vertices: the first name that begins with it
    std::vector<std::uint32_t> rim_at;  // of each facet of the triangulation: its position in rim, or none
    std::vector<TetId> fill;            // the tetrahedra of it that lie in the hole
    std::vector<std::uint32_t> place;   // of each of its tetrahedra: in fill, or none
  };
  Hole hole_;
  SharedArray<VertexId> ranks_;  // during build(): the input index of each vertex, which orders the perturbation
};

}  // namespace deliso

// A Delaunay triangulation of points on the isosurface in which every tetrahedron has a sign.
//
// The sign is that of the field at the tetrahedron's circumcenter, computed once. A facet is *restricted* when the
// signs of its two tetrahedra differ: then its dual edge meets the isosurface an odd number of times. So the restricted
// facets always bound a set of tetrahedra, whatever the rounding. The field is extended beyond the box by clamping. So
// ghosts have signs, too (from the limit of their dual ray), and a surface cut by the box needs no special case: its
// boundary shows as restricted facets at the infinite vertex.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/shared_array.h"
#include "delaunay/bowyer_watson.h"
#include "raycast/isosurface.h"

namespace deliso {

// The signs of tetrahedra by slot: 1 for above, 0 for below.
using TetSigns = std::vector<std::uint8_t>;

// Calls visit(t) for every slot t, ascending, whose sign differs between two arrays of bytes.
template <class Signs, class Visit>
void for_each_difference(const TetSigns& known, const Signs& signs, Visit visit) {
  constexpr std::size_t kAtOnce = 64;
  for (std::size_t first = 0; first < known.size(); first += kAtOnce) {
    const std::size_t last = std::min(known.size(), first + kAtOnce);
    if (std::memcmp(&known[first], &signs[first], last - first) == 0) continue;
    for (std::size_t i = first; i < last; ++i) {
      if (known[i] != static_cast<std::uint8_t>(signs[i])) visit(TetId(i));
    }
  }
}

// The effect of an exchange of points.
struct ExchangedPoints {
  std::vector<VertexId> renamed;    // the new id of each old vertex, or none if it was removed
  std::vector<VertexId> vertex_of;  // of each new point; none for one that is not finite
  std::vector<TetId> renewed;       // slots, ascending, whose tetrahedron is new or gone
};

class SignedDelaunay {
 public:
  // Points on the isosurface in mesh space, in its box; later points must lie in the box, too. When all points are
  // coplanar, two guard vertices far off the plane are added; facets with a guard count as infinite. Throws InputError
  // when all points are collinear or there are fewer than three. The signs are computed on several threads, with the
  // same result for any number. `vertex_of`, if given, receives the vertex of each point; none for a point that is not
  // finite.
  SignedDelaunay(const Isosurface& isosurface, std::span<const Vec3> points, int threads = 1,
                 std::vector<VertexId>* vertex_of = nullptr);
  virtual ~SignedDelaunay() = default;
  // Takes the triangulation and the signs of `other`. If `other` is of a derived class, its further members are
  // ignored.
  SignedDelaunay(SignedDelaunay&& other) = default;
  SignedDelaunay(const SignedDelaunay&) = delete;
  SignedDelaunay& operator=(const SignedDelaunay&) = delete;
  SignedDelaunay& operator=(SignedDelaunay&&) = delete;

  [[nodiscard]] const Isosurface& isosurface() const { return isosurface_; }
  [[nodiscard]] const Tetrahedralization& delaunay() const { return delaunay_; }
  [[nodiscard]] bool is_above(TetId t) const { return sign_[t.index()] == Sign::kAbove; }
  [[nodiscard]] bool is_restricted(FacetId f) const {
    return sign_[f.tet().index()] != sign_[delaunay_.neighbour(f.tet(), f.face()).index()];
  }
  // Whether the surface passes through a facet, falling from its tetrahedron, above the isovalue, to the one behind it.
  [[nodiscard]] virtual bool falls_through(FacetId f) const { return is_above(f.tet()) && is_restricted(f); }
  // Whether v is the infinite vertex or a guard, which are no points of the surface.
  [[nodiscard]] bool is_virtual(VertexId v) const {
    return v == kInfiniteVertex || (v.value >= first_guard_ && v.value < first_guard_ + guards_);
  }
  // Whether a vertex lies on the box, so that the surface may end there.
  [[nodiscard]] bool is_on_box(VertexId v) const { return on_box(isosurface_.box(), delaunay_.point(v)); }
  // The tetrahedron that holds p, by a walk from `hint`. If several do, the one in the direction of `inwards`, whatever
  // the hint; among several ghosts, any.
  [[nodiscard]] TetId locate(const Vec3& p, const Vec3& inwards, TetId hint) const {
    return delaunay_.locate_moved(p, signs_towards(p, inwards), hint);
  }
  // Appends the tetrahedra that the segment from a to b, moved as b is by locate(), enters after `from`, which holds a:
  // the last one holds b, or is the ghost behind the facet where the segment leaves the hull.
  void append_passed(const Vec3& a, const Vec3& b, const Vec3& inwards, TetId from, std::vector<Passage>& passed) const {
    delaunay_.append_passed_moved(a, b, signs_towards(b, inwards), from, passed);
  }
  // Removes vertices and inserts points. Then the vertices are numbered as if the triangulation had been built from the
  // remaining points, in their order, and then the new points, in theirs. New tetrahedra have the signs of their
  // circumcenters, the others keep their signs; the signs of free slots are meaningless. Returns false when the
  // exchange is impossible (the remaining points would be coplanar, or there are guards): then this object must not be
  // used any more. Not for derived classes.
  bool exchange(std::span<const VertexId> leaving, std::span<const Vec3> coming, ExchangedPoints& exchanged);
  // Gives a tetrahedron another sign than that of the field at its circumcenter.
  void set_sign(TetId t, bool above) { sign_[t.index()] = above ? Sign::kAbove : Sign::kBelow; }
  // The present signs, by slot of their tetrahedron; and the reverse.
  [[nodiscard]] TetSigns signs() const {
    TetSigns above(sign_.size());
    if (!above.empty()) std::memcpy(above.data(), sign_.data(), above.size());
    return above;
  }
  void set_signs(const TetSigns& above) {
    DELISO_CHECK(above.size() == sign_.size(), "every slot has a sign");
    if (!sign_.empty()) std::memcpy(sign_.data(), above.data(), sign_.size());
  }
  // Calls visit(t) for every slot t, ascending, whose sign differs from that in `known`.
  template <class Visit>
  void for_each_difference(const TetSigns& known, Visit visit) const {
    deliso::for_each_difference(known, sign_, visit);
  }
  // The same, but first copies the sign into `known`.
  template <class Visit>
  void for_each_change(TetSigns& known, Visit visit) const {
    for_each_difference(known, [&](TetId t) {
      known[t.index()] = static_cast<std::uint8_t>(sign_[t.index()]);
      visit(t);
    });
  }
  void flip_sign(TetId t) { sign_[t.index()] = is_above(t) ? Sign::kBelow : Sign::kAbove; }

  // A point as the triangulation stores it: settled on the volume's walls; coordinates below 2^-100 count as zero.
  [[nodiscard]] Vec3 snapped(const Vec3& p) const;
  // Whether a point lies on the surface of the box, exactly.
  static bool on_box(const Box3& box, const Vec3& p);

 protected:
  // A part of another one (see BowyerWatson); it has the same signs.
  SignedDelaunay(SignedDelaunay& whole, const PartRoom& room)
      : isosurface_(whole.isosurface_), delaunay_(whole.delaunay_, room), sign_(whole.sign_, room.tets) {
    DELISO_CHECK(whole.guards_ == 0, "there are no guards");
  }

  static Signs signs_towards(const Vec3& p, const Vec3& inwards) {
    return {p.x < inwards.x ? 1 : -1, p.y < inwards.y ? 1 : -1, p.z < inwards.z ? 1 : -1};
  }

  enum class Sign : std::uint8_t { kBelow, kAbove };  // kBelow until computed
  [[nodiscard]] Sign sign_at(const Vec3& p) const { return isosurface_.is_above(p) ? Sign::kAbove : Sign::kBelow; }
  [[nodiscard]] Sign sign_of(TetId t) const { return sign_at(dual_point(t)); }
  // The circumcenter of t; for a ghost the limit of its dual ray clamped to the box.
  [[nodiscard]] Vec3 dual_point(TetId t) const;

  const Isosurface& isosurface_;
  BowyerWatson delaunay_;
  SharedArray<Sign> sign_;  // of each tetrahedron
  std::uint32_t first_guard_ = 0;
  std::uint32_t guards_ = 0;
};

}  // namespace deliso

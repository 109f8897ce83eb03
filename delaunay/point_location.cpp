#include "delaunay/point_location.h"

namespace deliso {

namespace {

constexpr auto kAnywhere = [](TetId) { return true; };

// `is_beyond(a, b, c)` tells whether the point lies strictly on the side of the plane from which abc turns
// counterclockwise. Returns nothing where the walk would have to enter a tetrahedron that may_enter refuses.
template <class IsBeyond, class MayEnter>
TetId walk(const Tetrahedralization& tets, TetId hint, IsBeyond is_beyond, const MayEnter& may_enter) {
  // Step off a ghost into the hull: the walk itself decides whether p lies outside.
  TetId t = tets.is_ghost(hint) ? tets.neighbour(hint, 3) : hint;
  unsigned entered = 4;  // the face through which the walk came: p lies on this side of it
  std::uint32_t random = 0x9E3779B9u;

  for (;;) {
    const auto& v = tets.vertices(t);
    if (v[3] == kInfiniteVertex) return t;
    random = random * 1664525u + 1013904223u;
    const unsigned first = random >> 30;
    FacetId exit;
    for (unsigned i = 0; i < 4; ++i) {
      const unsigned face = (first + i) & 3u;
      if (face == entered) continue;
      const auto& slots = kFacetSlots[face];
      if (is_beyond(tets.point(v[slots[0]]), tets.point(v[slots[1]]), tets.point(v[slots[2]]))) {
        exit = FacetId(t, face);
        break;
      }
    }
    if (exit.is_none()) return t;
    const FacetId mirror = tets.mirror(exit);
    t = mirror.tet();
    entered = mirror.face();
    if (!may_enter(t)) return {};
  }
}

}  // namespace

TetId visibility_walk(const Tetrahedralization& tets, const StaticFilter& filter, const Vec3& p, TetId hint) {
  const auto is_beyond = [&](const Vec3& a, const Vec3& b, const Vec3& c) { return filter.orient(a, b, c, p) > 0; };
  return walk(tets, hint, is_beyond, kAnywhere);
}

TetId visibility_walk_within(const Tetrahedralization& tets, const StaticFilter& filter, const Slab& slab,
                             const Vec3& p, TetId hint) {
  const auto is_beyond = [&](const Vec3& a, const Vec3& b, const Vec3& c) { return filter.orient(a, b, c, p) > 0; };
  return walk(tets, hint, is_beyond, [&](TetId t) { return tets.lies_within(slab, t); });
}

TetId visibility_walk_moved(const Tetrahedralization& tets, const StaticFilter& filter, const Vec3& p,
                            const Signs& signs, TetId hint) {
  const auto is_beyond = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double side = filter.orient(a, b, c, p);
    if (side != 0) [[likely]] {
      return side > 0;
    }
    // The triangle's plane contains the point: the sign of its movement along the normal decides, first axis first.
    for (unsigned axis = 0; axis < 3; ++axis) {
      const int along = normal_sign(a, b, c, axis) * signs[axis];
      if (along != 0) return along > 0;
    }
    return false;
  };
  return walk(tets, hint, is_beyond, kAnywhere);
}

}  // namespace deliso

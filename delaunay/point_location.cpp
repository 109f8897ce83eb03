#include "delaunay/point_location.h"

namespace deliso {

namespace {

// `is_beyond(a, b, c)`: whether the point lies strictly on the side of the plane abc from which they turn
// counterclockwise.
template <class IsBeyond>
TetId walk(const Tetrahedralization& tets, TetId hint, IsBeyond is_beyond) {
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
  }
}

}  // namespace

TetId visibility_walk(const Tetrahedralization& tets, const StaticFilter& filter, const Vec3& p, TetId hint) {
  return walk(tets, hint, [&](const Vec3& a, const Vec3& b, const Vec3& c) { return filter.orient(a, b, c, p) > 0; });
}

TetId visibility_walk_moved(const Tetrahedralization& tets, const StaticFilter& filter, const Vec3& p,
                            const Signs& signs, TetId hint) {
  return walk(tets, hint, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double side = filter.orient(a, b, c, p);
    if (side != 0) [[likely]] {
      return side > 0;
    }
    // Movements along the normal decide.
    for (unsigned axis = 0; axis < 3; ++axis) {
      const int along = normal_sign(a, b, c, axis) * signs[axis];
      if (along != 0) return along > 0;
    }
    return false;
  });
}

}  // namespace deliso

#include "delaunay/point_location.h"

namespace deliso {

TetId visibility_walk(const Tetrahedralization& tets, const StaticFilter& filter, const Vec3& p, TetId hint) {
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
      if (filter.orient(tets.point(v[slots[0]]), tets.point(v[slots[1]]), tets.point(v[slots[2]]), p) > 0) {
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

}  // namespace deliso

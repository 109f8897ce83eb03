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

// Whether p, moved by an infinitesimal step, lies strictly beyond the plane abc.
struct BeyondMoved {
  const StaticFilter& filter;
  const Vec3& p;
  const Signs& signs;

  bool operator()(const Vec3& a, const Vec3& b, const Vec3& c) const {
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
  }
};

// The line from a to b, moved by an infinitesimal step.
struct MovedLine {
  const StaticFilter& filter;
  const Vec3& a;
  const Vec3& b;
  const Signs& signs;

  // Whether a facet that has the edge from c to d, counterclockwise seen from where the line goes, has the line on its
  // side of that edge. False where line and edge are parallel.
  [[nodiscard]] bool passes_inside(const Vec3& c, const Vec3& d) const {
    const double turn = filter.orient(a, b, c, d);
    if (turn != 0) [[likely]] {
      return turn > 0;
    }
    // When the line moves by m, the determinant changes by m . ((b - a) x (d - c)). A coordinate of this product is,
    // but for its sign, the orientation of the four points with other coordinates along that axis.
    for (unsigned axis = 0; axis < 3; ++axis) {
      const double along =
          -orient3d(with(a, axis, 0), with(b, axis, 0), with(c, axis, 1), with(d, axis, 1)) * signs[axis];
      if (along != 0) return along > 0;
    }
    return false;
  }

 private:
  static Vec3 with(Vec3 p, unsigned axis, double coordinate) {
    p[axis] = coordinate;
    return p;
  }
};

// The slots of the common edge of two facets of a tetrahedron, counterclockwise around the first seen from outside.
std::array<unsigned, 2> edge_between(unsigned face, unsigned other) {
  const auto& slots = kFacetSlots[face];
  const unsigned apex = slots[0] == other ? 0 : slots[1] == other ? 1 : 2;
  return {slots[(apex + 1) % 3], slots[(apex + 2) % 3]};
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
  return walk(tets, hint, BeyondMoved{filter, p, signs}, kAnywhere);
}

void append_passed_moved(const Tetrahedralization& tets, const StaticFilter& filter, const Vec3& a, const Vec3& b,
                         const Signs& signs, TetId from, std::vector<Passage>& passed) {
  const BeyondMoved is_beyond{filter, b, signs};
  const MovedLine line{filter, a, b, signs};
  TetId t = from;
  for (unsigned entered = 4; !tets.is_ghost(t);) {
    const auto& v = tets.vertices(t);
    unsigned exit = 4;
    for (unsigned face = 0; face < 4; ++face) {
      const auto& slots = kFacetSlots[face];
      if (face == entered || !is_beyond(tets.point(v[slots[0]]), tets.point(v[slots[1]]), tets.point(v[slots[2]])))
        continue;
      // Of two facets that have b beyond them, the segment leaves through the one on its side of their common edge.
      if (exit != 4) {
        const auto [c, d] = edge_between(exit, face);
        if (line.passes_inside(tets.point(v[c]), tets.point(v[d]))) continue;
      }
      exit = face;
    }
    if (exit == 4) return;
    const auto& slots = kFacetSlots[exit];
    const auto height = [&](const Vec3& p) {
      return filter.orient(tets.point(v[slots[0]]), tets.point(v[slots[1]]), tets.point(v[slots[2]]), p);
    };
    const double before = height(a);
    const double entry_share = before / (before - height(b));
    const FacetId mirror = tets.mirror(FacetId(t, exit));
    t = mirror.tet();
    entered = mirror.face();
    passed.push_back({t, entry_share});
  }
}

}  // namespace deliso

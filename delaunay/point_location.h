// Point location by a visibility walk.
#pragma once

#include <array>
#include <vector>

#include "delaunay/base/slab.h"
#include "delaunay/static_filter.h"
#include "delaunay/tetrahedralization.h"

namespace deliso {

// The tetrahedron that contains p (closed), or a ghost beyond whose hull facet p lies strictly. Walks from `hint`, a
// live tetrahedron, through any facet that has p strictly on its other side. The facets are tried in an order drawn
// from a generator seeded anew for each walk: same arguments, same walk.
//
// Terminates: with exact orientations a visibility walk never cycles in a (weighted) Delaunay triangulation
// (Edelsbrunner: An acyclicity theorem for cell complexes in d dimension, 1990; Devillers, Pion, Teillaud: Walking in a
// triangulation, 2002).
TetId visibility_walk(const Tetrahedralization& tets, const StaticFilter& filter, const Vec3& p, TetId hint);

// The same walk within a slab: `hint` is a finite tetrahedron in the slab. Returns nothing where the walk would leave
// the tetrahedra within it.
TetId visibility_walk_within(const Tetrahedralization& tets, const StaticFilter& filter, const Slab& slab,
                             const Vec3& p, TetId hint);

// Which way a point is moved along each axis: 1 or -1.
using Signs = std::array<int, 3>;

// The same for p + (e sx, e^2 sy, e^3 sz) with an infinitesimal e. Such a point never lies on a facet, so the
// tetrahedron that contains it is the same from every hint. (Beyond the hull several ghosts may see the point.)
TetId visibility_walk_moved(const Tetrahedralization& tets, const StaticFilter& filter, const Vec3& p,
                            const Signs& signs, TetId hint);

// A tetrahedron that a segment enters at a share of its length (rounded; 0 and 1 are its ends).
struct Passage {
  TetId tet;
  double entry = 0;
};

// Appends the tetrahedra that the segment from a to b enters one after the other, when both ends are moved by `signs`
// as above; the first one, `from`, is left out. The last one contains b moved, or is a ghost, where the segment leaves
// the hull. `from` is finite and contains a moved by `signs`, or by signs that differ along the segment alone.
void append_passed_moved(const Tetrahedralization& tets, const StaticFilter& filter, const Vec3& a, const Vec3& b,
                         const Signs& signs, TetId from, std::vector<Passage>& passed);

}  // namespace deliso

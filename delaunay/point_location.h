// Point location by a visibility walk.
#pragma once

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

}  // namespace deliso

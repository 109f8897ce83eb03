// Where the field is known to keep to one side of the isovalue, and which tetrahedra that concerns.
//
// Between two samples on the same side a grid edge keeps to that side, for the interpolant is linear there. From a
// saddle of a cell face the interpolant is monotone along the segments to the corners of the face, so those to the
// corners on the saddle's own side keep to it. These segments tell what is joined to what within a cell: a
// tetrahedron that one of them crosses must have its sign, or the mesh cuts apart what belongs together. All vertices
// lie on the isosurface, so a tetrahedron that segments of both sides cross is too large for the surface around it.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/raised_cells.h"
#include "surface/signed_delaunay.h"

namespace deliso {

// Of each tetrahedron (by slot): which sides segments of the raised cells that cross it lie on.
enum Evidence : std::uint8_t { kNoEvidence = 0, kAbove = 1, kBelow = 2, kConflict = 3 };

// The same for any number of threads.
std::vector<std::uint8_t> evidence_in(const SignedDelaunay& restricted, const ScalarGrid& grid,
                                      const RaisedCells& raised, int threads = 1);

}  // namespace deliso

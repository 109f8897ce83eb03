// The change of the mesh's Euler characteristic when the sign of a tetrahedron is flipped, computed without building
// the mesh.
#pragma once

#include <cstdint>

#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// The change of the Euler characteristic of the mesh (build_triangle_mesh.h), all its pieces together, when the sign of
// this tetrahedron is flipped. `restricted` is unchanged afterwards.
std::int64_t euler_change(SignedDelaunay& restricted, TetId t);

}  // namespace deliso

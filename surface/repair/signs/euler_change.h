// How the Euler characteristic of the mesh changes with the sign of a tetrahedron, without building the mesh.
#pragma once

#include <cstdint>

#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// By how much the Euler characteristic of the mesh (build_triangle_mesh.h), all its pieces together, changes when the
// sign of this tetrahedron is turned over. `restricted` is the same afterwards as before.
std::int64_t euler_change(SignedDelaunay& restricted, TetId t);

}  // namespace deliso

// How the Euler characteristic of the mesh changes with the signs of a few tetrahedra, without building the mesh.
#pragma once

#include <cstdint>
#include <span>

#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// By how much the Euler characteristic of the mesh (build_triangle_mesh.h), all its pieces together, changes when the
// signs of these tetrahedra are turned over. `restricted` is the same afterwards as before.
std::int64_t euler_change(SignedDelaunay& restricted, std::span<const TetId> tets);

}  // namespace deliso

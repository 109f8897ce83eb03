// Signs without foundation: small pockets of tetrahedra that the exact topology rules out.
#pragma once

#include <cstdint>

#include "surface/signed_delaunay.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The trilinear interpolant has its local extrema at samples only; so every connected region above the isovalue holds a
// sample above it, and every region below holds one below. A small face-connected set of tetrahedra of one sign that
// holds no sample of that sign is therefore an artefact, and its sign is turned over. Returns how many sets were. Sets
// with ghosts or more than a hundred tetrahedra are left alone.
std::int64_t overturn_unfounded_signs(SignedDelaunay& restricted, const ScalarGrid& grid);

}  // namespace deliso

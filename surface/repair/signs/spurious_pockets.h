// Spurious pockets: small sets of tetrahedra whose sign the exact topology rules out.
#pragma once

#include <cstddef>
#include <vector>

#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// The local extrema of the trilinear interpolant are samples. So every connected region above the isovalue contains a
// sample above it, and every region below contains one below. A small face-connected set of tetrahedra of one sign
// without a sample of that sign is therefore an artefact. Sets with ghosts or with more than a hundred tetrahedra are
// not examined. They are found anew each time, which takes a few thousandths of a run. The same for any number of
// threads.
std::vector<std::vector<TetId>> spurious_pockets(const SignedDelaunay& restricted, int threads = 1);

// Flips the signs in them. Returns how many there were.
std::size_t flip_spurious_pockets(SignedDelaunay& restricted, int threads = 1);

}  // namespace deliso

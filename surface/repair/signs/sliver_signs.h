// Signs of slivers, tetrahedra that are flat but for rounding: they must not fold the surface back on itself.
#pragma once

#include <vector>

#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// If the isosurface is plane, as that of a mask is, samples lie in one plane and often on one circle, except for the
// last bits of their coordinates. Then a tetrahedron of four such samples has almost no height. Rounding alone decides
// where its circumcenter and centroid lie, and so its sign. With wrong signs the restricted facets pass through a layer
// of such tetrahedra three times instead of once: a fold by half a turn, whose triangles cross as soon as their corners
// are rounded again. So the flat tetrahedra take those signs for which the restricted facets have the least area. Among
// signs of equal area they keep their own. They are found anew each time, which takes a few thousandths of a run.
void settle_slivers(SignedDelaunay& restricted, int threads = 1);

// The flat tetrahedra, ascending. The same for any number of threads.
std::vector<TetId> slivers(const SignedDelaunay& restricted, int threads = 1);

}  // namespace deliso

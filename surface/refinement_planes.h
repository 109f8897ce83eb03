// Where stage 2 cuts the mesh into slabs that are refined apart from each other (refinement_slabs.h).
//
// Into slabs of about the same work, by planes that meet few coarse triangles: these have to wait. The cut depends on
// the mesh alone, so the result does not depend on how many threads refine the slabs.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "delaunay/base/slab.h"
#include "surface/refinement_mesh.h"

namespace deliso {

// At most 8 slabs next to each other of `slab_triangles` or more, about; a small mesh is one. `work` estimates the
// insertions that each triangle needs. The same for any number of threads.
std::vector<Slab> slabs_of_equal_work(const RefinementMesh& mesh, std::span<const float> work,
                                      std::size_t slab_triangles, int threads = 1);

}  // namespace deliso

// Where stage 2 cuts the mesh into slabs that are refined independently (refinement_slabs.h).
//
// The slabs have about the same work, and their planes meet few coarse triangles. Triangles that meet a plane would
// have to wait for all slabs; so they are refined first, within seams around the planes, while the mesh is small. The
// cuts depend on the mesh alone, so the result does not depend on the number of threads.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "delaunay/base/slab.h"
#include "surface/refine/disk/refinement_mesh.h"

namespace deliso {

// At most 10 adjacent slabs of about `slab_triangles` each. Their number is even, for which a small mesh is cut finer;
// a very small mesh is one slab. `work` estimates the insertions that each triangle needs. The same for any number of
// threads.
std::vector<Slab> slabs_of_equal_work(const RefinementMesh& mesh, std::span<const float> work,
                                      std::size_t slab_triangles, int threads = 1);

// A seam around the plane between each two slabs, in order. A seam spans the coarse triangles that meet the plane and a
// margin, but at most the range between the middles of the two slabs.
std::vector<Slab> seams_between(const std::vector<Slab>& slabs, const RefinementMesh& mesh, int threads = 1);

// Sorts adjacent slabs by the work that coarse triangles in them still need, the most first: so the threads that share
// them finish at about the same time.
std::vector<Slab> most_work_first(std::vector<Slab> slabs, const RefinementMesh& mesh, std::span<const float> work);

}  // namespace deliso

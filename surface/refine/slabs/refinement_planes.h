// Where stage 2 cuts the mesh into slabs that are refined apart from each other (refinement_slabs.h).
//
// Into slabs of about the same work, by planes that meet few coarse triangles. These would have to wait for all slabs;
// so they are refined first, within seams around the planes, while the mesh is small. The cuts depend on the mesh
// alone, so the result does not depend on how many threads refine the parts.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "delaunay/base/slab.h"
#include "surface/refine/disk/refinement_mesh.h"

namespace deliso {

// At most 10 slabs next to each other of about `slab_triangles`, and an even number of them, for which a small mesh is
// cut finer; a very small one is one slab. `work` estimates the insertions that each triangle needs. The same for any
// number of threads.
std::vector<Slab> slabs_of_equal_work(const RefinementMesh& mesh, std::span<const float> work,
                                      std::size_t slab_triangles, int threads = 1);

// Around the plane between each two slabs, in order: where the coarse triangles that meet it lie and a margin, but no
// farther than the middles of the two.
std::vector<Slab> seams_between(const std::vector<Slab>& slabs, const RefinementMesh& mesh, int threads = 1);

// Slabs next to each other, in order, by the work that coarse triangles in them still need, the most first: so threads
// that share them come to an end at about the same time.
std::vector<Slab> most_work_first(std::vector<Slab> slabs, const RefinementMesh& mesh, std::span<const float> work);

}  // namespace deliso

// Repair: resample the surface where its mesh differs from the exact topology, and only there, until nothing differs.
//
// Rounds of: flag the voxel cells near the trouble of the components that are not right yet (defect_cells.h); raise
// each flagged cell one level of the sample lattice and exchange samples in the triangulation (its free samples go,
// lattice samples come); take signs as they were before or by one rule after another and match the pieces of each mesh
// with the exact components; where a few handles are wrong, find the places (euler_boxes.h, and from the third round on
// angle_defect_grid.h) and turn over single disputed signs (sign_search.h). A component is done when its main piece has
// its topology, holds no vertex of another component and lies near all of it. At the end each component is taken from
// the latest mesh that has it at its best; one that no mesh has right is meshed by marching cubes, whose topology is
// exact, and reported. Vertices of other components (foreign_vertices.h) and dents (inverted_umbrellas.h) are removed
// from what that makes; when the former are all that is wrong, that is the end. Where dents that have to stay leave
// parts of the surface out (missed_crossings.h), the rounds go on, with samples around these. Components whose
// triangles cross others are meshed by marching cubes, too, until none do (marching_cubes_fallback.h).
#pragma once

#include <cstdint>
#include <memory>

#include "surface/base/controls.h"
#include "surface/base/stage_stats.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// `restricted` is what stage 1 left. Returns the mesh that stage 2 starts from, with pole heights; the same for any
// number of threads.
SurfaceMesh repair(const ExactSurfaceCache& facts, std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds,
                   int threads, Controls& controls, RepairStats& stats);

}  // namespace deliso

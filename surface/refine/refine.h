// RefineGeom, stage 2 (Dey and Levine, sections 2.2.2 and 3.2, Figure 9): refine the surface mesh without tetrahedra.
//
// A triangle that fails a criterion (surface/base/criteria.h) gives p = x_sigma. The triangles whose surface Delaunay
// balls hold p form a disk E; it is replaced by the star of p. Every replacement is checked first (one boundary cycle,
// no vertex lost, no triangle turned against the gradient, no triangle that crosses another), so the mesh stays
// homeomorphic to what stage 1 gave, whatever the data.
#pragma once

#include <vector>

#include "raycast/isosurface.h"
#include "surface/base/controls.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/refine/disk/refinement_mesh.h"
#include "surface/refine/refine_options.h"

namespace deliso {

// Counters are those of what stayed, but searches count whatever was done. When `balls` is given, it gets B_sigma of
// each triangle. After an exception the mesh is empty.
void refine_geometry(SurfaceMesh& mesh, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
                     RefineStats& stats, std::vector<SurfaceDelaunayBall>* balls = nullptr);

}  // namespace deliso

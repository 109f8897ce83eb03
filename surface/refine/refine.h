// RefineGeom, stage 2 (Dey and Levine, sections 2.2.2 and 3.2, Figure 9): refine the surface mesh without tetrahedra.
//
// A triangle that fails a criterion gives p = x_sigma. The triangles whose surface Delaunay balls hold p form a disk E,
// which is replaced by the star of p. Every replacement is checked first (one boundary cycle, no vertex lost, no
// triangle turned against the gradient, no triangle that crosses another). So the mesh stays homeomorphic to that of
// stage 1, whatever the data.
#pragma once

#include <vector>

#include "raycast/isosurface.h"
#include "surface/base/controls.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/refine/disk/refinement_mesh.h"
#include "surface/refine/refine_options.h"

namespace deliso {

// The counters describe the final result, but searches count all work done. If `balls` is given, it receives B_sigma of
// each triangle. After an exception the mesh is empty.
void refine_geometry(SurfaceMesh& mesh, const Isosurface& isosurface, const RefineOptions& options, Controls& controls,
                     RefineStats& stats, std::vector<SurfaceDelaunayBall>* balls = nullptr);

}  // namespace deliso

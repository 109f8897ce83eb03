// Decimation: fewer vertices, within what a proven mesh promises (ours). Neither stage 1 nor stage 2 ever removes a
// vertex; where a size is asked for in vertices or as an error, that is more than is needed.
#pragma once

#include "surface/base/controls.h"
#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/sizes/decimation_options.h"

namespace deliso {

// Removes vertices of a manifold mesh in mesh space, those first that cost the least error, until options.enough are
// left or no more can go. Topology, embedding, the boundary's faces and the places of the vertices that stay are kept;
// only points and triangles are. The same for any number of threads.
void decimate(SurfaceMesh& mesh, const ExactSurface& surface, const DecimationOptions& options, Controls& controls,
              DecimationStats& stats);

}  // namespace deliso

// Edges that are longer than allowed, at which stage 2 can insert nothing.
#pragma once

#include "surface/base/controls.h"
#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/shape/shape_options.h"

namespace deliso {

// Splits edges of a mesh in mesh space that are longer than options.max_edge, the longest first, by the steps of the
// shape stage and within its guard. Only points and triangles are kept. The same for any number of threads.
void split_long_edges(SurfaceMesh& mesh, const ExactSurface& surface, const ShapeOptions& options,
                      const Controls& controls, ShapeStats& stats);

}  // namespace deliso

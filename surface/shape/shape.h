// Shape: the stage after RefineGeom, which improves badly shaped triangles (ours; the steps are those of mesh
// improvement, e.g. Freitag and Ollivier-Gooch, 1997).
//
// RefineGeom leaves triangles with small angles where an insertion is refused and at or below r_min: at creases of the
// isosurface, in necks and thin walls. Each is improved by steps that replace a disk of triangles by another.
#pragma once

#include <cstdint>
#include <span>

#include "surface/base/controls.h"
#include "surface/base/exact_surface.h"
#include "surface/mesh/known_triangles.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/shape/shape_options.h"

namespace deliso {

// Improves the triangles of a mesh in mesh space with angles below options.min_angle. Only points and triangles are
// used and kept. The same for any number of threads. `left`: those left by earlier calls, which are tried no more; with
// all rounds what this one leaves is added.
void improve_shape(SurfaceMesh& mesh, const ExactSurface& surface, const ShapeOptions& options, Controls& controls,
                   ShapeStats& stats, KnownTriangles& left);

// Counts the triangles of a mesh that are badly shaped and finds the worst of them: stats.bad_after and worst.
void count_bad_triangles(const SurfaceMesh& mesh, const ShapeOptions& options, int threads, ShapeStats& stats);

// Replaces triangles that cross others, as where pinches come side by side and copies of their vertices do not come
// apart, or that have parts farther from the isosurface than options.max_sample. These count as the worst of all; what
// is badly shaped around them is improved, too.
void replace_wrong_triangles(SurfaceMesh& mesh, std::span<const std::uint32_t> wrong, const ExactSurface& surface,
                             const ShapeOptions& options, Controls& controls, ShapeStats& stats);

}  // namespace deliso

// What is known of each vertex and triangle of a mesh, for formats that hold such values.
#pragma once

#include "surface/base/parameters.h"
#include "surface/deliso.h"
#include "surface/mesh/mesh_attributes.h"
#include "surface/mesh/triangle_mesh.h"
#include "volume/affine.h"
#include "volume/scalar_grid.h"

namespace deliso {

// Of vertices:
//   component  from 1 on, as in the report
//   stage      1: as stage 1 (Recover, with repair) has left it, 2: inserted or moved later. Left out without
//   stage1_mesh h          the largest h of the triangles at the vertex gradient   of the trilinear interpolant, in
//   coordinates of the mesh's file: it points to higher values
// Of triangles:
//   h          from the circumcenter along the normal to the isosurface, in voxels (the paper's h); -1 where there is
//   none quality    4 sqrt(3) area / (sum of the squared edges): 1 of an equilateral triangle, 0 of a flat one
//   min_angle  in degrees
// `grid`, `isovalue` and `from_grid` are those of the run; the mesh is in the grid's own coordinates.
MeshAttributes mesh_fields(const MeshingResult& result, const ScalarGrid& grid, double isovalue,
                           const Parameters& parameters, const Affine& from_grid, int threads);

}  // namespace deliso

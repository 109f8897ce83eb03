// Components from marching cubes, in parts of cells where whole ones would leave triangles too far from the isosurface.
// Marching cubes of noise and masks has such triangles in a fifth of its cells, on both sides of thin walls, and most
// of what stage 2 would insert there is refused: what is nearer on one side of the wall would cross the other one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/certificate/exact_polygonization.h"

namespace deliso {

// How near marching cubes has to be. All in mesh-space units.
struct CubeNearness {
  double max_distance = 1;             // of triangles from the isosurface, and of it from them
  std::span<const Vec3> samples = {};  // their cells are divided anyway
  std::int32_t parts = 2;              // of a divided cell, along each axis
};

// The meshes of these components (exact_polygonization), with the cells divided (graded_cubes.h) that have triangles
// too far from the isosurface or parts of it too far from all triangles, and those in which triangles would cross then.
// Few are farther away than wanted in the end, which is not promised. The same for any number of threads.
ExactPolygonization nearer_cubes(const std::vector<bool>& components, const ExactSurface& surface,
                                 const CubeNearness& wanted);

}  // namespace deliso

// The surface Delaunay balls of a mesh: the restricted Delaunay property, checked triangle by triangle.
#pragma once

#include <cstdint>

#include "surface/mesh/triangle_mesh.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The ball of a triangle passes through its corners and is centred where its dual line (through the circumcenter,
// along the normal) falls through the isosurface nearest to the triangle. In a restricted Delaunay triangulation no
// ball has a vertex strictly inside (Boissonnat and Oudot 2005).
struct DelaunayBallCheck {
  bool pass = false;             // every triangle has a ball and every ball is empty
  std::int64_t occupied = 0;     // balls with another vertex inside, by more than 1e-9 of their radius
  std::int64_t without_hit = 0;  // triangles without a ball: the dual line misses the isosurface
};

// The mesh in voxel space: units of the smallest spacing, first sample at the origin. Precondition: no sample equals
// `isovalue`.
DelaunayBallCheck check_delaunay_balls(const TriangleMesh& mesh, const ScalarGrid& grid, double isovalue);

}  // namespace deliso

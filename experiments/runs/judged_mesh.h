// A mesh judged as an image of an isosurface, as `deliso verify` does it: what the records of all meshers hold alike.
#pragma once

#include "experiments/config/json.h"
#include "surface/mesh/triangle_mesh.h"
#include "surface/verification/surface_distance.h"
#include "surface/verification/verification.h"
#include "volume/scalar_grid.h"

namespace deliso {

struct JudgedMesh {
  Verification check;
  // The distances to the mesh from points of the isosurface inside cells, in voxels. The verification uses grid-edge
  // crossings instead, which are the vertices of marching cubes.
  DistanceFigure samples;
  std::int64_t components_expected = 0;  // of the isosurface
  std::int64_t components_missed = 0;    // of these, those on which no vertex of the mesh lies
};

// Precondition: finite coordinates. Throws InputError when a triangle names a vertex out of range.
JudgedMesh judge_mesh(const TriangleMesh& mesh, const ScalarGrid& grid, double isovalue);

// The keys "distances" and "verification" of a record.
Json distances_json(const JudgedMesh& judged);
Json verification_json(const JudgedMesh& judged);

}  // namespace deliso

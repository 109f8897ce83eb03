// Shape of a triangle mesh.
#pragma once

#include "surface/triangle_mesh.h"

namespace deliso {

struct MeshQuality {
  double min_angle_degrees = 0;
  double mean_min_angle_degrees = 0;  // mean over triangles of their smallest angle
  double max_angle_degrees = 0;
  double radius_edge_max = 0;  // circumradius over shortest edge
  double radius_edge_p99 = 0;
  double fraction_min_angle_below_30 = 0;
};

MeshQuality measure_quality(const TriangleMesh& mesh);

}  // namespace deliso

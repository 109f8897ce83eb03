// Shape of a triangle mesh.
#pragma once

#include <array>
#include <cstdint>

#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// The radius-edge ratio reported for a degenerate triangle instead of infinity. It is finite, so that JSON can hold it,
// and larger than that of any triangle that doubles can distinguish from a degenerate one.
inline constexpr double kDegenerateRadiusEdge = 1e18;

// Degenerate triangles are counted, too: smallest angle 0, largest angle 180 degrees (90 when corners coincide, the
// limit of isosceles triangles), ratio kDegenerateRadiusEdge. An empty mesh has zeros everywhere.
struct MeshQuality {
  double min_angle_degrees = 0;
  double mean_min_angle_degrees = 0;  // mean over triangles of their smallest angle
  double max_angle_degrees = 0;
  double radius_edge_max = 0;  // circumradius over shortest edge
  double radius_edge_p99 = 0;
  double fraction_min_angle_below_30 = 0;
  std::int64_t degenerate_triangles = 0;  // no area to within rounding
  // Triangles by their smallest angle, in bins of 5 degrees: [0, 5), ..., [55, 60].
  std::array<std::int64_t, 12> min_angle_histogram{};
};

// The same for any number of threads.
MeshQuality measure_quality(const TriangleMesh& mesh, int threads = 1);

}  // namespace deliso

// The distance of a point from a mesh, by asking all of its triangles.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "surface/mesh/surface_mesh.h"
#include "surface/mesh/triangle_distance.h"

namespace deliso::testing {

inline double distance_to(const Vec3& p, const SurfaceMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles) {
    least = std::min(least, squared_distance_to_triangle(p, mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  return std::sqrt(least);
}

}  // namespace deliso::testing

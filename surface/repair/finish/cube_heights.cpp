#include "surface/repair/finish/cube_heights.h"

#include <algorithm>
#include <span>
#include <vector>

#include "delaunay/base/check.h"
#include "surface/restricted/poles.h"

namespace deliso {

void raise_pole_heights(SurfaceMesh& mesh, std::size_t first, const ExactSurface& surface) {
  const std::span<const Vec3> points = std::span(mesh.points).subspan(first);
  std::vector<VertexId> vertex_of;
  try {
    const SignedDelaunay triangulation(surface.isosurface, points, surface.threads, &vertex_of);
    const std::vector<bool> all(triangulation.delaunay().vertex_count(), true);
    const std::vector<double> heights = compute_poles(triangulation, all, PoleHeight::kNearer, surface.threads);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (vertex_of[i].is_none()) continue;
      double& height = mesh.pole_heights[first + i];
      height = std::max(height, heights[vertex_of[i].index()]);
    }
  } catch (const InputError&) {
    // All points on one line: crossings nearer to each other than numbers tell apart.
  }
}

}  // namespace deliso

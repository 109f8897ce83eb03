#include "surface/surface_mesh.h"

namespace deliso {

TriangleMesh to_world(const SurfaceMesh& mesh, const ScalarGrid& grid, const Vec3& step) {
  const Vec3 scale{grid.spacing().x / step.x, grid.spacing().y / step.y, grid.spacing().z / step.z};
  TriangleMesh world;
  world.points.reserve(mesh.points.size());
  for (const Vec3& p : mesh.points) world.points.push_back(grid.origin() + scaled(scale, p));
  world.triangles = mesh.triangles;
  return world;
}

}  // namespace deliso

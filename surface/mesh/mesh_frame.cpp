#include "surface/mesh/mesh_frame.h"

#include <utility>

namespace deliso {

TriangleMesh transformed(TriangleMesh mesh, const Affine& map) {
  if (map == Affine()) return mesh;
  for (Vec3& p : mesh.points) p = map(p);
  if (map.determinant() >= 0) return mesh;
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  return mesh;
}

}  // namespace deliso

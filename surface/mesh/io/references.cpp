// The reference numbers that Medit, Gmsh and TetGen give to triangles.

#include "surface/mesh/io/formats.h"
#include "surface/mesh/mesh_topology.h"

namespace deliso {

std::vector<std::int64_t> triangle_references(const TriangleMesh& mesh, const MeshAttributes& attributes) {
  std::vector<std::int64_t> references;
  references.reserve(mesh.triangles.size());
  for (const MeshAttribute& attribute : attributes.triangles) {
    if (attribute.name != "label" || attribute.width != 1) continue;
    for (const double value : attribute.values) references.push_back(static_cast<std::int64_t>(value));
    return references;
  }
  const MeshTopology topology = mesh_topology(mesh);
  for (const auto& triangle : mesh.triangles)
    references.push_back(std::int64_t{topology.component_of_vertex[triangle[0]]} + 1);
  return references;
}

}  // namespace deliso

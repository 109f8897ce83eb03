#include "surface/refinement_mesh.h"

namespace deliso {

RefinementMesh::RefinementMesh(const SurfaceMesh& mesh)
    : vertices(mesh.points.size()), triangles(mesh.triangles.size()) {
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    vertices[v].point = mesh.points[v];
    vertices[v].pole_height = mesh.pole_heights[v];
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    triangles[t].corners = mesh.triangles[t];
    triangles[t].neighbours = mesh.neighbours[t];
  }
}

void RefinementMesh::forget_attempts() {
  for (Vertex& v : vertices) v.attempt = 0;
  for (Triangle& t : triangles) {
    t.state &= Triangle::kFlags;
    t.attempt = 0;
  }
}

// What is not needed any more goes at once: the peak of a whole run may lie here.
void RefinementMesh::move_to(SurfaceMesh& mesh) {
  mesh = {};
  mesh.points.reserve(vertices.size());
  mesh.pole_heights.reserve(vertices.size());
  for (const Vertex& v : vertices) {
    mesh.points.push_back(v.point);
    mesh.pole_heights.push_back(v.pole_height);
  }
  LargeArray<Vertex>().swap(vertices);
  mesh.triangles.reserve(triangles.size());
  mesh.neighbours.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    mesh.triangles.push_back(t.corners);
    mesh.neighbours.push_back(t.neighbours);
  }
  LargeArray<Triangle>().swap(triangles);
}

}  // namespace deliso

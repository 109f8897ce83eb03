#include "surface/refinement_mesh.h"

#include "delaunay/base/parallel.h"

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
void RefinementMesh::move_to(SurfaceMesh& mesh, int threads, bool keep_neighbours) {
  const auto copy = [](const auto& from, auto& to, auto member) {
    to.reserve(from.size());
    for (const auto& element : from) to.push_back(element.*member);
  };
  mesh = {};
  const std::size_t arrays = keep_neighbours ? 2 : 1;
  run_tasks(arrays, threads, [&](std::size_t task) {
    task == 0 ? copy(vertices, mesh.points, &Vertex::point) : copy(vertices, mesh.pole_heights, &Vertex::pole_height);
  });
  LargeArray<Vertex>().swap(vertices);
  run_tasks(arrays, threads, [&](std::size_t task) {
    task == 0 ? copy(triangles, mesh.triangles, &Triangle::corners)
              : copy(triangles, mesh.neighbours, &Triangle::neighbours);
  });
  LargeArray<Triangle>().swap(triangles);
}

}  // namespace deliso

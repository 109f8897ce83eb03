#include "surface/refine/disk/refinement_mesh.h"

#include "delaunay/base/parallel.h"
#include "surface/base/parallel_blocks.h"

namespace deliso {

RefinementMesh::RefinementMesh(const SurfaceMesh& mesh, int threads) {
  run_tasks(2, threads, [&](std::size_t task) {
    if (task == 0) {
      triangles.resize(mesh.triangles.size());
      for (std::size_t t = 0; t < triangles.size(); ++t) {
        triangles[t].corners = mesh.triangles[t];
        triangles[t].neighbours = mesh.neighbours[t];
      }
    } else {
      vertices.resize(mesh.points.size());
      for (std::size_t v = 0; v < vertices.size(); ++v) {
        vertices[v].point = mesh.points[v];
        vertices[v].pole_height = mesh.pole_heights[v];
      }
    }
  });
}

void RefinementMesh::forget_attempts(int threads) {
  for (Vertex& v : vertices) v.attempt = 0;
  for_each_block(triangles.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      triangles[t].state &= Triangle::kFlags;
      triangles[t].attempt = 0;
    }
  });
}

// Arrays that are not needed any more are freed at once: the peak memory of a whole run may be here.
void RefinementMesh::move_to(SurfaceMesh& mesh, int threads, bool keep_neighbours) {
  const auto copy = [](const auto& from, auto& to, auto member) {
    to.reserve(from.size());
    for (const auto& element : from) to.push_back(element.*member);
  };
  mesh = {};
  run_tasks(2, threads, [&](std::size_t task) {
    if (task == 0) {
      copy(triangles, mesh.triangles, &Triangle::corners);
      if (keep_neighbours) copy(triangles, mesh.neighbours, &Triangle::neighbours);
      LargeArray<Triangle>().swap(triangles);
    } else {
      copy(vertices, mesh.points, &Vertex::point);
      if (keep_neighbours) copy(vertices, mesh.pole_heights, &Vertex::pole_height);
      LargeArray<Vertex>().swap(vertices);
    }
  });
}

}  // namespace deliso

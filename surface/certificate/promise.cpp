#include "surface/certificate/promise.h"

#include "delaunay/base/counted.h"
#include "delaunay/base/shortest_text.h"

namespace deliso {

std::vector<std::string> broken_promises(const PromiseFigures& figures, const Promise& promise) {
  std::vector<std::string> broken;
  const auto add = [&](std::int64_t count, const char* one, const char* many, const std::string& rest) {
    if (count > 0) broken.push_back(counted(count, one, many) + rest);
  };
  if (figures.triangles == 0) broken.emplace_back("the mesh has no triangle");
  if (figures.triangles > 0 && !figures.is_manifold) {
    broken.push_back("the mesh is not manifold" +
                     (figures.manifold_faults.empty() ? "" : ": " + figures.manifold_faults));
  }
  add(figures.misoriented_edges, "edge has triangles", "edges have triangles", " that disagree in orientation");
  add(figures.reversed_components, "component faces", "components face", " higher values");
  add(figures.off_box_edges, "boundary edge lies", "boundary edges lie", " off the faces of the box");
  if (figures.topology == Verdict::kDifferent) {
    broken.emplace_back("the topology differs from that of the isosurface");
  } else if (figures.topology != Verdict::kHomeomorphic) {
    broken.emplace_back("the isosurface is singular at this isovalue");
  }
  add(figures.crossing_pairs, "pair of triangles crosses", "pairs of triangles cross", "");
  add(figures.touching_pairs, "pair of triangles touches", "pairs of triangles touch", " beyond what they share");
  add(figures.zero_area_triangles, "triangle has", "triangles have", " no area");
  const auto add_distance = [&](std::int64_t count, const char* one, const char* many, double most, const char* off,
                                const std::optional<double>& worst) {
    add(count, one, many,
        " more than " + shortest_text(most) + " voxel off the " + off +
            (worst ? ", the worst " + std::to_string(*worst) : ""));
  };
  add_distance(figures.vertices_off, "vertex is", "vertices are", promise.max_residual, "isosurface",
               figures.worst_vertex);
  add_distance(figures.mesh_off, "place of the mesh is", "places of the mesh are", promise.max_distance, "isosurface",
               figures.worst_mesh);
  add_distance(figures.isosurface_off, "place of the isosurface is", "places of the isosurface are",
               promise.max_distance, "mesh", figures.worst_isosurface);
  return broken;
}

std::string unchecked_when_stopped() {
  return "the run was stopped before it was checked which way triangles face, whether they cross, and how far mesh and "
         "isosurface are from each other";
}

}  // namespace deliso

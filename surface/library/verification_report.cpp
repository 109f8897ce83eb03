#include "surface/library/verification_report.h"

#include <array>
#include <vector>

#include "surface/library/run_report.h"

namespace deliso {
namespace {

JsonTree distance_json(const DistanceFigure& figure) {
  return JsonTree{{"max_voxels", figure.max_voxels}, {"mean_voxels", figure.mean_voxels}, {"worst", figure.worst}};
}

// Pairs of triangles by their numbers in the mesh, and where they meet.
JsonTree pairs_json(const std::vector<TrianglePair>& pairs) {
  JsonTree list = JsonTree::array();
  for (const TrianglePair& pair : pairs) {
    list.push_back(JsonTree{{"triangles", std::array{pair.first, pair.second}}, {"position", pair.position}});
  }
  return list;
}

JsonTree manifold_json(const ManifoldCheck& check) {
  return JsonTree{{"pass", check.pass},
                  {"non_manifold_edges", check.non_manifold_edges},
                  {"non_manifold_vertices", check.non_manifold_vertices},
                  {"repeated_vertices", check.repeated_vertices},
                  {"duplicate_triangles", check.duplicate_triangles},
                  {"zero_area_triangles", check.zero_area_triangles},
                  {"unreferenced_vertices", check.unreferenced_vertices},
                  {"components", check.components},
                  {"euler_characteristic", check.euler_characteristic},
                  {"boundary_loops", check.boundary_loops}};
}

}  // namespace

JsonTree checks_tree(const Verification& v) {
  JsonTree topology = certificate_tree(v.topology);
  topology["pass"] = v.topology.verdict == Verdict::kHomeomorphic;
  return JsonTree{{"manifold", manifold_json(v.manifold)},
                  {"orientation", JsonTree{{"pass", v.orientation.pass},
                                           {"misoriented_edges", v.orientation.misoriented_edges},
                                           {"reversed_components", v.orientation.reversed_components},
                                           {"reversed_at", v.orientation.reversed_at}}},
                  {"boundary", JsonTree{{"pass", v.boundary.pass},
                                        {"boundary_edges", v.boundary.boundary_edges},
                                        {"off_box_edges", v.boundary.off_box_edges},
                                        {"outside_vertices", v.boundary.outside_vertices}}},
                  {"topology", topology},
                  {"self_intersection", JsonTree{{"pass", v.self_intersection.pass},
                                                 {"crossing_pairs", v.self_intersection.found.crossing_pairs},
                                                 {"touching_pairs", v.self_intersection.found.touching_pairs},
                                                 {"first_crossing", pairs_json(v.self_intersection.found.crossing)},
                                                 {"first_touching", pairs_json(v.self_intersection.found.touching)}}},
                  {"residual", JsonTree{{"pass", v.residual.pass}, {"distance", distance_json(v.residual.distance)}}},
                  {"distance", JsonTree{{"pass", v.distance.pass},
                                        {"mesh_to_isosurface", distance_json(v.distance.mesh_to_isosurface)},
                                        {"isosurface_to_mesh", distance_json(v.distance.isosurface_to_mesh)}}},
                  {"normals", JsonTree{{"pass", v.normals.pass},
                                       {"against", v.normals.against},
                                       {"fraction_against", v.normals.fraction_against},
                                       {"min_cosine", v.normals.min_cosine},
                                       {"mean_cosine", v.normals.mean_cosine}}},
                  {"delaunay_balls", JsonTree{{"pass", v.delaunay_balls.pass},
                                              {"occupied", v.delaunay_balls.occupied},
                                              {"without_hit", v.delaunay_balls.without_hit}}}};
}

void move_places(Verification& v, const Affine& map) {
  for (Vec3& p : v.orientation.reversed_at) p = map(p);
  for (DistanceFigure* figure : {&v.residual.distance, &v.distance.mesh_to_isosurface, &v.distance.isosurface_to_mesh})
    figure->worst = map(figure->worst);
}

}  // namespace deliso

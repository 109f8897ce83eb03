#include "experiments/runs/judged_mesh.h"

#include <algorithm>
#include <vector>

#include "experiments/runs/isosurface_samples.h"
#include "surface/certificate/component_assignment.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

// The vertices that a triangle names, as indices of samples.
std::vector<Vec3> used_points(const TriangleMesh& mesh, const ScalarGrid& grid) {
  std::vector<char> is_used(mesh.points.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    for (const auto vertex : triangle) is_used[static_cast<std::size_t>(vertex)] = 1;
  }
  const Vec3& s = grid.spacing();
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (is_used[i] != 0) points.push_back(scaled(mesh.points[i] - grid.origin(), {1 / s.x, 1 / s.y, 1 / s.z}));
  }
  return points;
}

void count_components(const TriangleMesh& mesh, const ScalarGrid& grid, double isovalue, JudgedMesh& judged) {
  const IsosurfaceTopology topology = exact_topology(grid, isovalue);
  std::vector<char> is_met(topology.components.size(), 0);
  for (const std::uint32_t component : components_of(used_points(mesh, grid), grid, isovalue, topology)) {
    if (component < is_met.size()) is_met[component] = 1;
  }
  judged.components_expected = static_cast<std::int64_t>(is_met.size());
  judged.components_missed = std::count(is_met.begin(), is_met.end(), 0);
}

}  // namespace

JudgedMesh judge_mesh(const TriangleMesh& mesh, const ScalarGrid& grid, double isovalue) {
  JudgedMesh judged;
  judged.check = verify_mesh(mesh, grid, isovalue);
  const double used = judged.check.isovalue_used;
  count_components(mesh, grid, used, judged);
  judged.samples = points_to_mesh(isosurface_samples(grid, used), mesh, norm(grid.box().high - grid.box().low));
  const Vec3& step = grid.spacing();
  const double voxel = std::min({step.x, step.y, step.z});
  judged.samples.max_voxels /= voxel;
  judged.samples.mean_voxels /= voxel;
  return judged;
}

Json distances_json(const JudgedMesh& judged) {
  const Verification& check = judged.check;
  return Json{{"mesh_to_isosurface_max_voxels", check.distance.mesh_to_isosurface.max_voxels},
              {"mesh_to_isosurface_mean_voxels", check.distance.mesh_to_isosurface.mean_voxels},
              {"isosurface_to_mesh_max_voxels", check.distance.isosurface_to_mesh.max_voxels},
              {"isosurface_to_mesh_mean_voxels", check.distance.isosurface_to_mesh.mean_voxels},
              {"isosurface_samples_to_mesh_max_voxels", judged.samples.max_voxels},
              {"isosurface_samples_to_mesh_mean_voxels", judged.samples.mean_voxels},
              {"vertex_residual_max_voxels", check.residual.distance.max_voxels},
              {"crossing_pairs", check.self_intersection.found.crossing_pairs},
              {"fraction_normals_against", check.normals.fraction_against}};
}

Json verification_json(const JudgedMesh& judged) {
  const Verification& check = judged.check;
  return Json{{"proven", check.proven},
              {"failures", check.failures},
              {"topology_equal", check.topology.verdict == Verdict::kHomeomorphic},
              {"components_expected", judged.components_expected},
              {"components_missed", judged.components_missed},
              {"non_manifold_edges", check.manifold.non_manifold_edges},
              {"non_manifold_vertices", check.manifold.non_manifold_vertices},
              {"zero_area_triangles", check.manifold.zero_area_triangles},
              {"misoriented_edges", check.orientation.misoriented_edges},
              {"reversed_components", check.orientation.reversed_components},
              {"off_box_edges", check.boundary.off_box_edges},
              {"crossing_pairs", check.self_intersection.found.crossing_pairs},
              {"touching_pairs", check.self_intersection.found.touching_pairs}};
}

}  // namespace deliso

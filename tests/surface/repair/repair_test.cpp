// Repair as a whole, on a field that needs many rounds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "surface/base/stage_stats.h"
#include "surface/deliso.h"
#include "surface/mesh/mesh_topology.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

TEST(Repair, IsTheSameForAnyNumberOfThreads) {
  const auto scene = testing::noise_scene({10, 9, 8}, 4);
  const auto mesh = [&](int threads) {
    MeshingOptions options;
    options.threads = threads;
    options.parameters.repair.max_rounds = 2;
    options.keep_stage1_mesh = true;
    return mesh_isosurface(scene->grid, scene->isovalue, options);
  };
  const MeshingResult one = mesh(1);
  EXPECT_GE(one.repair.rounds, 1);
  for (const int threads : {2, 3, 5}) {
    const MeshingResult many = mesh(threads);
    EXPECT_EQ(one.stage1_mesh->points, many.stage1_mesh->points) << threads;
    EXPECT_EQ(one.stage1_mesh->triangles, many.stage1_mesh->triangles) << threads;
    EXPECT_EQ(one.mesh.points, many.mesh.points) << threads;
    EXPECT_EQ(one.mesh.triangles, many.mesh.triangles) << threads;
  }
}

// For a mesh in world coordinates, which equal index coordinates here: the pieces with vertices on more than one
// component.
std::size_t mixed_pieces(const TriangleMesh& mesh, const testing::Scene& scene) {
  const MeshTopology topology = mesh_topology(mesh);
  std::vector<std::set<std::uint32_t>> components(topology.components.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto component = component_of(scene.grid, scene.isovalue, scene.topology, mesh.points[v]);
    if (component) components[topology.component_of_vertex[v]].insert(*component);
  }
  return static_cast<std::size_t>(
      std::count_if(components.begin(), components.end(), [](const auto& on) { return on.size() > 1; }));
}

TEST(Repair, EndsWhenVerticesOfOtherComponentsAreAllThatIsWrong) {
  std::int64_t removed = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const auto scene = testing::noise_scene({10, 9, 8}, seed);
    MeshingOptions options;
    options.keep_stage1_mesh = true;
    const MeshingResult result = mesh_isosurface(scene->grid, scene->isovalue, options);
    EXPECT_EQ(result.certificate.verdict, Verdict::kHomeomorphic);
    if (result.repair.rounds == options.parameters.repair.max_rounds) continue;
    removed += result.repair.foreign_vertices_removed;
    EXPECT_EQ(mixed_pieces(*result.stage1_mesh, *scene), 0u);
  }
  EXPECT_GT(removed, 0);
}

}  // namespace
}  // namespace deliso

#include "surface/refine/guard/refinement_crossings.h"

#include <gtest/gtest.h>

#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

// What of a mesh the search for pairs looks at.
RefinementMesh refinement_mesh(const TriangleMesh& mesh) {
  RefinementMesh result;
  for (const Vec3& p : mesh.points) {
    result.vertices.emplace_back();
    result.vertices.back().point = p;
  }
  for (const auto& corners : mesh.triangles) {
    result.triangles.emplace_back();
    result.triangles.back().corners = corners;
  }
  return result;
}

TEST(RefinementCrossings, OfRenewedTrianglesAreAllPairsWithOne) {
  std::size_t of_renewed = 0, of_old = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Rng rng(seed);
    const TriangleMesh sphere = testing::sphere_mesh(3, 1, {rng.uniform(0, 2), rng.uniform(0, 2), rng.uniform(0, 1)});
    RefinementMesh mesh = refinement_mesh(testing::disjoint_union(testing::torus_mesh(30, 20), sphere));
    // Those of a ball, or any.
    const Vec3 center{rng.uniform(0, 2), rng.uniform(0, 2), rng.uniform(0, 1)};
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (seed % 2 == 0 ? rng.below(20) == 0 : distance(mesh.corner(t, 0), center) < 0.7) mesh.triangles[t].renew();
    }
    const SelfIntersections all = meeting_pairs(mesh, 1);
    ASSERT_EQ(all.crossing_pairs, static_cast<std::int64_t>(all.crossing.size())) << "too many to compare";
    std::vector<TrianglePair> expected;
    for (const TrianglePair& pair : all.crossing) {
      const bool is_of_renewed = mesh.triangles[pair.first].is_renewed() || mesh.triangles[pair.second].is_renewed();
      if (is_of_renewed) expected.push_back(pair);
      ++(is_of_renewed ? of_renewed : of_old);
    }
    for (const int threads : {1, 3}) {
      const SelfIntersections found = meeting_pairs_of_renewed(mesh, threads);
      EXPECT_EQ(found.touching_pairs, 0) << "seed " << seed;
      EXPECT_EQ(found.crossing_pairs, static_cast<std::int64_t>(expected.size())) << "seed " << seed;
      ASSERT_EQ(found.crossing.size(), expected.size()) << "seed " << seed;
      for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(found.crossing[i].position, expected[i].position);
    }
  }
  EXPECT_GT(of_renewed, 100U);
  EXPECT_GT(of_old, 100U);
  EXPECT_EQ(meeting_pairs_of_renewed(refinement_mesh(testing::torus_mesh(30, 20)), 1).crossing_pairs, 0);
}

}  // namespace
}  // namespace deliso

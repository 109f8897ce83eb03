#include "surface/mesh_connectivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

using testing::disjoint_union;

MeshTopology topology_of(const TriangleMesh& mesh) { return mesh_topology(MeshConnectivity(mesh)); }

TEST(MeshConnectivity, AgreesWithAMapOfEdgesOnAnySoup) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Rng rng(seed);
    const TriangleMesh mesh = testing::random_soup(rng, 4 + rng.below(12), rng.below(40));
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> expected;
    for (std::uint32_t h = 0; h < 3 * mesh.triangles.size(); ++h) {
      const std::uint32_t u = mesh.triangles[h / 3][h % 3], v = mesh.triangles[h / 3][(h + 1) % 3];
      expected[std::minmax(u, v)].push_back(h);
    }
    const MeshConnectivity connectivity(mesh);
    ASSERT_EQ(connectivity.edge_count(), expected.size()) << "seed " << seed;
    std::size_t e = 0;
    for (const auto& [ends, half_edges] : expected) {
      ASSERT_EQ(connectivity.edge(e).low, ends.first) << "seed " << seed;
      ASSERT_EQ(connectivity.edge(e).high, ends.second) << "seed " << seed;
      const auto found = connectivity.half_edges(e);
      ASSERT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()), half_edges) << "seed " << seed;
      ++e;
    }
  }
}

// The link of v as a graph, walked by hand: one umbrella means that its edges hang together.
bool has_several_umbrellas(const TriangleMesh& mesh, std::uint32_t v) {
  std::vector<std::array<std::uint32_t, 2>> link;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (t[i] == v) link.push_back({t[(i + 1) % 3], t[(i + 2) % 3]});
    }
  }
  if (link.empty()) return false;
  std::set<std::uint32_t> reached = {link[0][0], link[0][1]};
  for (bool grew = true; grew;) {
    grew = false;
    for (const auto& [a, b] : link) {
      if (reached.count(a) + reached.count(b) == 1) grew = reached.insert(reached.count(a) == 1 ? b : a).second;
    }
  }
  return std::any_of(link.begin(), link.end(), [&](const auto& edge) { return reached.count(edge[0]) == 0; });
}

TEST(MeshTopology, FindsPinchedVerticesLikeAWalkAroundTheLink) {
  int pinched_in_total = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    TriangleMesh mesh = testing::random_soup(rng, 4 + rng.below(20), rng.below(25));
    std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    std::int64_t expected = 0;
    for (std::uint32_t v = 0; v < mesh.points.size(); ++v) expected += has_several_umbrellas(mesh, v) ? 1 : 0;
    EXPECT_EQ(topology_of(mesh).non_manifold_vertices, expected) << "seed " << seed;
    pinched_in_total += static_cast<int>(expected);
  }
  EXPECT_GT(pinched_in_total, 100);
}

TEST(MeshTopology, KnowsSpheresToriAndPatches) {
  const TriangleMesh mesh = disjoint_union(disjoint_union(testing::sphere_mesh(2), testing::torus_mesh(7, 5)),
                                           testing::patch_mesh(3, 2, [](std::uint32_t, std::uint32_t) { return 0.0; }));
  const MeshTopology topology = topology_of(mesh);
  EXPECT_TRUE(topology.is_oriented());
  ASSERT_EQ(topology.components.size(), 3u);
  EXPECT_EQ(topology.components[0].euler_characteristic(), 2);
  EXPECT_EQ(topology.components[1].euler_characteristic(), 0);
  EXPECT_EQ(topology.components[2].euler_characteristic(), 1);
  EXPECT_EQ(topology.components[0].boundary_loops, 0);
  EXPECT_EQ(topology.components[2].boundary_loops, 1);
  EXPECT_EQ(topology.boundary_edges, 10);
}

TEST(MeshTopology, SeesHolesAsLoops) {
  TriangleMesh mesh = testing::sphere_mesh(3);
  mesh.triangles.erase(mesh.triangles.begin() + 300);
  mesh.triangles.erase(mesh.triangles.begin());
  const MeshTopology topology = topology_of(mesh);
  EXPECT_TRUE(topology.is_manifold());
  EXPECT_EQ(topology.components[0].boundary_loops, 2);
  EXPECT_EQ(topology.components[0].euler_characteristic(), 0);
}

TEST(MeshTopology, NamesWhatIsWrong) {
  // Two tetrahedra that share a vertex; then an edge.
  TriangleMesh pinched = disjoint_union(testing::tetrahedron_mesh(), testing::tetrahedron_mesh());
  for (auto& t : pinched.triangles) std::replace(t.begin(), t.end(), 4u, 0u);
  EXPECT_EQ(topology_of(pinched).non_manifold_vertices, 1);
  EXPECT_EQ(topology_of(pinched).non_manifold_edges, 0);
  EXPECT_EQ(topology_of(pinched).unreferenced_vertices, 1);
  EXPECT_EQ(topology_of(pinched).components.size(), 1u);
  EXPECT_FALSE(topology_of(pinched).is_manifold());
  for (auto& t : pinched.triangles) std::replace(t.begin(), t.end(), 5u, 1u);
  EXPECT_EQ(topology_of(pinched).non_manifold_edges, 1);
  EXPECT_EQ(topology_of(pinched).non_manifold_vertices, 0);

  // One triangle turned round.
  TriangleMesh turned = testing::tetrahedron_mesh();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_EQ(topology_of(turned).misoriented_edges, 3);
  EXPECT_TRUE(topology_of(turned).is_manifold());
  EXPECT_FALSE(topology_of(turned).is_oriented());

  TriangleMesh repeated = testing::tetrahedron_mesh();
  repeated.triangles.push_back({1, 1, 2});
  EXPECT_EQ(topology_of(repeated).repeated_vertices, 1);
  EXPECT_FALSE(topology_of(repeated).is_manifold());
}

TEST(MeshTopology, AcceptsTheEmptyMeshAndFindsBadIndices) {
  EXPECT_TRUE(topology_of({}).is_manifold());
  EXPECT_TRUE(topology_of({}).components.empty());
  TriangleMesh mesh = testing::tetrahedron_mesh();
  EXPECT_EQ(first_bad_triangle(mesh), 4u);
  mesh.triangles[2][1] = 4;
  EXPECT_EQ(first_bad_triangle(mesh), 2u);
}

// Every vertex has a few triangles with vertices near it: edges of all kinds, umbrellas of all numbers.
TEST(MeshTopology, IsTheSameForAnyNumberOfThreads) {
  Rng rng(17);
  constexpr std::size_t kVertices = 90000;
  TriangleMesh mesh;
  mesh.points.resize(kVertices + 4);
  for (std::size_t i = 0; i < kVertices; ++i) {
    const auto corner = static_cast<std::uint32_t>(rng.below(kVertices));
    const auto near = [&] { return corner + static_cast<std::uint32_t>(rng.below(5)); };
    mesh.triangles.push_back({near(), near(), near()});
  }
  const MeshConnectivity one(mesh);
  const MeshTopology expected = mesh_topology(one);
  ASSERT_GT(expected.non_manifold_edges, 100);
  ASSERT_GT(expected.non_manifold_vertices, 100);
  ASSERT_GT(expected.components.size(), 100u);
  for (const int threads : {2, 3, 5}) {
    const MeshConnectivity many(mesh, threads);
    ASSERT_EQ(many.edge_count(), one.edge_count()) << threads;
    for (std::size_t e = 0; e < one.edge_count(); ++e) {
      ASSERT_EQ(many.edge(e).low, one.edge(e).low) << threads;
      ASSERT_EQ(many.edge(e).high, one.edge(e).high) << threads;
      const auto a = one.half_edges(e), b = many.half_edges(e);
      ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << threads;
    }
    const MeshTopology found = mesh_topology(many, threads);
    EXPECT_EQ(found.boundary_edges, expected.boundary_edges) << threads;
    EXPECT_EQ(found.non_manifold_edges, expected.non_manifold_edges) << threads;
    EXPECT_EQ(found.non_manifold_vertices, expected.non_manifold_vertices) << threads;
    EXPECT_EQ(found.misoriented_edges, expected.misoriented_edges) << threads;
    EXPECT_EQ(found.unreferenced_vertices, expected.unreferenced_vertices) << threads;
    EXPECT_EQ(found.repeated_vertices, expected.repeated_vertices) << threads;
    EXPECT_EQ(found.component_of_vertex, expected.component_of_vertex) << threads;
    ASSERT_EQ(found.components.size(), expected.components.size()) << threads;
    for (std::size_t c = 0; c < expected.components.size(); ++c) {
      EXPECT_EQ(found.components[c].euler_characteristic(), expected.components[c].euler_characteristic()) << threads;
      EXPECT_EQ(found.components[c].boundary_loops, expected.components[c].boundary_loops) << threads;
    }
  }
}

}  // namespace
}  // namespace deliso

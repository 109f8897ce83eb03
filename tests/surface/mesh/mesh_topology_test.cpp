#include "surface/mesh/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

using testing::disjoint_union;

// Counts by a map from edges to half-edges, and by colouring vertices until nothing changes.
struct CountedByMaps {
  explicit CountedByMaps(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges;  // ends, tails of half-edges
    for (const auto& t : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) edges[std::minmax(t[i], t[(i + 1) % 3])].push_back(t[i]);
      referenced.insert(t.begin(), t.end());
    }
    for (const auto& [ends, tails] : edges) {
      all.push_back({ends.first, ends.second});
      if (tails.size() == 1) boundary.push_back({ends.first, ends.second});
      non_manifold += tails.size() > 2 ? 1 : 0;
      misoriented += tails.size() == 2 && tails[0] == tails[1] ? 1 : 0;
    }
  }
  // The lowest vertex that edges join each vertex to.
  static std::map<std::uint32_t, std::uint32_t> colours(const std::vector<MeshEdge>& edges) {
    std::map<std::uint32_t, std::uint32_t> colour;
    for (const MeshEdge& edge : edges) {
      colour.emplace(edge.low, edge.low);
      colour.emplace(edge.high, edge.high);
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (const MeshEdge& edge : edges) {
        const std::uint32_t least = std::min(colour[edge.low], colour[edge.high]);
        changed = changed || colour[edge.low] != least || colour[edge.high] != least;
        colour[edge.low] = colour[edge.high] = least;
      }
    }
    return colour;
  }

  std::vector<MeshEdge> all, boundary;
  std::int64_t non_manifold = 0, misoriented = 0;
  std::set<std::uint32_t> referenced;
};

TEST(MeshTopology, AgreesWithMapsOnAnySoup) {
  std::int64_t misoriented = 0, non_manifold = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    const TriangleMesh mesh = testing::random_soup(rng, 4 + rng.below(30), rng.below(60));
    const CountedByMaps expected(mesh);
    const MeshTopology found = mesh_topology(mesh);
    EXPECT_EQ(found.boundary_edges, expected.boundary);
    EXPECT_EQ(found.non_manifold_edges, expected.non_manifold);
    EXPECT_EQ(found.misoriented_edges, expected.misoriented);
    EXPECT_EQ(found.unreferenced_vertices, static_cast<std::int64_t>(mesh.points.size() - expected.referenced.size()));
    misoriented += found.misoriented_edges;
    non_manifold += found.non_manifold_edges;

    const auto colour = CountedByMaps::colours(expected.all);
    std::map<std::uint32_t, MeshComponent> components;  // by lowest vertex
    for (const auto& [v, lowest] : colour) ++components[lowest].vertices;
    for (const MeshEdge& edge : expected.all) ++components[colour.at(edge.low)].edges;
    for (const auto& t : mesh.triangles) ++components[colour.at(t[0])].triangles;
    for (const auto& [v, lowest] : CountedByMaps::colours(expected.boundary)) {
      if (v == lowest) ++components[colour.at(v)].boundary_loops;
    }
    ASSERT_EQ(found.components.size(), components.size());
    std::size_t c = 0;
    for (const auto& [lowest, component] : components) {
      EXPECT_EQ(found.component_of_vertex[lowest], c);
      EXPECT_EQ(found.components[c].vertices, component.vertices);
      EXPECT_EQ(found.components[c].edges, component.edges);
      EXPECT_EQ(found.components[c].triangles, component.triangles);
      EXPECT_EQ(found.components[c].boundary_loops, component.boundary_loops);
      ++c;
    }
  }
  EXPECT_GT(misoriented, 100);
  EXPECT_GT(non_manifold, 100);
}

// The link of v as a graph, walked by hand: one umbrella means that its edges are connected.
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
    EXPECT_EQ(mesh_topology(mesh).non_manifold_vertices, expected) << "seed " << seed;
    pinched_in_total += static_cast<int>(expected);
  }
  EXPECT_GT(pinched_in_total, 100);
}

TEST(MeshTopology, KnowsSpheresToriAndPatches) {
  const TriangleMesh mesh = disjoint_union(disjoint_union(testing::sphere_mesh(2), testing::torus_mesh(7, 5)),
                                           testing::patch_mesh(3, 2, [](std::uint32_t, std::uint32_t) { return 0.0; }));
  const MeshTopology topology = mesh_topology(mesh);
  EXPECT_TRUE(topology.is_oriented());
  ASSERT_EQ(topology.components.size(), 3u);
  EXPECT_EQ(topology.components[0].euler_characteristic(), 2);
  EXPECT_EQ(topology.components[1].euler_characteristic(), 0);
  EXPECT_EQ(topology.components[2].euler_characteristic(), 1);
  EXPECT_EQ(topology.components[0].boundary_loops, 0);
  EXPECT_EQ(topology.components[2].boundary_loops, 1);
  EXPECT_EQ(topology.boundary_edges.size(), 10u);
}

TEST(MeshTopology, SeesHolesAsLoops) {
  TriangleMesh mesh = testing::sphere_mesh(3);
  mesh.triangles.erase(mesh.triangles.begin() + 300);
  mesh.triangles.erase(mesh.triangles.begin());
  const MeshTopology topology = mesh_topology(mesh);
  EXPECT_TRUE(topology.is_manifold());
  EXPECT_EQ(topology.components[0].boundary_loops, 2);
  EXPECT_EQ(topology.components[0].euler_characteristic(), 0);
}

TEST(MeshTopology, NamesWhatIsWrong) {
  // Two tetrahedra that share a vertex; then an edge.
  TriangleMesh pinched = disjoint_union(testing::tetrahedron_mesh(), testing::tetrahedron_mesh());
  for (auto& t : pinched.triangles) std::replace(t.begin(), t.end(), 4u, 0u);
  EXPECT_EQ(mesh_topology(pinched).non_manifold_vertices, 1);
  EXPECT_EQ(mesh_topology(pinched).non_manifold_edges, 0);
  EXPECT_EQ(mesh_topology(pinched).unreferenced_vertices, 1);
  EXPECT_EQ(mesh_topology(pinched).components.size(), 1u);
  EXPECT_FALSE(mesh_topology(pinched).is_manifold());
  for (auto& t : pinched.triangles) std::replace(t.begin(), t.end(), 5u, 1u);
  EXPECT_EQ(mesh_topology(pinched).non_manifold_edges, 1);
  EXPECT_EQ(mesh_topology(pinched).non_manifold_vertices, 0);

  // One triangle turned round.
  TriangleMesh turned = testing::tetrahedron_mesh();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_EQ(mesh_topology(turned).misoriented_edges, 3);
  EXPECT_TRUE(mesh_topology(turned).is_manifold());
  EXPECT_FALSE(mesh_topology(turned).is_oriented());

  TriangleMesh repeated = testing::tetrahedron_mesh();
  repeated.triangles.push_back({1, 1, 2});
  EXPECT_EQ(mesh_topology(repeated).repeated_vertices, 1);
  EXPECT_FALSE(mesh_topology(repeated).is_manifold());
}

// Triangles around vertex `apex`, the rim from vertex `first` on.
void add_fan(TriangleMesh& mesh, std::uint32_t apex, std::uint32_t first, std::uint32_t rim) {
  for (std::uint32_t i = 0; i < rim; ++i) mesh.triangles.push_back({apex, first + i, first + (i + 1) % rim});
}

// Short fans, longer ones, and one longer than those that are walked: closed; then cut open; with one triangle twice;
// and two fans at one vertex.
TEST(MeshTopology, KnowsFansOfAnyLength) {
  for (const std::uint32_t rim : {3u, 4u, 7u, 8u, 9u, 15u, 16u, 17u, 1000u}) {
    SCOPED_TRACE(rim);
    TriangleMesh mesh;
    mesh.points.resize(rim + 1);
    add_fan(mesh, rim, 0, rim);
    EXPECT_TRUE(mesh_topology(mesh).is_oriented());
    EXPECT_EQ(mesh_topology(mesh).boundary_edges.size(), rim);
    TriangleMesh open = mesh;
    open.triangles.erase(open.triangles.begin() + rim / 2);
    EXPECT_TRUE(mesh_topology(open).is_oriented());
    EXPECT_EQ(mesh_topology(open).boundary_edges.size(), rim + 1);
    TriangleMesh doubled = mesh;
    doubled.triangles.push_back(mesh.triangles[rim / 2]);
    EXPECT_EQ(mesh_topology(doubled).non_manifold_edges, 2);
    EXPECT_EQ(mesh_topology(doubled).misoriented_edges, 1);
    for (const std::uint32_t other : {3u, 5u, 11u}) {
      TriangleMesh pinched = mesh;
      pinched.points.resize(rim + 1 + other);
      add_fan(pinched, rim, rim + 1, other);
      EXPECT_EQ(mesh_topology(pinched).non_manifold_vertices, 1);
      EXPECT_EQ(mesh_topology(pinched).components.size(), 1u);
      EXPECT_EQ(mesh_topology(pinched).boundary_edges.size(), rim + other);
    }
  }
}

TEST(MeshTopology, AcceptsTheEmptyMeshAndFindsBadIndices) {
  EXPECT_TRUE(mesh_topology({}).is_manifold());
  EXPECT_TRUE(mesh_topology({}).components.empty());
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
  const MeshTopology expected = mesh_topology(mesh);
  ASSERT_GT(expected.non_manifold_edges, 100);
  ASSERT_GT(expected.non_manifold_vertices, 100);
  ASSERT_GT(expected.components.size(), 100u);
  for (const int threads : {2, 3, 5}) {
    const MeshTopology found = mesh_topology(mesh, threads);
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

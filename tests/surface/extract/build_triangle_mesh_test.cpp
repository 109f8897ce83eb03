#include "surface/extract/build_triangle_mesh.h"

#include <gtest/gtest.h>

#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

// What must hold of every mesh built; returns it.
BuiltMesh checked_build(const SignedDelaunay& restricted) {
  BuiltMesh built = build_triangle_mesh(restricted);
  EXPECT_EQ(testing::surface_mesh_defect(built.mesh), "");
  EXPECT_EQ(built.vertex_of.size(), built.mesh.points.size());
  EXPECT_TRUE(std::is_sorted(built.copies.begin(), built.copies.end()));

  // Copies share their vertex with another one and lie at most 2e-4 from it; all others lie exactly on theirs, except
  // those on a subdivided edge.
  const Tetrahedralization& delaunay = restricted.delaunay();
  std::map<std::uint32_t, int> uses;
  for (const VertexId v : built.vertex_of) ++uses[v.value];
  std::size_t on_edges = 0;
  for (std::uint32_t v = 0; v < built.mesh.points.size(); ++v) {
    EXPECT_FALSE(restricted.is_virtual(built.vertex_of[v]));
    const double moved = distance(built.mesh.points[v], delaunay.point(built.vertex_of[v]));
    const bool is_copy = std::binary_search(built.copies.begin(), built.copies.end(), v);
    if (is_copy) {
      EXPECT_GT(uses[built.vertex_of[v].value], 1);
      EXPECT_LE(moved, 2e-4 * (1 + 1e-9));
    } else if (moved > 0) {
      ++on_edges;
    }
    EXPECT_TRUE(restricted.isosurface().box().contains(built.mesh.points[v]));
  }
  // As many triangles as restricted facets, and two more (one on the boundary) for every subdivided edge.
  std::size_t facets = 0;
  for (const auto& f : testing::restricted_by_name(restricted)) {
    facets += std::any_of(f.begin(), f.end(), [&](auto v) { return restricted.is_virtual(VertexId(v)); }) ? 0 : 1;
  }
  EXPECT_GE(built.mesh.triangles.size(), facets + on_edges);
  EXPECT_LE(built.mesh.triangles.size(), facets + 2 * on_edges);
  return built;
}

TEST(BuildTriangleMesh, NoiseGivesOrientedManifoldsForEverySeed) {
  std::size_t copies = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto scene = noise_scene({3 + static_cast<std::int32_t>(seed % 4), 5, 4}, seed);
    SCOPED_TRACE(scene->name);
    copies += checked_build(SignedDelaunay(*scene->isosurface, scene->start())).copies.size();
  }
  EXPECT_GT(copies, 50u);  // or nothing was pinched
}

TEST(BuildTriangleMesh, RandomSignsGiveOrientedManifoldsToo) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto scene = field_scene(seed % 2 == 0 ? "torus" : "gyroid", 12);
    SignedDelaunay restricted(*scene->isosurface, scene->start());
    Rng rng(seed);
    for (std::size_t i = 0; i < restricted.delaunay().tet_slots(); ++i) {
      if (restricted.delaunay().is_live(TetId(i)) && rng.below(2 + seed % 5) == 0) restricted.flip_sign(TetId(i));
    }
    checked_build(restricted);
  }
}

TEST(BuildTriangleMesh, DenseSamplesGiveTheKnownTopologyWithoutCopies) {
  for (const char* name : {"sphere", "torus", "sheets", "plane"}) {
    SCOPED_TRACE(name);
    const auto scene = field_scene(name, 20);
    std::vector<Vec3> points;
    for (const EdgeCrossing& c : scene->topology.crossings) points.push_back(crossing_position(scene->grid, c));
    const BuiltMesh built = checked_build(SignedDelaunay(*scene->isosurface, points));
    // Nearly coplanar points make flat tetrahedra whose signs mean little: the plane may touch itself.
    EXPECT_TRUE(built.copies.empty() || std::string(name) == "plane");
    std::vector<ComponentTopology> expected = scene->topology.components;
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(test::mesh_facts(built.mesh.triangles).components, expected);
  }
}

TEST(BuildTriangleMesh, TrianglesFaceLowerValues) {
  const auto scene = field_scene("torus", 24);
  std::vector<Vec3> points;
  for (const EdgeCrossing& c : scene->topology.crossings) points.push_back(crossing_position(scene->grid, c));
  const BuiltMesh built = checked_build(SignedDelaunay(*scene->isosurface, points));
  // Grid-edge crossings may be close to each other and their triangles then stand any way: a few.
  std::size_t against = 0;
  for (const auto& t : built.mesh.triangles) {
    const Vec3 &a = built.mesh.points[t[0]], &b = built.mesh.points[t[1]], &c = built.mesh.points[t[2]];
    against += dot(cross(b - a, c - a), scene->isosurface->gradient((a + b + c) / 3)) < 0 ? 0 : 1;
  }
  EXPECT_LE(against, built.mesh.triangles.size() / 200);
}

// Two tetrahedra above that share an edge, all others below: the surface touches itself along one edge. It may become
// two closed spheres or one, but no edge may have four triangles.
TEST(BuildTriangleMesh, AnEdgeSharedByFourFacetsIsPulledApart) {
  const auto scene = field_scene("sphere", 12);
  std::size_t pinched = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SignedDelaunay restricted(*scene->isosurface, scene->start());
    const Tetrahedralization& delaunay = restricted.delaunay();
    std::vector<TetId> finite;
    for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
      if (!delaunay.is_live(TetId(i))) continue;
      if (restricted.is_above(TetId(i))) restricted.flip_sign(TetId(i));
      if (!delaunay.is_ghost(TetId(i))) finite.push_back(TetId(i));
    }
    Rng rng(seed);
    const TetId one = finite[rng.below(finite.size())];
    const TetId two = finite[rng.below(finite.size())];
    if (one == two) continue;
    const auto a = testing::name_of(delaunay, one);
    const auto b = testing::name_of(delaunay, two);
    std::vector<std::uint32_t> shared;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(shared));
    restricted.flip_sign(one);
    restricted.flip_sign(two);
    const BuiltMesh built = checked_build(restricted);
    const auto components = test::mesh_facts(built.mesh.triangles).components;
    EXPECT_TRUE(std::all_of(components.begin(), components.end(), [](const auto& c) {
      return c == ComponentTopology{2, 0};
    }));
    if (shared.size() < 2) {
      EXPECT_EQ(components.size(), 2u) << "seed " << seed;
    }
    pinched += shared.size() == 1 || shared.size() == 2 ? 1 : 0;
  }
  EXPECT_GT(pinched, 3u);
}

}  // namespace
}  // namespace deliso

// Vertices with the same place are merged, and the mesh stays what it is.
#include "surface/mesh/equal_vertices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "surface/mesh/mesh_topology.h"
#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

SurfaceMesh mesh_of(const TriangleMesh& from) {
  SurfaceMesh mesh;
  mesh.points = from.points;
  mesh.triangles = from.triangles;
  return mesh;
}

MeshTopology topology_of(const SurfaceMesh& mesh) { return mesh_topology({mesh.points, mesh.triangles}); }

// The place of every vertex rounded to a multiple of `step`, so that many coincide.
std::vector<Vec3> rounded(const std::vector<Vec3>& points, double step) {
  std::vector<Vec3> places;
  for (const Vec3& p : points) {
    places.push_back({step * std::round(p.x / step), step * std::round(p.y / step), step * std::round(p.z / step)});
  }
  return places;
}

TEST(EqualVertices, NothingIsDoneWhereAllDiffer) {
  SurfaceMesh mesh = mesh_of(testing::sphere_mesh(3));
  const auto before = mesh.triangles;
  EXPECT_EQ(merge_equal_vertices(mesh.points, mesh), 0);
  EXPECT_EQ(mesh.triangles, before);
}

TEST(EqualVertices, OnAnEdgeAreMerged) {
  SurfaceMesh mesh = mesh_of(testing::sphere_mesh(3));
  std::vector<Vec3> places = mesh.points;
  const auto [a, b, c] = mesh.triangles.front();
  places[a] = places[b];
  const std::size_t points = mesh.points.size(), triangles = mesh.triangles.size();
  EXPECT_EQ(merge_equal_vertices(places, mesh), 1);
  EXPECT_EQ(mesh.points.size(), points - 1);
  EXPECT_EQ(mesh.triangles.size(), triangles - 2);
}

// However many coincide: closed and open meshes of any genus stay manifold, with the same topology.
TEST(EqualVertices, KeepTheTopology) {
  for (const TriangleMesh& from : {testing::sphere_mesh(5), testing::torus_mesh(24, 16)}) {
    for (const bool is_open : {false, true}) {
      for (const double step : {0.4, 0.7, 1.0, 5.0}) {
        SurfaceMesh mesh = mesh_of(from);
        if (is_open) mesh.triangles.resize(mesh.triangles.size() - 1);
        const MeshTopology before = topology_of(mesh);
        const std::size_t points = mesh.points.size();
        const std::int64_t merged = merge_equal_vertices(rounded(mesh.points, step), mesh);
        const MeshTopology after = topology_of(mesh);
        EXPECT_GT(merged, 0) << step;
        EXPECT_EQ(mesh.points.size(), points - static_cast<std::size_t>(merged));
        EXPECT_TRUE(after.is_oriented());
        ASSERT_EQ(after.components.size(), before.components.size());
        EXPECT_EQ(after.components[0].euler_characteristic(), before.components[0].euler_characteristic());
        EXPECT_EQ(after.components[0].boundary_loops, before.components[0].boundary_loops);
        EXPECT_EQ(after.unreferenced_vertices, 0);
      }
    }
  }
}

// A tetrahedron of equal vertices has no smaller mesh.
TEST(EqualVertices, ATetrahedronStays) {
  SurfaceMesh mesh;
  mesh.points.assign(4, Vec3{1, 2, 3});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  EXPECT_EQ(merge_equal_vertices(mesh.points, mesh), 0);
  EXPECT_EQ(mesh.triangles.size(), 4u);
}

}  // namespace
}  // namespace deliso

// Neighbours of triangles that come without.
#include "surface/mesh/side_adjacency.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "surface/certificate/exact_polygonization.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

std::set<std::uint32_t> ends_of(const SurfaceMesh& mesh, TriangleSide side) {
  const auto& v = mesh.triangles[side >> 2];
  return {v[((side & 3u) + 1) % 3], v[((side & 3u) + 2) % 3]};
}

TEST(SideAdjacency, AManifoldGetsItsNeighbours) {
  for (const char* name : {"double_torus", "gyroid", "sheets"}) {
    const auto scene = testing::field_scene(name, 16);
    SurfaceMesh mesh = exact_polygonization(scene->surface()).mesh;
    mesh.neighbours.clear();
    set_side_adjacency(mesh);
    EXPECT_EQ(testing::surface_mesh_defect(mesh), "") << name;
  }
}

TEST(SideAdjacency, WhereManyShareAnEdgeEachGetsOneOfThem) {
  // Pages of a book, and a triangle of its own.
  SurfaceMesh mesh;
  mesh.points.resize(20);
  for (std::uint32_t page = 0; page < 5; ++page) mesh.triangles.push_back({0, 1, 2 + page});
  mesh.triangles.push_back({10, 11, 12});
  set_side_adjacency(mesh);
  ASSERT_EQ(mesh.neighbours.size(), mesh.triangles.size());
  for (std::uint32_t t = 0; t < 5; ++t) {
    const TriangleSide beyond = mesh.neighbours[t][2];
    ASSERT_NE(beyond, kNoSide);
    EXPECT_NE(beyond >> 2, t);
    EXPECT_EQ(ends_of(mesh, beyond), ends_of(mesh, 4 * t + 2));
    EXPECT_EQ(mesh.neighbours[t][0], kNoSide);
    EXPECT_EQ(mesh.neighbours[t][1], kNoSide);
  }
  EXPECT_EQ(mesh.neighbours[5], (std::array<TriangleSide, 3>{kNoSide, kNoSide, kNoSide}));
}

}  // namespace
}  // namespace deliso

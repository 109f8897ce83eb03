// Vertices of different parts at one place come apart, within the faces of the box.
#include "surface/mesh/vertex_separation.h"

#include <gtest/gtest.h>

#include "surface/intersection/self_intersection.h"

namespace deliso {
namespace {

// Two triangles in the planes x + y + z = 1 and x - y - z = 1, mirrored: they share the place (1, 0, 0) alone.
TEST(VertexSeparation, MovesBothAlongTheEdgeOfTheBox) {
  const Box3 box{{0, 0, 0}, {2, 2, 2}};
  SurfaceMesh mesh;
  mesh.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {2, 1, 0}, {2, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}};
  ASSERT_EQ(self_intersections(mesh.points, mesh.triangles).touching_pairs, 1);
  EXPECT_EQ(separate_equal_vertices(mesh.points, box, mesh), 2);
  EXPECT_EQ(self_intersections(mesh.points, mesh.triangles).meeting_pairs(), 0);
  for (const std::uint32_t v : {0U, 3U}) {
    EXPECT_LE(distance(mesh.points[v], {1, 0, 0}), 2e-4);
    EXPECT_EQ(mesh.points[v].y, 0);
    EXPECT_EQ(mesh.points[v].z, 0);
  }
  EXPECT_LT(mesh.points[0].x, mesh.points[3].x);
  EXPECT_EQ(separate_equal_vertices(mesh.points, box, mesh), 0);
}

}  // namespace
}  // namespace deliso

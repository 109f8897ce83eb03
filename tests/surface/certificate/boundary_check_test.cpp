#include "surface/certificate/boundary_check.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace deliso {
namespace {

// A square of n x n quads that cuts the box [0, 1]^3 in two.
SurfaceMesh square(std::uint32_t n) {
  SurfaceMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) mesh.points.push_back({double(i) / n, double(j) / n, 0.5});
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

TEST(BoundaryCheck, ABoundaryOnTheBoxIsLeftAlone) {
  EXPECT_TRUE(boundary_edges_off_box(square(5), {{0, 0, 0}, {1, 1, 1}}, 1e-3).empty());
}

TEST(BoundaryCheck, EdgesThatLeaveTheBoxAreFoundOnce) {
  SurfaceMesh mesh = square(5);
  mesh.points[2].y = 0.01;  // an inner vertex of the lowest row: two edges leave the face
  EXPECT_EQ(boundary_edges_off_box(mesh, {{0, 0, 0}, {1, 1, 1}}, 1e-3).size(), 2u);
  EXPECT_TRUE(boundary_edges_off_box(mesh, {{0, 0, 0}, {1, 1, 1}}, 0.02).empty());
}

// From one face to another across an edge of the box: both ends lie on the box, the edge on no face of it.
TEST(BoundaryCheck, AnEdgeAcrossACornerIsFound) {
  SurfaceMesh mesh = square(5);
  mesh.triangles[0] = {1, 7, 6};  // instead of the two triangles at the corner
  mesh.triangles.erase(mesh.triangles.begin() + 1);
  EXPECT_EQ(boundary_edges_off_box(mesh, {{0, 0, 0}, {1, 1, 1}}, 1e-3), (std::vector<MeshEdge>{{1, 6}}));
}

}  // namespace
}  // namespace deliso

#include "surface/mesh/known_triangles.h"

#include <gtest/gtest.h>

namespace deliso {
namespace {

TEST(KnownTriangles, AreKnownByTheirCornersWhateverTheirNumbers) {
  SurfaceMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  KnownTriangles known;
  EXPECT_FALSE(known.has(mesh, 0));
  EXPECT_TRUE(known.add(mesh, 0));
  EXPECT_FALSE(known.add(mesh, 0));
  EXPECT_FALSE(known.has(mesh, 1));
  SurfaceMesh other;
  other.points = {{0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}};
  other.triangles = {{1, 0, 2}, {3, 0, 2}, {0, 2, 3}, {0, 3, 2}};
  EXPECT_FALSE(known.has(other, 0));
  EXPECT_TRUE(known.has(other, 1));
  EXPECT_TRUE(known.has(other, 2));
  EXPECT_FALSE(known.has(other, 3)) << "it faces the other way";
}

}  // namespace
}  // namespace deliso

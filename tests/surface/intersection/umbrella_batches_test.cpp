#include "surface/intersection/umbrella_batches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

std::vector<UmbrellaBatch> rows_of(const TriangleMesh& mesh, const std::vector<std::uint8_t>& takes_part) {
  const VertexCorners corners(mesh.points.size(), mesh.triangles, [&](std::size_t t) { return takes_part[t] != 0; });
  return umbrella_batches(mesh.triangles, takes_part, corners, mesh.points.size());
}

TEST(UmbrellaBatches, HaveEachTriangleThatTakesPartOnce) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    const TriangleMesh mesh =
        seed % 2 == 0 ? testing::random_soup(rng, 3 + rng.below(60), 100) : testing::torus_mesh(20, 15);
    std::vector<std::uint8_t> takes_part(mesh.triangles.size());
    for (std::size_t t = 0; t < takes_part.size(); ++t) {
      auto corners = mesh.triangles[t];
      std::sort(corners.begin(), corners.end());
      const bool has_three = std::adjacent_find(corners.begin(), corners.end()) == corners.end();
      takes_part[t] = has_three && (seed < 3 || rng.below(5) != 0) ? 1 : 0;
    }
    std::vector<std::uint8_t> found(takes_part.size());
    for (const UmbrellaBatch& row : rows_of(mesh, takes_part)) {
      ASSERT_GT(row.count, 0U);
      ASSERT_LE(row.count, kTrianglesPerBatch);
      for (std::size_t i = 0; i < row.count; ++i) ++found[row.triangles[i]];
      const auto& first = mesh.triangles[row.triangles[0]];
      EXPECT_NE(std::find(first.begin(), first.end(), row.vertex), first.end());
    }
    EXPECT_EQ(found, takes_part);
  }
}

// Of a mesh whose vertices have six triangles each, as a rule.
TEST(UmbrellaBatches, AreFewAndMostlyOfOneUmbrella) {
  const TriangleMesh mesh = testing::sphere_mesh(5);
  const std::vector<UmbrellaBatch> rows = rows_of(mesh, std::vector<std::uint8_t>(mesh.triangles.size(), 1));
  EXPECT_LT(rows.size(), mesh.triangles.size() / 6);
  std::size_t in_umbrella = 0;
  for (const UmbrellaBatch& row : rows) {
    in_umbrella += static_cast<std::size_t>(
        std::count_if(row.triangles.begin(), row.triangles.begin() + row.count, [&](std::uint32_t t) {
          const auto& corners = mesh.triangles[t];
          return std::find(corners.begin(), corners.end(), row.vertex) != corners.end();
        }));
  }
  EXPECT_GT(in_umbrella, 7 * mesh.triangles.size() / 10);
}

}  // namespace
}  // namespace deliso

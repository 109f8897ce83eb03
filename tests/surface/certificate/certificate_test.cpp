// The certificate: what it proves, and what it says when it cannot.
#include "surface/certificate/certificate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/mesh_examples.h"
#include "tests/support/topology_grids.h"
#include "tests/support/topology_mesh_check.h"
#include "volume/marching_cubes/marching_cubes.h"

namespace deliso {
namespace {

using Components = std::vector<ComponentTopology>;
using testing::disjoint_union;
using testing::sphere_mesh;
using testing::torus_mesh;

// A strip of n squares, each cut in two, closed with or without a half twist.
TriangleMesh strip(std::uint32_t n, bool twisted) {
  TriangleMesh mesh;
  mesh.points.resize(2 * static_cast<std::size_t>(n));
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool last = i + 1 == n;
    std::uint32_t low = last ? 0 : 2 * i + 2;
    std::uint32_t high = low + 1;
    if (last && twisted) std::swap(low, high);
    mesh.triangles.push_back({2 * i, low, high});
    mesh.triangles.push_back({2 * i, high, 2 * i + 1});
  }
  return mesh;
}

std::string only_difference(const Certificate& certificate) {
  return certificate.differences.size() == 1 ? certificate.differences.front()
                                             : std::to_string(certificate.differences.size()) + " differences";
}

// By its counts alone it would be a disk.
TEST(Certificate, ATriangleThatNamesAVertexTwiceIsNoDisk) {
  TriangleMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 0, 1}};
  const Certificate certificate = certify(mesh, Components{{1, 1}});
  EXPECT_FALSE(certificate.manifold);
  EXPECT_EQ(certificate.verdict, Verdict::kDifferent);
}

TEST(Certificate, ProvesEqualMultisets) {
  TriangleMesh mesh = sphere_mesh(2);
  mesh = disjoint_union(mesh, torus_mesh(8, 5));
  mesh = disjoint_union(mesh, sphere_mesh(0));
  mesh = disjoint_union(mesh, strip(7, false));
  EXPECT_EQ(component_topologies(mesh), (Components{{0, 0}, {0, 2}, {2, 0}, {2, 0}}));
  const Certificate certificate = certify(mesh, Components{{2, 0}, {0, 2}, {2, 0}, {0, 0}});
  EXPECT_EQ(certificate.verdict, Verdict::kHomeomorphic);
  EXPECT_TRUE(certificate.manifold);
  EXPECT_TRUE(certificate.oriented);
  EXPECT_TRUE(certificate.differences.empty());
  ASSERT_EQ(certificate.mesh.size(), 3u);
  EXPECT_EQ(certificate.mesh[2].topology, (ComponentTopology{2, 0}));
  EXPECT_EQ(certificate.mesh[2].count, 2);
  ASSERT_EQ(certificate.isosurface.size(), 3u);
  EXPECT_EQ(certificate.isosurface[1].topology, (ComponentTopology{0, 2}));
}

TEST(Certificate, AnEmptyMeshIsAnEmptySurface) {
  EXPECT_EQ(certify(TriangleMesh{}, Components{}).verdict, Verdict::kHomeomorphic);
  EXPECT_EQ(certify(TriangleMesh{}, Components{{2, 0}}).verdict, Verdict::kDifferent);
}

TEST(Certificate, NamesTheComponentsThatDiffer) {
  TriangleMesh mesh = sphere_mesh(1);
  mesh = disjoint_union(mesh, sphere_mesh(1));
  const Certificate missing = certify(mesh, Components{{2, 0}, {2, 0}, {2, 0}});
  EXPECT_EQ(missing.verdict, Verdict::kDifferent);
  EXPECT_TRUE(missing.manifold);
  EXPECT_EQ(only_difference(missing),
            "The mesh has 2 components with Euler characteristic 2 and 0 boundary loops, the isosurface has 3.");

  const Certificate other = certify(mesh, Components{{-4, 1}, {2, 0}});
  ASSERT_EQ(other.differences.size(), 2u);
  EXPECT_EQ(other.differences[0],
            "The mesh has 0 components with Euler characteristic -4 and 1 boundary loop, the isosurface has 1.");
  EXPECT_EQ(other.differences[1],
            "The mesh has 2 components with Euler characteristic 2 and 0 boundary loops, the isosurface has 1.");
}

TEST(Certificate, EqualTotalsAreNotEnough) {
  // A sphere and a double torus have the total of two tori.
  TriangleMesh mesh = torus_mesh(6, 5);
  mesh = disjoint_union(mesh, torus_mesh(6, 5));
  EXPECT_EQ(certify(mesh, Components{{2, 0}, {-2, 0}}).verdict, Verdict::kDifferent);
  EXPECT_EQ(certify(mesh, Components{{0, 0}, {0, 0}}).verdict, Verdict::kHomeomorphic);
}

TEST(Certificate, AMoebiusStripIsNoOrientedManifold) {
  const Certificate certificate = certify(strip(9, true), Components{{0, 1}});
  EXPECT_EQ(certificate.verdict, Verdict::kDifferent);
  EXPECT_TRUE(certificate.manifold);
  EXPECT_FALSE(certificate.oriented);
  EXPECT_EQ(only_difference(certificate), "The two triangles of 1 edge disagree in orientation.");
}

TEST(Certificate, AFlippedTriangleIsFound) {
  TriangleMesh mesh = sphere_mesh(2);
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  const Certificate certificate = certify(mesh, Components{{2, 0}});
  EXPECT_EQ(certificate.verdict, Verdict::kDifferent);
  EXPECT_EQ(only_difference(certificate), "The two triangles of 3 edges disagree in orientation.");
}

TEST(Certificate, AFinIsFound) {
  TriangleMesh mesh = sphere_mesh(1);
  mesh.points.push_back({5, 5, 5});
  const auto [a, b, c] = mesh.triangles[0];
  mesh.triangles.push_back({b, a, static_cast<std::uint32_t>(mesh.points.size() - 1)});
  const Certificate certificate = certify(mesh, Components{{2, 0}});
  EXPECT_EQ(certificate.verdict, Verdict::kDifferent);
  EXPECT_FALSE(certificate.manifold);
  EXPECT_NE(
      std::find(certificate.differences.begin(), certificate.differences.end(), "1 edge has more than two triangles."),
      certificate.differences.end());
}

TEST(Certificate, APinchedVertexIsFound) {
  TriangleMesh mesh = sphere_mesh(1);
  mesh = disjoint_union(mesh, sphere_mesh(1));
  const auto second = static_cast<std::uint32_t>(mesh.points.size() / 2);
  for (auto& triangle : mesh.triangles) {
    std::replace(triangle.begin(), triangle.end(), second, std::uint32_t{0});
  }
  const Certificate certificate = certify(mesh, Components{{3, 0}});
  EXPECT_EQ(certificate.verdict, Verdict::kDifferent);
  EXPECT_FALSE(certificate.manifold);
  EXPECT_EQ(only_difference(certificate), "1 vertex has more than one umbrella.");
}

TEST(Certificate, AnIndexOutOfRangeIsFound) {
  TriangleMesh mesh = sphere_mesh(0);
  mesh.triangles[3][1] = 6;
  const Certificate certificate = certify(mesh, Components{{2, 0}});
  EXPECT_EQ(certificate.verdict, Verdict::kDifferent);
  EXPECT_FALSE(certificate.manifold);
  EXPECT_EQ(only_difference(certificate), "Triangle 3 names a vertex beyond the mesh's 6 points.");
}

TEST(Certificate, VerticesWithoutTrianglesDoNotCount) {
  TriangleMesh mesh = sphere_mesh(1);
  mesh.points.push_back({9, 9, 9});
  EXPECT_EQ(certify(mesh, Components{{2, 0}}).verdict, Verdict::kHomeomorphic);
}

TEST(Certificate, ASingularIsovalueIsNeverProven) {
  // 2 * 6 - 3 * 4 = 0: a saddle of the face z = 0 has the isovalue.
  const ScalarGrid grid({2, 2, 2}, std::vector<double>{2, -3, -4, 6, 1, 1, 1, 1});
  const IsosurfaceTopology topology = exact_topology(grid, 0);
  const MarchingCubesMesh cubes = marching_cubes(grid, 0);
  const Certificate certificate = certify({cubes.points, cubes.triangles}, topology);
  EXPECT_EQ(certificate.verdict, Verdict::kSingularIsovalue);
  EXPECT_EQ(only_difference(certificate),
            "The isovalue is that of a saddle: the isosurface is no manifold in 1 cell, the first one (0, 0, 0).");
}

TEST(Certificate, AgreesWithASlowCheckOnMarchingCubes) {
  Rng rng(41);
  for (int i = 0; i < 40; ++i) {
    const test::IntegerGrid integers = test::random_integer_grid(rng, test::random_dims(rng, 12), 1000);
    const ScalarGrid grid = test::scalar_grid(integers);
    const MarchingCubesMesh cubes = marching_cubes(grid, -0.5);
    const TriangleMesh mesh{cubes.points, cubes.triangles};
    ASSERT_EQ(component_topologies(mesh), test::mesh_facts(mesh.triangles).components)
        << "case " << i << " after seed 41";
    ASSERT_EQ(certify(mesh, exact_topology(grid, -0.5)).verdict, Verdict::kHomeomorphic) << "case " << i;
  }
}

TEST(Certificate, AHoleInAClosedSurfaceIsFound) {
  Rng rng(42);
  for (int i = 0; i < 20; ++i) {
    const test::IntegerGrid integers = test::random_integer_grid(rng, test::random_dims(rng, 8), 1000);
    const ScalarGrid grid = padded(test::scalar_grid(integers), -1000);
    const MarchingCubesMesh cubes = marching_cubes(grid, -0.5);
    TriangleMesh mesh{cubes.points, cubes.triangles};
    const IsosurfaceTopology topology = exact_topology(grid, -0.5);
    ASSERT_EQ(certify(mesh, topology).verdict, Verdict::kHomeomorphic) << "case " << i << " after seed 42";
    if (mesh.triangles.empty()) continue;
    mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(rng.below(mesh.triangles.size())));
    ASSERT_EQ(certify(mesh, topology).verdict, Verdict::kDifferent) << "case " << i << " after seed 42";
  }
}

}  // namespace
}  // namespace deliso

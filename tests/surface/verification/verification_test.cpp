#include "surface/verification/verification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"
#include "tests/support/mesh_examples.h"
#include "tests/support/mesh_fields.h"

namespace deliso {
namespace {

using testing::ball_field;
using testing::disjoint_union;
using testing::on_isosurface;
using testing::sampled;

constexpr double kRadius = 6;
const Vec3 kCenter{8.1, 7.9, 8.3};

ScalarGrid ball_grid() { return sampled({17, 17, 17}, ball_field(kCenter, kRadius)); }

TriangleMesh ball_mesh(const ScalarGrid& grid) {
  return on_isosurface(testing::sphere_mesh(3, kRadius, kCenter), grid, 0);
}

TEST(Verification, ProvesASphere) {
  const ScalarGrid grid = ball_grid();
  const Verification v = verify_mesh(ball_mesh(grid), grid, 0);
  EXPECT_TRUE(v.proven) << (v.failures.empty() ? "" : v.failures[0]);
  EXPECT_TRUE(v.manifold.pass && v.orientation.pass && v.boundary.pass && v.normals.pass);
  EXPECT_EQ(v.manifold.euler_characteristic, 2);
  EXPECT_EQ(v.boundary.boundary_edges, 0);
  EXPECT_LT(v.residual.distance.max_voxels, 1e-10);
  EXPECT_LT(v.distance.mesh_to_isosurface.max_voxels, 0.15);
  EXPECT_LT(v.distance.isosurface_to_mesh.max_voxels, 0.15);
  EXPECT_GT(v.normals.min_cosine, 0.95);
  EXPECT_EQ(v.isovalue_used, 0);
  EXPECT_EQ(
      std::accumulate(v.quality.min_angle_histogram.begin(), v.quality.min_angle_histogram.end(), std::int64_t{0}),
      v.triangles);
}

TEST(Verification, ProvesATorusInAStretchedVolumeSomewhereElse) {
  const Vec3 center{100.03, -50.02, 7.01};
  const auto torus = [&](const Vec3& p) {
    const Vec3 d = p - center;
    return 1.5 - std::hypot(std::hypot(d.x, d.y) - 4, d.z);
  };
  const ScalarGrid grid = sampled({31, 25, 17}, torus, {0.4, 0.5, 0.25}, {94, -56, 5});
  TriangleMesh mesh = testing::torus_mesh(60, 24, 4, 1.5);
  for (Vec3& p : mesh.points) p = p + center;
  mesh = on_isosurface(mesh, grid, 0);
  const Verification v = verify_mesh(mesh, grid, 0);
  EXPECT_TRUE(v.proven) << (v.failures.empty() ? "" : v.failures[0]);
  EXPECT_EQ(v.manifold.euler_characteristic, 0);
  EXPECT_TRUE(v.normals.pass);
}

// Heights at grid corners are exact, so the graph over the grid is on the isosurface and ends on the box.
// Few numbers lie between such samples: values of the interpolant less the isovalue have digits that it has not itself.
TEST(Verification, ProvesASurfaceOfSamplesThatHardlyDiffer) {
  const auto ball = ball_field(kCenter, kRadius);
  const auto integer = [&](const Vec3& p) { return 4 * std::round(4 * ball(p)); };
  const ScalarGrid plain = sampled({17, 17, 17}, integer);
  const TriangleMesh mesh = on_isosurface(testing::sphere_mesh(3, kRadius, kCenter), plain, -1);
  for (const double base : {1.0, -4096.0, 1e6, 1e200}) {
    const double unit = std::nextafter(std::abs(base), 2 * std::abs(base)) - std::abs(base);
    const ScalarGrid grid = sampled({17, 17, 17}, [&](const Vec3& p) { return base + unit * integer(p); });
    const Verification v = verify_mesh(mesh, grid, base - unit);
    EXPECT_TRUE(v.proven) << base << (v.failures.empty() ? "" : v.failures[0]);
    EXPECT_LT(v.residual.distance.max_voxels, 1e-9) << base;
  }
}

TEST(Verification, ProvesASurfaceCutByTheBox) {
  const auto height = [](double x, double y) { return 4.3 + std::sin(0.5 * x) * std::cos(0.4 * y); };
  const ScalarGrid grid = sampled({9, 8, 10}, [&](const Vec3& p) { return height(p.x, p.y) - p.z; });
  const TriangleMesh mesh = testing::patch_mesh(8, 7, [&](std::uint32_t i, std::uint32_t j) { return height(i, j); });
  Verification v = verify_mesh(mesh, grid, 0);
  EXPECT_TRUE(v.proven) << (v.failures.empty() ? "" : v.failures[0]);
  EXPECT_EQ(v.boundary.boundary_edges, 30);
  EXPECT_EQ(v.boundary.off_box_edges, 0);
  EXPECT_EQ(v.manifold.boundary_loops, 1);

  // A hole inside is not a boundary on the box.
  TriangleMesh holed = mesh;
  holed.triangles.erase(holed.triangles.begin() + 50);
  v = verify_mesh(holed, grid, 0);
  EXPECT_FALSE(v.proven);
  EXPECT_FALSE(v.boundary.pass);
  EXPECT_EQ(v.boundary.off_box_edges, 3);
  EXPECT_EQ(v.topology.verdict, Verdict::kDifferent);
}

// Without a triangle at an edge of the box: still a disk, and both ends of its new boundary edge lie on the box, but
// not on one face.
TEST(Verification, AnEdgeFromFaceToFaceOfTheBoxIsNotOnTheBox) {
  const auto height = [](double x, double y) { return 4.3 + std::sin(0.5 * x) * std::cos(0.4 * y); };
  const ScalarGrid grid = sampled({9, 8, 10}, [&](const Vec3& p) { return height(p.x, p.y) - p.z; });
  const TriangleMesh mesh = testing::patch_mesh(8, 7, [&](std::uint32_t i, std::uint32_t j) { return height(i, j); });
  int cut = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    int on_box = 0, on_edge = 0;
    for (const std::uint32_t v : mesh.triangles[t]) {
      const Vec3& p = mesh.points[v];
      const bool in_x = p.x == 0 || p.x == 8, in_y = p.y == 0 || p.y == 7;
      on_box += in_x || in_y ? 1 : 0;
      on_edge += in_x && in_y ? 1 : 0;
    }
    if (on_box != 3 || on_edge != 1) continue;
    ++cut;
    TriangleMesh without = mesh;
    without.triangles.erase(without.triangles.begin() + static_cast<std::ptrdiff_t>(t));
    const Verification v = verify_mesh(without, grid, 0);
    EXPECT_FALSE(v.proven);
    EXPECT_EQ(v.topology.verdict, Verdict::kHomeomorphic);
    EXPECT_EQ(v.boundary.off_box_edges, 1);
    EXPECT_FALSE(v.boundary.pass);
  }
  EXPECT_EQ(cut, 2);
}

// Every vertex is on the surface, but the middles of triangles are farther than a voxel off.
TEST(Verification, AMeshTooCoarseIsNotProven) {
  const ScalarGrid grid = sampled({17, 17, 17}, ball_field(kCenter, 7));
  const Verification v = verify_mesh(on_isosurface(testing::sphere_mesh(1, 7, kCenter), grid, 0), grid, 0);
  EXPECT_GT(v.distance.isosurface_to_mesh.max_voxels, 1.1);
  EXPECT_LT(v.distance.isosurface_to_mesh.max_voxels, 1.6);
  EXPECT_FALSE(v.proven || v.distance.pass);
  EXPECT_EQ(v.failures.size(), 2u);  // each way
  EXPECT_TRUE(
      verify_mesh(on_isosurface(testing::sphere_mesh(1, 7, kCenter), grid, 0), grid, 0, {.max_distance = 2}).proven);
}

// A mesh as far off as promised is a hair farther in other coordinates.
TEST(Verification, RoundingRefutesNoDistance) {
  const ScalarGrid grid = ball_grid();
  const TriangleMesh mesh = ball_mesh(grid);
  const Verification loose = verify_mesh(mesh, grid, 0);
  const double most =
      std::max(loose.distance.mesh_to_isosurface.max_voxels, loose.distance.isosurface_to_mesh.max_voxels);
  ASSERT_GT(most, 0.001);
  EXPECT_TRUE(verify_mesh(mesh, grid, 0, Promise{.max_distance = most * (1 - 1e-12)}).distance.pass);
  EXPECT_FALSE(verify_mesh(mesh, grid, 0, Promise{.max_distance = most * (1 - 1e-6)}).distance.pass);
}

// The topology is right and all of the isosurface has a triangle near, but a flap of the mesh stands off it.
TEST(Verification, AMeshThatLeavesTheIsosurfaceIsNotProven) {
  const ScalarGrid grid = ball_grid();
  TriangleMesh mesh = ball_mesh(grid);
  mesh.points.push_back(mesh.points[mesh.triangles[0][0]] + 0.4 * (mesh.points[mesh.triangles[0][0]] - kCenter));
  const auto spike = static_cast<std::uint32_t>(mesh.points.size() - 1);
  const auto [a, b, c] = mesh.triangles[0];
  mesh.triangles[0] = {a, b, spike};
  mesh.triangles.push_back({b, c, spike});
  mesh.triangles.push_back({c, a, spike});
  const Verification v = verify_mesh(mesh, grid, 0);
  EXPECT_EQ(v.topology.verdict, Verdict::kHomeomorphic);
  EXPECT_LT(v.distance.isosurface_to_mesh.max_voxels, 1);
  EXPECT_GT(v.distance.mesh_to_isosurface.max_voxels, 1);
  EXPECT_FALSE(v.proven || v.distance.pass);
}

TEST(Verification, SaysWhatIsWrong) {
  const ScalarGrid grid = ball_grid();
  const TriangleMesh mesh = ball_mesh(grid);

  TriangleMesh reversed = mesh;
  for (auto& t : reversed.triangles) std::swap(t[0], t[1]);
  Verification v = verify_mesh(reversed, grid, 0);
  EXPECT_FALSE(v.proven || v.orientation.pass || v.normals.pass);
  EXPECT_EQ(v.orientation.reversed_components, 1);
  ASSERT_EQ(v.orientation.reversed_at.size(), 1u);
  EXPECT_NE(std::find(mesh.points.begin(), mesh.points.end(), v.orientation.reversed_at[0]), mesh.points.end());
  ASSERT_EQ(v.failures.size(), 1u);
  EXPECT_EQ(v.failures[0], "1 component faces higher values");

  TriangleMesh displaced = mesh;
  displaced.points[20] += 0.0005 * (displaced.points[20] - kCenter);
  v = verify_mesh(displaced, grid, 0);
  EXPECT_FALSE(v.proven || v.residual.pass);
  EXPECT_GT(v.residual.distance.max_voxels, 1e-3);
  EXPECT_EQ(v.residual.distance.worst, displaced.points[20]);

  TriangleMesh pierced = mesh;
  pierced.points[20] = kCenter - 1.5 * (pierced.points[20] - kCenter);
  v = verify_mesh(pierced, grid, 0);
  EXPECT_FALSE(v.proven || v.self_intersection.pass);
  EXPECT_GT(v.self_intersection.found.crossing_pairs, 0);

  TriangleMesh doubled = disjoint_union(mesh, mesh);
  v = verify_mesh(doubled, grid, 0);
  EXPECT_FALSE(v.proven || v.self_intersection.pass);
  EXPECT_EQ(v.topology.verdict, Verdict::kDifferent);

  TriangleMesh messy = mesh;
  messy.triangles.push_back(messy.triangles[0]);
  messy.triangles.push_back({3, 3, 4});
  messy.points.push_back({1, 1, 1});
  v = verify_mesh(messy, grid, 0);
  EXPECT_FALSE(v.proven || v.manifold.pass);
  EXPECT_EQ(v.manifold.duplicate_triangles, 1);
  EXPECT_EQ(v.manifold.repeated_vertices, 1);
  EXPECT_EQ(v.manifold.zero_area_triangles, 1);
  EXPECT_EQ(v.manifold.unreferenced_vertices, 1);
}

// An edge without length: all triangles that have an area are right, and those at the edge meet nothing.
TEST(Verification, RefutesTrianglesWithoutArea) {
  const ScalarGrid grid = ball_grid();
  TriangleMesh mesh = ball_mesh(grid);
  const auto first = mesh.triangles[0];
  const auto across = std::find_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    return (t[0] == first[1] && t[1] == first[0]) || (t[1] == first[1] && t[2] == first[0]) ||
           (t[2] == first[1] && t[0] == first[0]);
  });
  ASSERT_NE(across, mesh.triangles.end());
  const auto copy = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(mesh.points[first[0]]);
  const auto halves = [&](std::array<std::uint32_t, 3>& triangle) {
    auto other = triangle;
    std::replace(triangle.begin(), triangle.end(), first[0], copy);
    std::replace(other.begin(), other.end(), first[1], copy);
    return other;
  };
  const auto one = halves(mesh.triangles[0]), two = halves(*across);
  mesh.triangles.push_back(one);
  mesh.triangles.push_back(two);
  const Verification v = verify_mesh(mesh, grid, 0);
  EXPECT_TRUE(v.manifold.pass);
  EXPECT_EQ(v.self_intersection.found.crossing_pairs, 0);
  EXPECT_EQ(v.manifold.zero_area_triangles, 2);
  EXPECT_FALSE(v.proven);
  ASSERT_EQ(v.failures.size(), 2U);
  EXPECT_NE(v.failures[0].find("touch beyond what they share"), std::string::npos) << "vertices in one place";
  EXPECT_NE(v.failures[1].find("2 triangles have no area"), std::string::npos);
}

// Whatever the unit of the samples, within the range that is accepted (volume/isovalue_range.h).
TEST(Verification, KnowsAReversedMeshWhateverTheScaleOfTheSamples) {
  const TriangleMesh mesh = ball_mesh(ball_grid());
  TriangleMesh reversed = mesh;
  for (auto& t : reversed.triangles) std::swap(t[0], t[1]);
  for (const int exponent : {-900, -540, -300, 300, 540, 900}) {
    const ScalarGrid grid =
        sampled({17, 17, 17}, [&](const Vec3& p) { return std::ldexp(ball_field(kCenter, kRadius)(p), exponent); });
    const Verification v = verify_mesh(mesh, grid, 0);
    EXPECT_TRUE(v.proven && v.normals.pass) << exponent;
    const Verification w = verify_mesh(reversed, grid, 0);
    EXPECT_EQ(w.orientation.reversed_components, 1) << exponent;
    EXPECT_FALSE(w.proven) << exponent;
    EXPECT_FALSE(w.normals.pass) << exponent;
  }
}

TEST(Verification, MissesNoComponent) {
  const Vec3 a{7, 7, 7}, b{18, 7, 7};
  const ScalarGrid grid =
      sampled({26, 15, 15}, [&](const Vec3& p) { return std::max(ball_field(a, 4.2)(p), ball_field(b, 3.7)(p)); });
  const TriangleMesh first = on_isosurface(testing::sphere_mesh(3, 4.2, a), grid, 0);
  const TriangleMesh second = on_isosurface(testing::sphere_mesh(3, 3.7, b), grid, 0);
  EXPECT_TRUE(verify_mesh(disjoint_union(first, second), grid, 0).proven);
  const Verification v = verify_mesh(first, grid, 0);
  EXPECT_FALSE(v.proven || v.distance.pass);
  EXPECT_EQ(v.topology.verdict, Verdict::kDifferent);
  EXPECT_NEAR(v.distance.isosurface_to_mesh.max_voxels, distance(a, b) + 3.7 - 4.2, 0.2);
  EXPECT_EQ(v.failures.size(), 2u);
}

TEST(Verification, JudgesAnyMeshWithoutFalling) {
  const ScalarGrid grid = ball_grid();
  const Verification empty = verify_mesh({}, grid, 0);
  EXPECT_FALSE(empty.proven);
  EXPECT_EQ(empty.failures.front(), "the mesh has no triangle");
  EXPECT_TRUE(std::isfinite(empty.distance.isosurface_to_mesh.max_voxels));
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rng rng(seed);
    TriangleMesh soup = testing::random_soup(rng, 3 + rng.below(30), rng.below(20));
    for (Vec3& p : soup.points) p = rng.uniform(1, 100) * p - Vec3{20, 20, 20};
    const Verification v = verify_mesh(soup, grid, 0);
    EXPECT_FALSE(v.proven) << "seed " << seed;
    for (const double figure : {v.residual.distance.max_voxels, v.distance.mesh_to_isosurface.mean_voxels,
                                v.distance.isosurface_to_mesh.max_voxels, v.normals.min_cosine,
                                v.quality.radius_edge_max, v.quality.max_angle_degrees}) {
      EXPECT_TRUE(std::isfinite(figure)) << "seed " << seed;
    }
  }
}

TEST(Verification, RefusesBadInput) {
  const ScalarGrid grid = ball_grid();
  TriangleMesh mesh = ball_mesh(grid);
  EXPECT_THROW(verify_mesh(mesh, grid, 100), InputError);
  EXPECT_THROW(verify_mesh(mesh, grid, std::nan("")), InputError);
  mesh.triangles[5][1] = 1u << 30;
  EXPECT_THROW(verify_mesh(mesh, grid, 0), InputError);
}

TEST(DelaunayBalls, AreEmptyOnAnOctahedronUntilAVertexIsPutInside) {
  const ScalarGrid grid = ball_grid();
  TriangleMesh mesh = on_isosurface(testing::sphere_mesh(0, kRadius, kCenter), grid, 0);
  DelaunayBallCheck check = check_delaunay_balls(mesh, grid, 0);
  EXPECT_TRUE(check.pass);
  // The balls sit where the diagonals leave the ball; one of them gets a vertex.
  mesh.points.push_back(kCenter + kRadius / std::sqrt(3.0) * Vec3{1, 1, 1});
  check = check_delaunay_balls(mesh, grid, 0);
  EXPECT_EQ(check.occupied, 1);
  EXPECT_EQ(check.without_hit, 0);
  // A triangle that faces inward has no falling hit along its normal but the one on the far side.
  mesh.points.pop_back();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  check = check_delaunay_balls(mesh, grid, 0);
  EXPECT_EQ(check.occupied, 1);
  // Degenerate triangles have no ball.
  mesh.triangles = {{0, 0, 1}};
  EXPECT_EQ(check_delaunay_balls(mesh, grid, 0).without_hit, 1);
}

// One ball's sphere twice, the other's not at all: the counts are right.
TEST(Verification, CountsDoNotProveWhatIsNotInItsPlace) {
  const Vec3 left{7.1, 8.2, 7.9}, right{20.2, 8.1, 8.3};
  const auto balls = [&](const Vec3& p) { return kRadius - 1 - std::min(norm(p - left), norm(p - right)); };
  const ScalarGrid grid = sampled({28, 17, 17}, balls);
  const TriangleMesh one = on_isosurface(testing::sphere_mesh(2, kRadius - 1, left), grid, 0);
  const TriangleMesh other = on_isosurface(testing::sphere_mesh(2, kRadius - 1, right), grid, 0);
  EXPECT_EQ(verify_mesh(disjoint_union(one, other), grid, 0).topology.verdict, Verdict::kHomeomorphic);
  const Verification twice = verify_mesh(disjoint_union(one, one), grid, 0);
  EXPECT_EQ(twice.topology.verdict, Verdict::kDifferent);
  EXPECT_EQ(twice.topology.differences.size(), 2u);  // none on one component, several on the other
}

}  // namespace
}  // namespace deliso

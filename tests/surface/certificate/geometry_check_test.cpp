// The mesher's own check of distances against the verification's, which measures with other code.
#include "surface/certificate/geometry_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <vector>

#include "surface/certificate/exact_polygonization.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/verification/surface_distance.h"
#include "surface/verification/verification.h"
#include "tests/support/mesh_examples.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::Scene;

// What the verification counts of a mesh in mesh space.
Verification verified(const SurfaceMesh& mesh, const Scene& scene, const Promise& promise) {
  return verify_mesh(to_world(mesh, *scene.isosurface), scene.grid, scene.isovalue, promise);
}

std::int64_t count_far(const std::vector<Vec3>& points, const SurfaceMesh& mesh, double most) {
  std::int64_t count = 0;
  points_to_mesh(points, TriangleMesh{mesh.points, mesh.triangles}, 1e9, most, &count);
  return count;
}

// With a bound far below a voxel each triangle takes thousands of parts.
TEST(GeometryCheck, EndsEarlyWhenTheRunIsToStop) {
  const auto scene = testing::noise_scene({9, 8, 10}, 3);
  const SurfaceMesh mesh = exact_polygonization(scene->surface()).mesh;
  const Promise promise{.max_distance = 0.01, .within_cells = true};
  ASSERT_FALSE(check_geometry(mesh, scene->surface(), promise).is_near());
  const std::atomic<bool> stop{true};
  const Controls controls({}, &stop, {});
  ExactSurface surface = scene->surface();
  surface.controls = &controls;
  const GeometryCheck check = check_geometry(mesh, surface, promise);
  EXPECT_TRUE(check.far_triangles.empty());
  EXPECT_TRUE(check.missed_points.empty());
}

TEST(GeometryCheck, FindsNothingWrongWithExactPolygonizations) {
  for (const auto& scene : {testing::field_scene("gyroid", 16), testing::noise_scene({9, 8, 10}, 3)}) {
    SCOPED_TRACE(scene->name);
    const SurfaceMesh mesh = exact_polygonization(scene->surface()).mesh;
    const GeometryCheck check = check_geometry(mesh, scene->surface(), {});
    EXPECT_TRUE(check.is_near());
    EXPECT_EQ(check.reversed_components, 0);
  }
}

TEST(GeometryCheck, AgreesWithTheVerificationOnMovedVertices) {
  const auto scene = testing::field_scene("sphere", 24);
  const SurfaceMesh exact = exact_polygonization(scene->surface()).mesh;
  Rng rng(7);
  int off = 0, near = 0;
  for (int i = 0; i < 20; ++i) {
    SurfaceMesh mesh = exact;
    const auto v = static_cast<std::size_t>(rng.below(mesh.points.size()));
    const Vec3 normal = scene->isosurface->gradient(mesh.points[v]);
    mesh.points[v] += (4 * rng.uniform() - 2) / norm(normal) * normal;
    const Promise promise{.max_distance = 0.5, .within_cells = true};
    const GeometryCheck check = check_geometry(mesh, scene->surface(), promise);
    const Verification verification = verified(mesh, *scene, promise);
    EXPECT_EQ(check.vertices_off > 0, !verification.residual.pass);
    // The mesher takes corners for points of the isosurface, and what is within the distance of one for near. Around a
    // corner that is off, which is told anyway, only the verification finds samples too far.
    const bool is_farther = verification.distance.mesh_to_isosurface.max_voxels > 0.5;
    EXPECT_EQ(check.mesh_off > 0 || check.vertices_off > 0, is_farther || !verification.residual.pass);
    EXPECT_TRUE(check.mesh_off == 0 || is_farther);
    // The verification looks at points of a finer grid, the mesher at all points of the cells.
    const double farthest = verification.distance.isosurface_to_mesh.max_voxels;
    EXPECT_TRUE(!check.missed_points.empty() || farthest <= 0.5);
    EXPECT_TRUE(check.missed_points.empty() || farthest > 0.4);
    EXPECT_EQ(!check.missed_numbers.empty(), count_far(crossing_points(*scene), mesh, 0.5) > 0);
    (check.is_near() ? near : off) += 1;
  }
  EXPECT_GT(off, 0);
  EXPECT_GT(near, 0);
}

TEST(GeometryCheck, TellsTheCrossingsThatNoTriangleIsNear) {
  const auto scene = testing::field_scene("linked_tori", 40);
  ASSERT_GT(scene->topology.components.size(), 1u);
  const ExactPolygonization exact = exact_polygonization(scene->surface());
  SurfaceMesh mesh = exact.mesh;
  std::vector<bool> is_gone;
  for (const auto& t : mesh.triangles) is_gone.push_back(exact.component[t[0]] == 0);
  drop_triangles(mesh, is_gone);
  for (const int threads : {1, 3}) {
    const GeometryCheck check = check_geometry(mesh, scene->surface(threads), {});
    const auto& crossings = scene->topology.crossings;
    const auto missing =
        std::count_if(crossings.begin(), crossings.end(), [](const EdgeCrossing& c) { return c.component == 0; });
    EXPECT_GT(check.missed_points.size(), 0u);
    EXPECT_LE(check.missed_points.size(), static_cast<std::size_t>(missing));
    EXPECT_EQ(check.mesh_off, 0);
  }
}

TEST(GeometryCheck, TellsReversedComponents) {
  const auto scene = testing::field_scene("linked_tori", 40);
  const ExactPolygonization exact = exact_polygonization(scene->surface());
  SurfaceMesh mesh = exact.mesh;
  for (auto& t : mesh.triangles) {
    if (exact.component[t[0]] == 1) std::swap(t[0], t[1]);
  }
  EXPECT_EQ(check_geometry(mesh, scene->surface(), {}).reversed_components, 1);
}

// Around a sample this near to the isovalue triangles are smaller than vertices may be off, and none tells.
TEST(GeometryCheck, TellsReversedComponentsThatAreNearlyNothing) {
  for (const double radius : {0.1, 2e-3, 1e-3, 1e-4}) {
    SCOPED_TRACE(radius);
    std::vector<double> samples(9 * 9 * 9, -1);
    samples[4 * 81 + 4 * 9 + 4] = radius / (1 - radius);
    const Scene scene("point", ScalarGrid({9, 9, 9}, std::move(samples)), 0);
    SurfaceMesh mesh = exact_polygonization(scene.surface()).mesh;
    EXPECT_EQ(check_geometry(mesh, scene.surface(), {}).reversed_components, 0);
    for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
    EXPECT_EQ(check_geometry(mesh, scene.surface(), {}).reversed_components, 1);
  }
}

// A ball with a hollow shell in it. The triangles of the ball's mesh that are asked first lie on the shell's outer
// side, which faces the other way; most of the others do not. All of that side, turned around, is reversed.
TEST(GeometryCheck, ComponentsOfWhichTheFirstTrianglesLieElsewhereAreNotCalledReversed) {
  const Vec3 centre{12, 12, 12};
  constexpr double kBall = 10, kOuter = 8.5, kInner = 7;
  const Scene scene("shell",
                    testing::sampled({25, 25, 25},
                                     [&](const Vec3& p) {
                                       const double r = distance(p, centre);
                                       return std::min(kBall - r, std::max(r - kOuter, kInner - r));
                                     }),
                    0.01);
  const auto check = [&](std::size_t count) {
    SurfaceMesh mesh;
    const TriangleMesh sphere = testing::sphere_mesh(4, kBall, centre);
    mesh.points = sphere.points;
    mesh.triangles = sphere.triangles;
    for (std::size_t t = 0; t < count; ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) {
        mesh.points[v] = centre + kOuter / distance(mesh.points[v], centre) * (mesh.points[v] - centre);
      }
    }
    return check_geometry(mesh, scene.surface(), {}).reversed_components;
  };
  EXPECT_EQ(check(100), 0);
  EXPECT_EQ(check(testing::sphere_mesh(4).triangles.size()), 1);
}

// An octahedron without one of its vertices: two triangles in place of the four around it.
SurfaceMesh without_vertex(SurfaceMesh mesh, std::uint32_t gone) {
  std::map<std::uint32_t, std::uint32_t> next;
  std::vector<std::array<std::uint32_t, 3>> left;
  for (auto t : mesh.triangles) {
    for (int i = 0; i < 3 && t[0] != gone; ++i) std::rotate(t.begin(), t.begin() + 1, t.end());
    if (t[0] == gone) {
      next[t[1]] = t[2];
    } else {
      left.push_back(t);
    }
  }
  const std::uint32_t first = next.begin()->first, second = next[first], third = next[second];
  left.push_back({first, second, third});
  left.push_back({first, third, next[third]});
  mesh.triangles = left;
  return mesh;
}

// Grains around samples just above the isovalue are thinner than the points beside their triangles were apart, and
// vertices may be left out that are hardly off the rest: two triangles through the sample then lie within the grain.
TEST(GeometryCheck, GrainsAFewThousandthsOfAVoxelLargeAreNotCalledReversed) {
  constexpr std::size_t kCenter = 62;  // of 5^3 samples
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Rng rng(seed);
    std::vector<std::uint8_t> samples(125);
    for (std::uint8_t& sample : samples) sample = static_cast<std::uint8_t>(24 + rng.below(9));
    samples[kCenter] = 34;
    samples[kCenter + 1] = 33;
    const Scene scene("grain", ScalarGrid({5, 5, 5}, samples), 33.99);
    const SurfaceMesh octahedron = exact_polygonization(scene.surface()).mesh;
    ASSERT_EQ(octahedron.triangles.size(), 8u);
    const auto farthest = std::max_element(octahedron.points.begin(), octahedron.points.end(),
                                           [](const Vec3& a, const Vec3& b) { return a.x < b.x; }) -
                          octahedron.points.begin();
    const SurfaceMesh mesh = without_vertex(octahedron, static_cast<std::uint32_t>(farthest));
    EXPECT_EQ(check_geometry(mesh, scene.surface(), {}).reversed_components, 0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace deliso

// Edges with vertices of their other side on them: flipped, the mesh is the same set of points without flat triangles.
#include "surface/mesh/flat_triangles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <set>

#include "delaunay/base/rng.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/mesh/triangle_area.h"
#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

// Coordinates of few digits, so that the middle of two vertices is exact.
SurfaceMesh coarse_sphere() {
  SurfaceMesh mesh;
  const TriangleMesh sphere = testing::sphere_mesh(4);
  mesh.triangles = sphere.triangles;
  for (const Vec3& p : sphere.points) {
    mesh.points.push_back({std::ldexp(std::round(std::ldexp(p.x, 20)), -20),
                           std::ldexp(std::round(std::ldexp(p.y, 20)), -20),
                           std::ldexp(std::round(std::ldexp(p.z, 20)), -20)});
  }
  return mesh;
}

// Cuts a triangle at so many points of one edge, and closes the gap with triangles in that line.
void add_flat(SurfaceMesh& mesh, std::uint32_t t, unsigned corner, int count) {
  const std::array<std::uint32_t, 3> old = mesh.triangles[t];
  const std::uint32_t a = old.at((corner + 1) % 3), b = old.at((corner + 2) % 3), c = old.at(corner);
  std::uint32_t last = a;
  Vec3 from = mesh.points[a];
  for (int i = 0; i < count; ++i) {
    const Vec3 point = (from + mesh.points[b]) / 2;
    const auto next = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(point);
    if (i == 0) {
      mesh.triangles[t] = {a, next, c};
    } else {
      mesh.triangles.push_back({last, next, c});
      mesh.triangles.push_back({next, last, a});
    }
    last = next;
    from = point;
  }
  mesh.triangles.push_back({last, b, c});
  mesh.triangles.push_back({a, b, last});
}

double area_of(const SurfaceMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += norm(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a])) / 2;
  }
  return area;
}

TEST(FlatTriangles, AreFlippedAndTheMeshStaysTheSameSetOfPoints) {
  std::int64_t flipped = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SurfaceMesh mesh = coarse_sphere();
    set_side_adjacency(mesh);
    Rng random(seed);
    const auto neighbours = mesh.neighbours;
    std::set<std::uint32_t> used;
    for (int i = 0; i < 60; ++i) {
      const auto t = static_cast<std::uint32_t>(random.below(neighbours.size()));
      const auto corner = static_cast<unsigned>(random.below(3));
      const std::uint32_t other = neighbours[t].at(corner) >> 2;
      if (used.contains(t) || used.contains(other)) continue;
      used.insert({t, other});
      add_flat(mesh, t, corner, 1 + static_cast<int>(random.below(4)));
    }
    const std::int64_t flat = count_without_area(mesh);
    ASSERT_GT(flat, 20) << "seed " << seed;
    const double area = area_of(mesh);
    flipped += flip_flat_triangles(mesh);
    EXPECT_EQ(count_without_area(mesh), 0) << "seed " << seed;
    EXPECT_NEAR(area_of(mesh), area, 1e-9 * area);
    const MeshTopology topology = mesh_topology({mesh.points, mesh.triangles});
    EXPECT_TRUE(topology.is_manifold());
    EXPECT_EQ(topology.components.size(), 1u);
    EXPECT_EQ(topology.components[0].euler_characteristic(), 2);
    SurfaceMesh fresh = mesh;
    set_side_adjacency(fresh);
    EXPECT_EQ(mesh.neighbours, fresh.neighbours) << "seed " << seed;
  }
  EXPECT_GT(flipped, 400);
}

TEST(FlatTriangles, NothingIsDoneWhereAllHaveArea) {
  SurfaceMesh mesh = coarse_sphere();
  const auto before = mesh.triangles;
  EXPECT_EQ(flip_flat_triangles(mesh), 0);
  EXPECT_EQ(mesh.triangles, before);
}

}  // namespace
}  // namespace deliso

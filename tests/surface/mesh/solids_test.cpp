// Points inside solids and cavities, judged by solid angles, and crossings of lines where lines meet edges and
// vertices.
#include "surface/mesh/solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/mesh/axis_rays.h"
#include "surface/mesh/mesh_topology.h"
#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

using testing::sphere_mesh;
using testing::torus_mesh;

TriangleMesh reversed(TriangleMesh mesh) {
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  return mesh;
}

void append_mesh(const TriangleMesh& from, TriangleMesh& to) {
  const auto base = static_cast<std::uint32_t>(to.points.size());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  for (const auto& [a, b, c] : from.triangles) to.triangles.push_back({base + a, base + b, base + c});
}

// A box whose faces are parallel to the axes, outward.
TriangleMesh box_mesh(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.push_back(
        {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z});
  for (const auto& [a, b, c, d] : std::vector<std::array<std::uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

// How often a component winds around p, by the solid angles of its triangles (Van Oosterom and Strackee 1983).
double winding(const TriangleMesh& mesh, const MeshTopology& topology, std::uint32_t component, const Vec3& p) {
  double sum = 0;
  for (const auto& triangle : mesh.triangles) {
    if (topology.component_of_vertex[triangle[0]] != component) continue;
    const Vec3 a = mesh.points[triangle[0]] - p, b = mesh.points[triangle[1]] - p, c = mesh.points[triangle[2]] - p;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

// The components around the point of a part are its own and those of its ancestors, and no others.
void expect_right_points(const TriangleMesh& mesh, const EnclosedParts& enclosed) {
  const MeshTopology topology = mesh_topology(mesh);
  for (std::size_t i = 0; i < enclosed.parts.size(); ++i) {
    const EnclosedPart& part = enclosed.parts[i];
    ASSERT_TRUE(part.point) << "part " << i;
    std::vector<int> expected(topology.components.size(), 0);
    for (const EnclosedPart* p = &part;; p = &enclosed.parts[*p->parent]) {
      expected[p->component] = p->is_solid ? 1 : -1;
      if (!p->parent) break;
    }
    for (std::uint32_t c = 0; c < expected.size(); ++c) {
      if (topology.components[c].boundary_loops > 0) continue;
      EXPECT_NEAR(winding(mesh, topology, c, *part.point), expected[c], 1e-6) << "part " << i << ", component " << c;
    }
  }
}

EnclosedParts parts_of(const TriangleMesh& mesh) { return enclosed_parts(mesh, mesh_topology(mesh)); }

TEST(Solids, NestedShellsHaveAPointInEachSolidAndEachCavity) {
  TriangleMesh mesh;
  append_mesh(sphere_mesh(3, 10), mesh);
  append_mesh(reversed(sphere_mesh(3, 8)), mesh);
  append_mesh(torus_mesh(24, 12, 4, 1), mesh);
  append_mesh(sphere_mesh(2, 2), mesh);
  append_mesh(reversed(sphere_mesh(2, 1)), mesh);
  append_mesh(sphere_mesh(2, 3, {20, 0, 0}), mesh);
  const EnclosedParts enclosed = parts_of(mesh);
  ASSERT_EQ(enclosed.parts.size(), 6u);
  expect_right_points(mesh, enclosed);
  const std::vector<bool> solid = {true, false, true, true, false, true};
  const std::vector<int> parent = {-1, 0, 1, 1, 3, -1};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(enclosed.parts[i].is_solid, solid[i]) << i;
    EXPECT_EQ(enclosed.parts[i].parent ? static_cast<int>(*enclosed.parts[i].parent) : -1, parent[i]) << i;
  }
}

// Every line through a centroid passes edges, vertices or faces of other boxes.
TEST(Solids, BoxesParallelToTheAxesAreNoHarder) {
  TriangleMesh mesh;
  for (int depth = 0; depth < 7; ++depth) {
    const double low = depth, high = 20 - depth;
    const TriangleMesh box = box_mesh({low, low, low}, {high, high, high});
    append_mesh(depth % 2 == 0 ? box : reversed(box), mesh);
  }
  for (int i = 0; i < 3; ++i) append_mesh(box_mesh({30.0 + 3 * i, 0, 0}, {32.0 + 3 * i, 2, 2}), mesh);
  const EnclosedParts enclosed = parts_of(mesh);
  ASSERT_EQ(enclosed.parts.size(), 10u);
  expect_right_points(mesh, enclosed);
  for (std::size_t i = 1; i < 7; ++i) EXPECT_EQ(enclosed.parts[i].parent, static_cast<std::uint32_t>(i - 1));
}

TEST(Solids, ThinShellsOfAnyMagnitudeAndPlace) {
  Rng rng(7);
  for (const double size : {1e-30, 1e-3, 1.0, 1e20}) {
    TriangleMesh mesh;
    const Vec3 center = size * Vec3{3 + rng.uniform(), 5, -7};
    append_mesh(sphere_mesh(4, size, center), mesh);
    append_mesh(reversed(sphere_mesh(4, 0.9999 * size, center)), mesh);
    const EnclosedParts enclosed = parts_of(mesh);
    ASSERT_EQ(enclosed.parts.size(), 2u);
    expect_right_points(mesh, enclosed);
  }
}

TEST(Solids, RandomBallsInBalls) {
  Rng rng(11);
  for (int round = 0; round < 20; ++round) {
    TriangleMesh mesh;
    // Balls in the cells of a lattice, each a random stack of shells.
    for (int cell = 0; cell < 8; ++cell) {
      const Vec3 center{4.0 * (cell & 1), 4.0 * (cell >> 1 & 1), 4.0 * (cell >> 2)};
      double radius = 1.9;
      for (std::uint64_t shells = rng.below(4), i = 0; i < shells; ++i, radius *= 0.6 + 0.3 * rng.uniform()) {
        const TriangleMesh ball = sphere_mesh(static_cast<int>(2 + rng.below(2)), radius, center);
        append_mesh(i % 2 == 0 ? ball : reversed(ball), mesh);
      }
    }
    expect_right_points(mesh, parts_of(mesh));
  }
}

TEST(Solids, OpenAndBrokenMeshesEncloseNothing) {
  TriangleMesh mesh = sphere_mesh(2);
  mesh.triangles.pop_back();
  append_mesh(sphere_mesh(2, 1, {5, 0, 0}), mesh);
  EnclosedParts enclosed = parts_of(mesh);
  EXPECT_EQ(enclosed.open_components, 1);
  ASSERT_EQ(enclosed.parts.size(), 1u);
  expect_right_points(mesh, enclosed);
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);  // neighbours disagree
  EXPECT_TRUE(parts_of(mesh).parts.empty());
  EXPECT_TRUE(parts_of({}).parts.empty());
  // Two spheres through each other: what is found holds, the rest has no point.
  TriangleMesh crossing = sphere_mesh(2);
  append_mesh(sphere_mesh(2, 1, {0.5, 0, 0}), crossing);
  EXPECT_EQ(parts_of(crossing).parts.size(), 2u);
  // Beyond what predicates compute with.
  for (Vec3& p : mesh.points) p = 1e200 * p;
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  for (const EnclosedPart& part : parts_of(mesh).parts) EXPECT_FALSE(part.point);
}

// Through vertices and along edges and faces: in and out in turn all the same.
TEST(AxisRays, ClosedSurfacesAreCrossedInAndOutInTurn) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {4, 4, 4});
  append_mesh(sphere_mesh(3, 4, {20, 2, 2}), mesh);
  const AxisRays rays(mesh);
  std::vector<AxisCrossing> crossings;
  std::size_t count = 0;
  for (int y = -1; y <= 20; ++y) {
    for (int z = -1; z <= 20; ++z) {
      const Vec3 p{-5.5, 0.25 * y, 0.25 * z};
      rays.cross(p, crossings);
      EXPECT_EQ(crossings.size() % 2, 0u);
      std::map<bool, int> sum;  // of the box, of the sphere
      for (const AxisCrossing& crossing : crossings) {
        EXPECT_EQ(crossing.place, 1);
        sum[crossing.triangle < 12] += crossing.side;
      }
      for (const auto& [is_box, sides] : sum) EXPECT_EQ(sides, 0);
      count += crossings.size();
    }
  }
  EXPECT_GT(count, 500u);
}

}  // namespace
}  // namespace deliso

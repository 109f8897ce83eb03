#include "surface/extract/pinch_separation.h"

#include <gtest/gtest.h>

#include "surface/extract/build_triangle_mesh.h"
#include "surface/extract/edge_positions.h"
#include "surface/intersection/self_intersection.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

// The surface of a tetrahedron, appended to a mesh; the first vertex is `apex`.
void append_tetrahedron(SurfaceMesh& mesh, const std::array<Vec3, 4>& corners) {
  const auto base = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
  for (const auto& t : {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}) {
    mesh.triangles.push_back({base + t[0], base + t[1], base + t[2]});
  }
}

const Box3 kBox{{-10, -10, -10}, {10, 10, 10}};

TEST(PinchSeparation, TetrahedraThatShareACornerNoLongerTouch) {
  SurfaceMesh mesh;
  append_tetrahedron(mesh, {Vec3{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 2}});
  append_tetrahedron(mesh, {Vec3{0, 0, 0}, {-1, 0, -1}, {0, -1, -1}, {-1, -1, -2}});
  ASSERT_GT(self_intersections(mesh.points, mesh.triangles).touching_pairs, 0);
  std::vector<VertexId> origin;
  for (const std::uint32_t v : {0u, 1u, 2u, 3u, 0u, 5u, 6u, 7u}) origin.emplace_back(v);
  const std::vector<PinchGroup> groups = {{{0, {}}, {4, {}}}};
  separate_pinches(mesh, groups, origin, kBox, kBox);
  const SelfIntersections found = self_intersections(mesh.points, mesh.triangles);
  EXPECT_EQ(found.crossing_pairs, 0);
  EXPECT_EQ(found.touching_pairs, 0);
  EXPECT_LT(norm(mesh.points[0]), 3e-4);
  EXPECT_LT(norm(mesh.points[4]), 3e-4);
}

TEST(PinchSeparation, NoCopyLeavesTheBoxOfTheSurface) {
  SurfaceMesh mesh;
  append_tetrahedron(mesh, {Vec3{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 2}});
  append_tetrahedron(mesh, {Vec3{0, 0, 0}, {-1, 0, 1}, {0, -1, 1}, {-1, -1, 2}});
  std::vector<VertexId> origin;
  for (const std::uint32_t v : {0u, 1u, 2u, 3u, 0u, 5u, 6u, 7u}) origin.emplace_back(v);
  const std::vector<PinchGroup> groups = {{{0, {}}, {4, {}}}};
  separate_pinches(mesh, groups, origin, kBox, Box3{{-10, -10, 0}, {10, 10, 10}});
  EXPECT_EQ(self_intersections(mesh.points, mesh.triangles).touching_pairs, 0);
  EXPECT_NE(mesh.points[0], mesh.points[4]);
  EXPECT_GE(mesh.points[0].z, 0);
  EXPECT_GE(mesh.points[4].z, 0);
}

// Two tetrahedra on either side of a common edge, both of whose ends are copies.
TEST(PinchSeparation, TetrahedraThatShareAnEdgeNoLongerTouch) {
  SurfaceMesh mesh;
  append_tetrahedron(mesh, {Vec3{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {1, 1, 0.5}});
  append_tetrahedron(mesh, {Vec3{0, 0, 0}, {0, 0, 1}, {-1, 0, 0.5}, {-1, -1, 0.5}});
  std::vector<VertexId> origin;
  for (const std::uint32_t v : {0u, 1u, 2u, 3u, 0u, 1u, 6u, 7u}) origin.emplace_back(v);
  const std::vector<PinchGroup> groups = {{{0, {}}, {4, {}}}, {{1, {}}, {5, {}}}};
  separate_pinches(mesh, groups, origin, kBox, kBox);
  const SelfIntersections found = self_intersections(mesh.points, mesh.triangles);
  EXPECT_EQ(found.crossing_pairs + found.touching_pairs, 0);
}

// A pyramid whose apex pierces an unrelated triangle, unless it starts from its other position.
TEST(PinchSeparation, AnotherPositionIsTakenWhereTheOwnIsBeyondAnUnrelatedTriangle) {
  SurfaceMesh mesh;
  mesh.points = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {-3, -3, 0.5}, {3, -3, 0.5}, {0, 3, 0.5}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 6, 7}};
  ASSERT_EQ(self_intersections(mesh.points, mesh.triangles).crossing_pairs, 4);
  std::vector<VertexId> origin;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) origin.emplace_back(v);
  separate_pinches(mesh, std::vector<PinchGroup>{{{0, {{0, 0, 0.8}, {0, 0, 0.2}}}}}, origin, kBox, kBox);
  EXPECT_EQ(self_intersections(mesh.points, mesh.triangles).crossing_pairs, 0);
  EXPECT_NEAR(mesh.points[0].z, 0.2, 1e-3);
}

TEST(PinchSeparation, OnABoxFaceCopiesStayOnIt) {
  SurfaceMesh mesh;
  append_tetrahedron(mesh, {Vec3{-10, 0, 0}, {-9, 1, 0}, {-9, 2, 1}, {-9, 1, 1}});
  append_tetrahedron(mesh, {Vec3{-10, 0, 0}, {-9, -1, 0}, {-9, -2, -1}, {-9, -1, -1}});
  std::vector<VertexId> origin;
  for (const std::uint32_t v : {0u, 1u, 2u, 3u, 0u, 5u, 6u, 7u}) origin.emplace_back(v);
  separate_pinches(mesh, std::vector<PinchGroup>{{{0, {}}, {4, {}}}}, origin, kBox, kBox);
  EXPECT_EQ(mesh.points[0].x, -10);
  EXPECT_EQ(mesh.points[4].x, -10);
  const SelfIntersections found = self_intersections(mesh.points, mesh.triangles);
  EXPECT_EQ(found.crossing_pairs + found.touching_pairs, 0);
}

// Wanted vertices move exactly as they do when all are wanted, whatever their neighbours in other pieces do.
TEST(PinchSeparation, WhatIsWantedMovesAsIfAllWere) {
  int stayed = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto scene = testing::noise_scene({8, 7, 6}, seed);
    BuiltMesh built = build_triangle_mesh(testing::dense(*scene));
    find_other_positions(built.groups, *scene->isosurface);
    const auto is_wanted = [&](std::uint32_t v) { return built.mesh.points[v].x < 2; };
    SurfaceMesh all = built.mesh;
    separate_pinches(all, built.groups, built.vertex_of, scene->isosurface->box(), scene->isosurface->box());
    SurfaceMesh some = built.mesh;
    separate_pinches(some, built.groups, built.vertex_of, scene->isosurface->box(), scene->isosurface->box(),
                     is_wanted);
    for (std::uint32_t v = 0; v < all.points.size(); ++v) {
      if (is_wanted(v)) {
        ASSERT_EQ(all.points[v], some.points[v]) << "seed " << seed << " vertex " << v;
      }
      stayed += all.points[v] != some.points[v] ? 1 : 0;
    }
  }
  EXPECT_GT(stayed, 0);
}

}  // namespace
}  // namespace deliso

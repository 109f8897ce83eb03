// Where distances are measured: also where the faces between voxel cells cut a triangle.
#include "surface/certificate/triangle_samples.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "surface/deliso.h"
#include "surface/verification/isosurface_probe.h"
#include "surface/verification/surface_distance.h"
#include "volume/fields/analytic_fields.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

std::vector<Vec3> crease_samples(const std::array<Vec3, 3>& corners, const Vec3& step) {
  std::vector<Vec3> samples;
  for_each_crease_sample(corners, step, [&](const Vec3& p) { samples.push_back(p); });
  return samples;
}

TEST(CreaseSamples, LieWhereCellFacesCutEdgesAndBetween) {
  // Only the face x = 2 is crossed; cells are twice as long in x.
  const std::vector<Vec3> samples =
      crease_samples({Vec3{1.5, 0.25, 0.5}, Vec3{2.5, 0.25, 0.5}, Vec3{2.5, 0.75, 0.5}}, {2, 1, 1});
  ASSERT_EQ(samples.size(), 6u);  // with the middles of edges
  for (const Vec3& expected : {Vec3{2, 0.25, 0.5}, Vec3{2, 0.5, 0.5}, Vec3{2, 0.375, 0.5}}) {
    EXPECT_TRUE(
        std::any_of(samples.begin(), samples.end(), [&](const Vec3& p) { return distance(p, expected) < 1e-12; }));
  }
}

TEST(CreaseSamples, HardlyMoveWithTheCorners) {
  // A corner on a face, an edge in a face, and a triangle in one: a hair to either side, as rounding brings it, there
  // are the same points but for some at corners.
  const std::vector<std::array<Vec3, 3>> triangles = {{Vec3{1, 0.2, 0.3}, Vec3{0.4, 0.7, 0.3}, Vec3{1.6, 0.9, 0.3}},
                                                      {Vec3{1, 0.2, 0.3}, Vec3{1, 0.7, 0.3}, Vec3{1.6, 0.9, 0.3}},
                                                      {Vec3{1, 0.2, 0.3}, Vec3{1, 0.7, 0.3}, Vec3{1, 0.9, 0.6}}};
  for (const std::array<Vec3, 3>& corners : triangles) {
    // In double and, as in STL, in single precision.
    for (int sides = 0; sides < 54; ++sides) {
      const double hair = sides < 27 ? 1e-13 : 1e-6;
      std::array<Vec3, 3> moved = corners;
      moved[0].x += hair * (sides % 3 - 1);
      moved[1].x += hair * (sides / 3 % 3 - 1);
      moved[2].x += hair * (sides / 9 % 3 - 1);
      const std::vector<Vec3> before = crease_samples(corners, {1, 1, 1}), after = crease_samples(moved, {1, 1, 1});
      const auto has = [&](const auto& points, const Vec3& p) {
        return std::any_of(points.begin(), points.end(),
                           [&](const Vec3& q) { return distance(p, q) < 10 * hair + 1e-9; });
      };
      for (const Vec3& p : before) EXPECT_TRUE(has(after, p) || has(corners, p)) << sides;
      for (const Vec3& p : after) EXPECT_TRUE(has(before, p) || has(corners, p)) << sides;
    }
  }
}

// Each triangle in squares of `parts` smaller ones.
TriangleMesh divided(const TriangleMesh& mesh, int parts) {
  TriangleMesh fine;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(fine.points.size());
    const auto at = [&](int i, int j) {
      return mesh.points[a] + double(i) / parts * (mesh.points[b] - mesh.points[a]) +
             double(j) / parts * (mesh.points[c] - mesh.points[a]);
    };
    std::uint32_t next = first;
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; i + j < parts; ++j) {
        for (const Vec3& p : {at(i, j), at(i + 1, j), at(i, j + 1)}) fine.points.push_back(p);
        fine.triangles.push_back({next, next + 1, next + 2});
        next += 3;
      }
    }
  }
  return fine;
}

// Measured at edges' middles and centroids alone, points beside creases were farther off by a third.
TEST(CreaseSamples, KeepAStatedErrorBetweenThemNearly) {
  const ScalarGrid grid = generate_field("torus", 24);
  const double isovalue = find_analytic_field("torus").isovalue;
  const IsosurfaceTopology truth = exact_topology(grid, isovalue);
  IsosurfaceProbe probe(grid, isovalue, truth.crossings);
  for (const double error : {0.05, 0.02}) {
    MeshingOptions options;
    options.parameters.size.max_error = error;
    const MeshingResult result = mesh_isosurface(grid, isovalue, options);
    EXPECT_TRUE(is_proven(result.certificate));
    EXPECT_LT(triangles_to_isosurface(divided(result.mesh, 6), probe).max_voxels, 1.12 * error);
  }
}

}  // namespace
}  // namespace deliso

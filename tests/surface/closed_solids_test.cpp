// Meshes of closed solids, labels and smoothed fields: against volumes known by formula, and against masks made by
// hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/deliso.h"
#include "surface/mesh/mesh_quality.h"
#include "surface/verification/verification.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/topology_mesh_check.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"
#include "volume/filters/gaussian.h"

namespace deliso {
namespace {

double enclosed_volume(const TriangleMesh& mesh) {
  double sum = 0;
  const Vec3 from = mesh.points.front();  // near the mesh: less rounding
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += dot(mesh.points[a] - from, cross(mesh.points[b] - from, mesh.points[c] - from)) / 6;
  }
  return sum;
}

// A proven, closed mesh within the box; what is within 1e-7 of a spacing of a face is on it. Returns how many
// vertices are on each face.
std::array<int, 6> expect_closed_in_box(const MeshingResult& result, const ScalarGrid& grid) {
  EXPECT_TRUE(is_proven(result.certificate));
  const auto facts = test::mesh_facts(result.mesh.triangles);
  EXPECT_EQ(facts.defect, "");
  EXPECT_TRUE(facts.boundary.empty());
  std::array<int, 6> on_face{};
  const Box3 box = grid.box();
  for (const Vec3& p : result.mesh.points) {
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_GE(p[a], box.low[a]);
      EXPECT_LE(p[a], box.high[a]);
      const double near = 1e-7 * grid.spacing()[a];
      EXPECT_TRUE(p[a] == box.low[a] || p[a] > box.low[a] + near);
      EXPECT_TRUE(p[a] == box.high[a] || p[a] < box.high[a] - near);
      on_face[2 * a] += p[a] == box.low[a] ? 1 : 0;
      on_face[2 * a + 1] += p[a] == box.high[a] ? 1 : 0;
    }
  }
  return on_face;
}

void expect_verified(const MeshingResult& result, const ScalarGrid& grid, double isovalue, const Parameters& p) {
  const MeshedField field = meshed_field(grid, isovalue, p.field, p.boundary == Boundary::kClosed, grid.spacing(), 1);
  TriangleMesh mesh = result.mesh;
  if (p.field.invert) {
    for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  }
  const Verification v = verify_mesh(mesh, field.grid, field.isovalue);
  EXPECT_TRUE(v.proven);
  for (const std::string& failure : v.failures) ADD_FAILURE() << failure;
  EXPECT_EQ(v.boundary.outside_vertices, 0);
}

MeshingOptions closed() {
  MeshingOptions options;
  options.parameters.boundary = Boundary::kClosed;
  return options;
}

// Copies of a vertex were moved apart to either side of a wall, where triangles came to cross when written; marching
// cubes took their place, with triangles of no area.
TEST(ClosedSolids, OfRandomSamplesNeedNoFinerCubesAndHaveGoodAngles) {
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    Rng rng(seed);
    const Dims dims{9, 8, 10};
    const std::uint64_t values = seed % 3 == 0 ? 2 : (seed % 3 == 1 ? 4 : 256);
    std::vector<std::uint8_t> samples(9 * 8 * 10);
    for (auto& s : samples) s = static_cast<std::uint8_t>(rng.below(values));
    const ScalarGrid grid(dims, std::move(samples));
    const MeshingResult result = mesh_isosurface(grid, static_cast<double>(values - 1) / 2, closed());
    EXPECT_TRUE(is_proven(result.certificate)) << seed;
    // Of those given up only the large one has no mesh of its own.
    EXPECT_EQ(result.repair.components_polygonized, result.repair.components_given_up > 0 ? 1 : 0) << seed;
    EXPECT_GT(measure_quality(result.mesh).min_angle_degrees, 1) << seed;
  }
}

TEST(ClosedSolids, OfOnesAreTheBox) {
  MeshingOptions options = closed();
  options.parameters.r_min_of = RMinOf::kBox;  // edges of the box are cut by less than a hundredth of a voxel
  for (const auto& [spacing, origin] :
       {std::pair(Vec3{1, 1, 1}, Vec3{0, 0, 0}), {Vec3{0.1, 0.3, 0.7}, {0.1, -7, 1e4}}}) {
    for (const double isovalue : {0.5, 1.0}) {
      const ScalarGrid grid({5, 6, 4}, std::vector<std::uint8_t>(120, 1), spacing, origin);
      const MeshingResult result = mesh_isosurface(grid, isovalue, options);
      for (const int count : expect_closed_in_box(result, grid)) EXPECT_GT(count, 3);
      const double volume = 4 * 5 * 3 * spacing.x * spacing.y * spacing.z;
      EXPECT_NEAR(enclosed_volume(result.mesh) / volume, 1, 0.005);
      for (const Vec3& p : result.mesh.points) {
        const Vec3 low = p - grid.box().low, high = p - grid.box().high;
        EXPECT_EQ(low.x * low.y * low.z * high.x * high.y * high.z, 0);
      }
      EXPECT_LE(enclosed_volume(result.mesh), volume * (1 + 1e-9));
      expect_verified(result, grid, isovalue, options.parameters);
    }
  }
}

// A signed distance, negative inside: a ball of radius 1.2 cut by the cube from -1 to 1.
TEST(ClosedSolids, OfASignedDistanceIsTheCappedBallWhenInverted) {
  constexpr double kRadius = 1.2, kPi = std::numbers::pi;
  const ScalarGrid grid = testing::sampled({33, 33, 33}, [](const Vec3& p) { return norm(p) - kRadius; },
                                           {0.0625, 0.0625, 0.0625}, {-1, -1, -1});
  const double cap = kPi * 0.2 * 0.2 * (3 * kRadius - 0.2) / 3;
  const double ball = 4 * kPi / 3 * kRadius * kRadius * kRadius - 6 * cap;
  MeshingOptions options = closed();
  options.parameters.stage2.max_distance = 0.1;
  options.parameters.field.invert = true;
  const MeshingResult inside = mesh_isosurface(grid, 0, options);
  for (const int count : expect_closed_in_box(inside, grid)) EXPECT_GT(count, 10);
  EXPECT_NEAR(enclosed_volume(inside.mesh) / ball, 1, 0.01);
  expect_verified(inside, grid, 0, options.parameters);
  // The other side is what is left of the cube: a frame along its twelve edges, which the ball does not reach.
  options.parameters.field.invert = false;
  const MeshingResult outside = mesh_isosurface(grid, 0, options);
  expect_closed_in_box(outside, grid);
  ASSERT_EQ(outside.certificate.mesh.size(), 1u);
  EXPECT_EQ(outside.certificate.mesh.front().topology, (ComponentTopology{-8, 0}));
  EXPECT_EQ(outside.certificate.mesh.front().count, 1);
  EXPECT_NEAR(enclosed_volume(outside.mesh) / (8 - ball), 1, 0.05);
  expect_verified(outside, grid, 0, options.parameters);
}

TEST(ClosedSolids, OfNoiseAreProvenOnBothSides) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    std::vector<std::uint8_t> samples(150);
    for (std::uint8_t& sample : samples) sample = static_cast<std::uint8_t>(rng.below(seed % 2 == 0 ? 256 : 3));
    const ScalarGrid grid({5, 6, 5}, std::move(samples), {1, 0.8, 1.5}, {0.3, 0, -2});
    for (const bool invert : {false, true}) {
      MeshingOptions options = closed();
      options.parameters.field.invert = invert;
      const double isovalue = seed % 2 == 0 ? 127.5 : 1;
      const MeshingResult result = mesh_isosurface(grid, isovalue, options);
      expect_closed_in_box(result, grid);
      EXPECT_GT(enclosed_volume(result.mesh), 0);
      expect_verified(result, grid, isovalue, options.parameters);
    }
  }
}

TEST(MeshedFields, InvertedFaceTheOtherWayAndAreElseTheSame) {
  const ScalarGrid grid = generate_field("torus", 20);
  const double isovalue = find_analytic_field("torus").isovalue;
  MeshingOptions options;
  const MeshingResult plain = mesh_isosurface(grid, isovalue, options);
  options.parameters.field.invert = true;
  const MeshingResult inverted = mesh_isosurface(grid, isovalue, options);
  EXPECT_TRUE(is_proven(inverted.certificate));
  EXPECT_EQ(plain.mesh.points, inverted.mesh.points);
  ASSERT_EQ(plain.mesh.triangles.size(), inverted.mesh.triangles.size());
  EXPECT_NEAR(enclosed_volume(plain.mesh), -enclosed_volume(inverted.mesh), 1e-9 * enclosed_volume(plain.mesh));
}

// Two boxes that touch, labels 1 and 3 in zeros.
ScalarGrid two_labels() {
  std::vector<std::uint8_t> samples;
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 12; ++i) {
        const bool inside = std::min({i, j, k}) >= 2 && std::max({i, j, k}) <= 9;
        samples.push_back(!inside ? 0 : i < 6 ? 1 : 3);
      }
  return {{12, 12, 12}, std::move(samples), {1, 1, 2}};
}

TEST(MeshedFields, LabelsAreMeshedAsMasksMadeByHand) {
  const ScalarGrid grid = two_labels();
  for (const std::int32_t label : {1, 3}) {
    std::vector<float> by_hand;
    visit_samples(grid.samples(), [&](const auto& samples) {
      for (const auto sample : samples) by_hand.push_back(static_cast<double>(sample) == label ? 1.0f : 0.0f);
    });
    const ScalarGrid mask(grid.dims(), std::move(by_hand), grid.spacing());
    MeshingOptions options;
    const MeshingResult expected = mesh_isosurface(mask, 0.5, options);
    options.parameters.field.label = label;
    const MeshingResult found = mesh_isosurface(grid, 12345, options);
    EXPECT_EQ(found.mesh.points, expected.mesh.points);
    EXPECT_EQ(found.mesh.triangles, expected.mesh.triangles);
    EXPECT_TRUE(is_proven(found.certificate));
  }
}

TEST(MeshedFields, SmoothedAreMeshedAsTheSmoothedVolume) {
  const ScalarGrid grid = two_labels();
  const ScalarGrid by_hand = smoothed(grid, {1.5, 1.5, 0.75}, 1);
  MeshingOptions options;
  const MeshingResult expected = mesh_isosurface(by_hand, 0.5, options);
  options.parameters.field.smooth = 1.5;
  for (const std::int32_t threads : {1, 3}) {
    options.threads = threads;
    const MeshingResult found = mesh_isosurface(grid, 0.5, options);
    EXPECT_EQ(found.mesh.points, expected.mesh.points);
    EXPECT_EQ(found.mesh.triangles, expected.mesh.triangles);
  }
}

// A mask of a ball, 0 and 255: without its steps a few hundred vertices do, and they lie on the ball.
TEST(MeshedFields, ASmoothedBallNeedsFewVertices) {
  constexpr double kRadius = 18;
  std::vector<std::uint8_t> samples;
  for (int k = 0; k < 44; ++k)
    for (int j = 0; j < 44; ++j)
      for (int i = 0; i < 44; ++i) {
        const Vec3 p{i - 21.5, j - 21.5, k - 21.5};
        samples.push_back(norm(p) <= kRadius ? 255 : 0);
      }
  const ScalarGrid grid({44, 44, 44}, std::move(samples));
  MeshingOptions options;
  options.parameters.field.smooth = 1;
  const MeshingResult result = mesh_isosurface(grid, 127.5, options);
  EXPECT_TRUE(is_proven(result.certificate));
  EXPECT_LT(result.mesh.points.size(), 1000u);
  for (const Vec3& p : result.mesh.points) EXPECT_NEAR(norm(p - Vec3{21.5, 21.5, 21.5}), kRadius, 0.5);
  expect_verified(result, grid, 127.5, options.parameters);
}

}  // namespace
}  // namespace deliso

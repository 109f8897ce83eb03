#include "surface/verification/surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/mesh/triangle_distance.h"
#include "tests/support/mesh_examples.h"
#include "tests/support/mesh_fields.h"

namespace deliso {
namespace {

TEST(PointTriangleDistance, AgreesWithDenseSampling) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    const auto random_point = [&rng] { return Vec3{rng.uniform(), rng.uniform(), rng.uniform()}; };
    const Vec3 a = random_point(), b = random_point(), p = 2.0 * random_point();
    // Every fourth triangle is degenerate: collinear or a single point.
    const Vec3 c = seed % 8 == 0 ? a + 0.3 * (b - a) : seed % 8 == 4 ? a : random_point();
    constexpr int kOrder = 150;
    double sampled = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kOrder; ++i) {
      for (int j = 0; i + j <= kOrder; ++j) {
        sampled = std::min(sampled, distance(p, (i * a + j * b + (kOrder - i - j) * c) / double(kOrder)));
      }
    }
    const double found = std::sqrt(squared_distance_to_triangle(p, a, b, c));
    EXPECT_LE(found, sampled + 1e-12) << "seed " << seed;
    EXPECT_GE(found, sampled - 1.8 / kOrder) << "seed " << seed;
    // The verification measures with a formula of its own.
    const TriangleMesh alone{{a, b, c}, {{0, 1, 2}}};
    EXPECT_NEAR(points_to_mesh(std::vector<Vec3>{p}, alone, 99).max_voxels, found, 1e-9) << "seed " << seed;
  }
}

TEST(PointsToMesh, AgreesWithTestingEveryTriangle) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const TriangleMesh mesh = testing::random_soup(rng, 50, 80);
    std::vector<Vec3> points = testing::random_soup(rng, 100, 0).points;
    double largest = 0, sum = 0;
    Vec3 worst;
    for (Vec3& p : points) {
      p = 3.0 * p - Vec3{1, 1, 1};
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& [a, b, c] : mesh.triangles) {
        nearest = std::min(nearest, squared_distance_to_triangle(p, mesh.points[a], mesh.points[b], mesh.points[c]));
      }
      nearest = std::sqrt(nearest);
      sum += nearest;
      if (nearest > largest) {
        largest = nearest;
        worst = p;
      }
    }
    const DistanceFigure found = points_to_mesh(points, mesh, 99);
    EXPECT_NEAR(found.max_voxels, largest, 1e-12) << "seed " << seed;
    EXPECT_EQ(found.worst, worst) << "seed " << seed;
    EXPECT_NEAR(found.mean_voxels, sum / 100, 1e-12) << "seed " << seed;
  }
  EXPECT_EQ(points_to_mesh(std::vector<Vec3>{{1, 2, 3}}, {}, 99).max_voxels, 99);
}

// Trilinear interpolation reproduces linear fields, whose isosurface is a plane.
TEST(IsosurfaceProbe, KnowsTheDistanceToAPlane) {
  const Vec3 slope{0.3, -0.2, 1};
  const auto height = [&](const Vec3& p) { return dot(slope, p) - 6.137; };
  const ScalarGrid grid = testing::sampled({13, 12, 14}, height);
  const IsosurfaceTopology truth = exact_topology(grid, 0);
  IsosurfaceProbe probe(grid, 0, truth.crossings);
  Rng rng(1);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p{rng.uniform(4, 8), rng.uniform(4, 8), rng.uniform(2, 11)};
    const FootPoint foot = probe.foot_point(p);
    const double expected = std::abs(height(p)) / norm(slope);
    if (expected < 1.9) {
      EXPECT_NEAR(foot.distance, expected, 1e-12) << "point " << i;
    } else {  // beyond the reach of a walk: the nearest grid-edge crossing
      EXPECT_GE(foot.distance, expected - 1e-12) << "point " << i;
      EXPECT_LE(foot.distance, expected + 0.6) << "point " << i;
    }
  }
}

// On any field: the foot is a point of the isosurface in the box, at the distance that is claimed; and hardly any other
// point is nearer: those where lines through a finer grid cross it.
TEST(IsosurfaceProbe, FindsPointsOfTheIsosurfaceAndHardlyMissesNearerOnes) {
  const auto wavy = [](const Vec3& p) { return std::sin(0.5 * p.x) + std::cos(0.45 * p.y) * std::sin(0.4 * p.z); };
  const ScalarGrid grid = testing::sampled({12, 11, 10}, wavy, {1, 1.25, 2}, {3, -2, 5});
  const double isovalue = 0.123;
  const IsosurfaceTopology truth = exact_topology(grid, isovalue);
  IsosurfaceProbe probe(grid, isovalue, truth.crossings);
  const Vec3 size = probe.box().size();

  std::vector<Vec3> cloud;
  constexpr double kStep = 0.1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (double s = 0; s <= size[u]; s += kStep) {
      for (double t = 0; t <= size[v]; t += kStep) {
        Vec3 p;
        p[u] = s;
        p[v] = t;
        double before = probe.value(p);
        for (double r = kStep; r <= size[axis]; r += kStep) {
          p[axis] = r;
          const double after = probe.value(p);
          if ((before < 0) != (after < 0)) {
            Vec3 root = p;
            root[axis] -= kStep * after / (after - before);
            cloud.push_back(root);
          }
          before = after;
        }
      }
    }
  }
  Rng rng(2);
  double sum_of_excess = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = scaled(size, {rng.uniform(), rng.uniform(), rng.uniform()});
    const FootPoint foot = probe.foot_point(p);
    EXPECT_LT(std::abs(probe.value(foot.point)), 1e-9) << "point " << i;
    EXPECT_TRUE(probe.box().contains(foot.point)) << "point " << i;
    EXPECT_NEAR(foot.distance, distance(p, foot.point), 1e-15) << "point " << i;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& q : cloud) nearest = std::min(nearest, squared_distance(p, q));
    nearest = std::sqrt(nearest);
    const double excess = foot.distance - nearest;
    EXPECT_LT(excess, nearest < 0.4 ? 0.06 : 0.4) << "point " << i << " at distance " << nearest;
    sum_of_excess += std::max(0.0, excess);
  }
  EXPECT_LT(sum_of_excess / 300, 0.05);
}

// Noise makes a crease of nearly every grid face and edge, where one cell's gradient is no guide to its neighbour.
TEST(IsosurfaceProbe, StaysOnTheSurfaceAtCreases) {
  Rng rng(4);
  const ScalarGrid grid = testing::sampled({14, 14, 14}, [&rng](const Vec3&) { return double(rng.below(256)); });
  const IsosurfaceTopology truth = exact_topology(grid, 100.1);
  IsosurfaceProbe probe(grid, 100.1, truth.crossings);
  double largest = 0;
  for (const Vec3& p : probe.crossing_points()) largest = std::max(largest, probe.foot_point(p).distance);
  EXPECT_LT(largest, 1e-10);
}

// Two sheets that meet at a sharp crease in the saddle of a grid face. Away from the face the values rise to both
// sides, so two of the four quarters around the saddle are empty, and no line from there leads into the wedges.
TEST(IsosurfaceProbe, LeadsBackToTheSaddleOfAFace) {
  const ScalarGrid grid({2, 2, 3}, std::vector<double>{131, 128, 129, 131, 130, 127, 128, 130, 131, 128, 129, 131});
  const double isovalue = 128.8;
  const IsosurfaceTopology topology = exact_topology(grid, isovalue);
  IsosurfaceProbe probe(grid, isovalue, topology.crossings);
  const Vec3 saddle{0.4, 0.6, 1};
  ASSERT_LT(std::abs(probe.value(saddle)), 1e-12);
  for (const double side : {1.0, -1.0}) {
    const Vec3 p = saddle + Vec3{1e-4 * side, 1.4e-4 * side, -1e-5};
    ASSERT_GT(probe.value(p), 0);
    EXPECT_LT(probe.foot_point(p).distance, 1.8e-4) << side;
  }
}

// The values fall steeply behind a grid face, gently in front of it. So the surface close behind the face is nearer
// than the one to which the gradient in front of it leads.
TEST(IsosurfaceProbe, LooksAcrossAFaceWhereTheGradientTurns) {
  const ScalarGrid grid({2, 2, 3},
                        std::vector<double>{-0.22, -0.22, -0.22, -0.22, 1e-4, 3e-4, 3e-4, 5e-4, -8, -8, -8, -8});
  const IsosurfaceTopology topology = exact_topology(grid, 0);
  IsosurfaceProbe probe(grid, 0, topology.crossings);
  EXPECT_LT(probe.foot_point({0.5, 0.5, 1 - 2e-5}).distance, 6e-5);
}

// Whether both sides have points in the cube of this half width around p: of its corners, the middles of its edges and
// faces, and the same moved onto grid faces.
template <class IsBelow>
bool has_both_sides_within(IsBelow is_below, const Box3& box, const Vec3& p, double half) {
  int below = 0;
  for (int i = 0; i < 64; ++i) {
    Vec3 q = p;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int place = i >> (2 * axis) & 3;
      const double face = std::round(p[axis]);
      if (place == 3 && std::abs(face - p[axis]) <= half) q[axis] = face;
      if (place < 3) q[axis] += (place - 1) * half;
    }
    below += is_below(box.clamp(q)) ? 1 : 0;
  }
  return below > 0 && below < 64;
}

// Samples of mixed magnitudes: the surface keeps close to grid faces and edges, in layers that a walk steps over.
// Points strewn around, with values summed up in another way, say how near it is at least.
TEST(IsosurfaceProbe, FindsTheNearestPointBetweenSamplesOfMixedMagnitudes) {
  int missed_by_walks = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const ScalarGrid grid = testing::sampled({3, 3, 3}, [&rng](const Vec3&) {
      return (rng.below(2) == 0 ? -1.0 : 1.0) * std::pow(10.0, rng.uniform(-6, 6));
    });
    const auto is_below = [&](const Vec3& p) {
      const auto low = [](double x) { return std::min(static_cast<std::int32_t>(x), 1); };
      const CellCorners corners = grid.cell(low(p.x), low(p.y), low(p.z));
      long double sum = 0;
      for (unsigned corner = 0; corner < 8; ++corner) {
        long double weight = 1;
        for (unsigned axis = 0; axis < 3; ++axis) {
          const long double t = static_cast<long double>(p[axis]) - low(p[axis]);
          weight *= (corner >> axis & 1u) != 0 ? t : 1 - t;
        }
        sum += weight * corners[corner];
      }
      return sum < 0;
    };
    const IsosurfaceTopology truth = exact_topology(grid, 0);
    IsosurfaceProbe probe(grid, 0, truth.crossings);
    for (int i = 0; i < 20; ++i) {
      const Vec3 p{1 + std::pow(10.0, rng.uniform(-4, -1)), rng.uniform(0, 2), rng.uniform(0, 2)};
      double nearest = 0.25;
      for (int j = 0; j < 2000; ++j) {
        const double reach = std::pow(10.0, rng.uniform(-4, -0.6));
        const Vec3 q = probe.box().clamp(p + reach * Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)});
        if (is_below(q) != is_below(p)) nearest = std::min(nearest, distance(p, q));
      }
      const FootPoint foot = probe.nearest_point(p);
      EXPECT_NEAR(foot.distance, distance(p, foot.point), 1e-15) << "seed " << seed << " point " << i;
      if (nearest == 0.25) continue;
      EXPECT_TRUE(has_both_sides_within(is_below, probe.box(), foot.point, 1e-9)) << "seed " << seed << " point " << i;
      EXPECT_LE(foot.distance, std::max(1e-4, nearest / 0.6)) << "seed " << seed << " point " << i;
      if (probe.foot_point(p).distance > 2 * nearest) ++missed_by_walks;
    }
  }
  EXPECT_GT(missed_by_walks, 0);
}

TEST(TrianglesToIsosurface, SeesTheSagittaOfAChord) {
  // Great-circle edges of an octahedron inscribed in a ball: the face centres are farthest in.
  const double radius = 6.03;
  const ScalarGrid grid = testing::sampled({17, 17, 17}, testing::ball_field({8, 8, 8}, radius));
  const IsosurfaceTopology truth = exact_topology(grid, 0);
  IsosurfaceProbe probe(grid, 0, truth.crossings);
  const TriangleMesh mesh = testing::on_isosurface(testing::sphere_mesh(0, radius, {8, 8, 8}), grid, 0);
  EXPECT_LT(vertices_to_isosurface(mesh, vertex_distances(mesh, probe)).max_voxels, 1e-12);
  const DistanceFigure figure = triangles_to_isosurface(mesh, probe);
  EXPECT_NEAR(figure.max_voxels, radius * (1 - 1 / std::sqrt(3.0)), 0.1);
  EXPECT_LT(figure.mean_voxels, figure.max_voxels);
  EXPECT_NEAR(distance(figure.worst, {8, 8, 8}), radius / std::sqrt(3.0), 0.3);
}

}  // namespace
}  // namespace deliso

#include "surface/repair/finish/inverted_umbrellas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "surface/certificate/certificate.h"
#include "surface/certificate/exact_polygonization.h"
#include "surface/intersection/self_intersection.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/verification/surface_distance.h"
#include "tests/support/mesh_examples.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::Scene;

const Vec3 kCenter{7.1, 6.9, 7.2};
constexpr double kRadius = 4.3;

Scene ball() { return {"ball", testing::sampled({15, 15, 15}, testing::ball_field(kCenter, kRadius)), 0}; }

// A coarse mesh of the ball's surface. Every vertex and triangle has an opposite one.
SurfaceMesh sphere(const Scene& scene, int levels) {
  const TriangleMesh on = testing::on_isosurface(testing::sphere_mesh(levels, kRadius, kCenter), scene.grid, 0);
  SurfaceMesh mesh{on.points, std::vector<double>(on.points.size(), kRadius), on.triangles, {}};
  set_side_adjacency(mesh);
  return mesh;
}

std::uint32_t opposite(const SurfaceMesh& mesh, std::uint32_t v) {
  const Vec3 wanted = 2 * kCenter - mesh.points[v];
  const auto nearest = std::min_element(mesh.points.begin(), mesh.points.end(), [&](const Vec3& p, const Vec3& q) {
    return squared_distance(p, wanted) < squared_distance(q, wanted);
  });
  return static_cast<std::uint32_t>(nearest - mesh.points.begin());
}

// A point just inside of a vertex, like the copy of the vertex that has an inverted umbrella.
Vec3 inside_of(const Vec3& p) { return p + 2e-4 / distance(p, kCenter) * (kCenter - p); }

// Closed, of sphere topology, without crossings, and near the isosurface's points on grid edges.
void expect_good_sphere(const SurfaceMesh& mesh, const Scene& scene, std::uint32_t trial) {
  EXPECT_EQ(testing::surface_mesh_defect(mesh), "") << trial;
  const TriangleMesh triangles{mesh.points, mesh.triangles};
  EXPECT_EQ(component_topologies(triangles), (std::vector<ComponentTopology>{{2, 0}})) << trial;
  const SelfIntersections found = self_intersections(triangles);
  EXPECT_EQ(found.crossing_pairs + found.touching_pairs, 0) << trial;
  EXPECT_LT(points_to_mesh(testing::crossing_points(scene), triangles, 100).max_voxels, 0.6) << trial;
}

TEST(InvertedUmbrellas, ATriangleDrawnThroughABodyComesBack) {
  const Scene scene = ball();
  const SurfaceMesh whole = sphere(scene, 2);
  for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) {
    SurfaceMesh mesh = whole;
    const auto [a, b, c] = whole.triangles[t];
    const auto apex = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(inside_of(whole.points[opposite(whole, a)]));
    mesh.pole_heights.push_back(1);
    mesh.triangles[t] = {a, b, apex};
    mesh.triangles.push_back({b, c, apex});
    mesh.triangles.push_back({c, a, apex});
    set_side_adjacency(mesh);
    ASSERT_EQ(remove_inverted_umbrellas(mesh, *scene.isosurface), 1) << t;
    expect_good_sphere(mesh, scene, t);
    EXPECT_EQ(mesh.points, whole.points) << t;
    EXPECT_EQ(mesh.pole_heights, whole.pole_heights) << t;
    const auto names = [](const SurfaceMesh& m) {
      std::multiset<std::set<std::uint32_t>> sets;
      for (const auto& v : m.triangles) sets.insert({v.begin(), v.end()});
      return sets;
    };
    EXPECT_EQ(names(mesh), names(whole)) << t;
  }
}

// Draws triangle t to a point, with a new vertex there.
void draw(SurfaceMesh& mesh, std::uint32_t t, const Vec3& to) {
  const auto [a, b, c] = mesh.triangles[t];
  const auto apex = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(to);
  mesh.pole_heights.push_back(1);
  mesh.triangles[t] = {a, b, apex};
  mesh.triangles.push_back({b, c, apex});
  mesh.triangles.push_back({c, a, apex});
}

// Two that run side by side, end in each other's base, or share all but a corner: neither keeps the other.
TEST(InvertedUmbrellas, TwoThatInteractBothGo) {
  const Scene scene = ball();
  const SurfaceMesh whole = sphere(scene, 2);
  for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) {
    std::set<std::uint32_t> across;
    for (const std::uint32_t v : whole.triangles[t]) across.insert(opposite(whole, v));
    for (std::uint32_t other = 0; other < whole.triangles.size(); ++other) {
      const auto& corners = whole.triangles[other];
      const std::set<std::uint32_t> of_other(corners.begin(), corners.end());
      const bool is_opposite = of_other == across;
      const bool is_neighbour = std::any_of(whole.neighbours[t].begin(), whole.neighbours[t].end(),
                                            [&](TriangleSide side) { return side >> 2 == other; });
      if (!is_opposite && !is_neighbour) continue;
      SurfaceMesh mesh = whole;
      draw(mesh, t, inside_of(whole.points[opposite(whole, whole.triangles[t][0])]));
      draw(mesh, other, inside_of(whole.points[opposite(whole, corners[1])]));
      set_side_adjacency(mesh);
      ASSERT_EQ(remove_inverted_umbrellas(mesh, *scene.isosurface), 2) << t << " and " << other;
      expect_good_sphere(mesh, scene, t);
      EXPECT_EQ(mesh.points, whole.points) << t << " and " << other;
    }
  }
}

TEST(InvertedUmbrellas, AVertexDrawnThroughABodyGoes) {
  const Scene scene = ball();
  const SurfaceMesh whole = sphere(scene, 2);
  for (std::uint32_t v = 0; v < whole.points.size(); ++v) {
    SurfaceMesh mesh = whole;
    mesh.points[v] = inside_of(whole.points[opposite(whole, v)]);
    ASSERT_EQ(remove_inverted_umbrellas(mesh, *scene.isosurface), 1) << v;
    EXPECT_EQ(mesh.points.size(), whole.points.size() - 1) << v;
    expect_good_sphere(mesh, scene, v);
  }
}

TEST(InvertedUmbrellas, ARidgeGoesVertexByVertex) {
  const Scene scene = ball();
  const SurfaceMesh whole = sphere(scene, 3);
  for (std::uint32_t t = 0; t < whole.triangles.size(); t += 7) {
    SurfaceMesh mesh = whole;
    for (const std::uint32_t v : {whole.triangles[t][0], whole.triangles[t][1]}) {
      mesh.points[v] = inside_of(whole.points[opposite(whole, v)]);
    }
    // Vertices at the foot of the ridge may be removed, too.
    const std::int64_t removed = remove_inverted_umbrellas(mesh, *scene.isosurface);
    EXPECT_TRUE(removed >= 2 && removed <= 4) << removed << " of " << t;
    expect_good_sphere(mesh, scene, t);
  }
}

TEST(InvertedUmbrellas, VerticesThatNothingElseCoversStay) {
  const Scene scene = ball();
  const SurfaceMesh whole = sphere(scene, 2);
  SurfaceMesh untouched = whole;
  EXPECT_EQ(remove_inverted_umbrellas(untouched, *scene.isosurface), 0);
  EXPECT_EQ(untouched.triangles, whole.triangles);
  EXPECT_EQ(untouched.points, whole.points);
  for (std::uint32_t v = 0; v < whole.points.size(); ++v) {
    SurfaceMesh mesh = whole;
    // Half a voxel short of the other side.
    const Vec3 there = whole.points[opposite(whole, v)];
    mesh.points[v] = there + 0.5 / distance(there, kCenter) * (kCenter - there);
    EXPECT_EQ(remove_inverted_umbrellas(mesh, *scene.isosurface), 0) << v;
    EXPECT_EQ(mesh.triangles, whole.triangles) << v;
  }
}

TEST(InvertedUmbrellas, NothingGoesWhereAnotherPieceIsInTheWay) {
  const Scene scene = ball();
  const SurfaceMesh whole = sphere(scene, 2);
  for (std::uint32_t v = 0; v < whole.points.size(); ++v) {
    SurfaceMesh mesh = whole;
    const Vec3 there = whole.points[v];
    mesh.points[v] = inside_of(whole.points[opposite(whole, v)]);
    // A small tetrahedron, beside the cone, that crosses the filling.
    const TriangleMesh small = testing::tetrahedron_mesh();
    const auto base = static_cast<std::uint32_t>(mesh.points.size());
    const Vec3 out = (there - kCenter) / distance(there, kCenter);
    Vec3 centroid;
    double corners = 0;
    for (const auto& t : whole.triangles) {
      if (std::find(t.begin(), t.end(), v) == t.end()) continue;
      for (const std::uint32_t w : t) {
        if (w == v) continue;
        centroid += whole.points[w];
        corners += 1;
      }
    }
    centroid = centroid / corners;
    for (const Vec3& p : small.points) mesh.points.push_back(centroid + 0.15 * (p - Vec3{0.25, 0.25, 0.25}));
    mesh.points[base] += 0.6 * out;
    mesh.points[base + 1] += -0.6 * out;
    for (const auto& t : small.triangles) mesh.triangles.push_back({base + t[0], base + t[1], base + t[2]});
    mesh.pole_heights.resize(mesh.points.size(), 1);
    set_side_adjacency(mesh);
    const auto before = mesh.triangles;
    const std::int64_t removed = remove_inverted_umbrellas(mesh, *scene.isosurface);
    EXPECT_EQ(removed, 0) << v;
    EXPECT_EQ(mesh.triangles, before) << v;
  }
}

// Also for bad meshes: here a good mesh in which some vertices are moved to others at random.
TEST(InvertedUmbrellas, TopologyStaysAndNoCrossingsCome) {
  std::int64_t removed = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto scene = testing::noise_scene({9, 8, 9}, seed);
    SurfaceMesh mesh = exact_polygonization(scene->surface()).mesh;
    Rng rng(seed);
    for (Vec3& p : mesh.points) {
      if (rng.uniform() > 0.05) continue;
      const Vec3 other = mesh.points[static_cast<std::size_t>(rng.uniform() * double(mesh.points.size()))];
      if (distance(other, p) < 4) p = other + 1e-4 * Vec3{rng.uniform(), rng.uniform(), rng.uniform()};
    }
    const TriangleMesh before{mesh.points, mesh.triangles};
    removed += remove_inverted_umbrellas(mesh, *scene->isosurface);
    const TriangleMesh after{mesh.points, mesh.triangles};
    EXPECT_EQ(testing::surface_mesh_defect(mesh), "") << "seed " << seed;
    EXPECT_EQ(component_topologies(after), component_topologies(before)) << "seed " << seed;
    EXPECT_LE(self_intersections(after).crossing_pairs, self_intersections(before).crossing_pairs) << "seed " << seed;
  }
  EXPECT_GT(removed, 20);
}

}  // namespace
}  // namespace deliso

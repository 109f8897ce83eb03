// The crossings that no triangle is near, against all distances.
#include "surface/certificate/far_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "delaunay/base/rng.h"
#include "surface/certificate/exact_polygonization.h"
#include "surface/mesh/triangle_distance.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

double squared_distance_to(const Vec3& p, const SurfaceMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles) {
    least = std::min(least, squared_distance_to_triangle(p, mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  return least;
}

// Meshes with holes, made of triangles both smaller and larger than the reach.
TEST(FarCrossings, AreThoseThatNoTriangleIsNear) {
  Rng rng(5);
  std::size_t far = 0, all = 0;
  for (const auto& scene : {testing::field_scene("gyroid", 14), testing::noise_scene({7, 8, 6}, 3)}) {
    SCOPED_TRACE(scene->name);
    const SurfaceMesh whole = exact_polygonization(scene->surface()).mesh;
    for (const double reach : {0.1, 0.3, 0.5, 1.0, 2.5}) {
      for (const double kept : {0.0, 0.03, 0.3, 0.9}) {
        SurfaceMesh mesh = whole;
        std::erase_if(mesh.triangles, [&](const auto&) { return rng.uniform() > kept; });
        if (kept == 0) mesh.triangles.push_back({0, static_cast<std::uint32_t>(mesh.points.size() / 2), 1});
        std::vector<std::uint32_t> long_triangles;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
          const double longest = kLongEdge * reach;
          if (squared_longest_edge(mesh, t) > longest * longest) long_triangles.push_back(t);
        }
        std::vector<std::uint32_t> expected, asked, expected_of_asked;
        const ExactSurface surface = scene->surface();
        for (std::uint32_t i = 0; i < surface.topology.crossings.size(); ++i) {
          const bool is_asked = rng.below(3) == 0;
          if (is_asked) asked.push_back(i);
          if (squared_distance_to(surface.position(surface.topology.crossings[i]), mesh) <= reach * reach) continue;
          expected.push_back(i);
          if (is_asked) expected_of_asked.push_back(i);
        }
        far += expected.size();
        all += surface.topology.crossings.size();
        for (const int threads : {1, 3}) {
          const MeshPoints points(mesh, reach, long_triangles);
          EXPECT_EQ(far_crossings(points, scene->surface(threads)), expected) << reach << ' ' << kept;
          EXPECT_EQ(far_crossings(points, scene->surface(threads), asked), expected_of_asked) << reach << ' ' << kept;
        }
      }
    }
  }
  EXPECT_GT(far, all / 20);
  EXPECT_LT(far, all * 19 / 20);
}

}  // namespace
}  // namespace deliso

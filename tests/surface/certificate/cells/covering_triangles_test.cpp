// Triangles that cover a hull together, against the distances of points within it.
#include "surface/certificate/cells/covering_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "raycast/voxel_intersection.h"
#include "surface/certificate/exact_polygonization.h"
#include "tests/support/mesh_distance.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

Vec3 point_within(const SurfaceHull& hull, Rng& rng) {
  Vec3 sum;
  double weights = 0;
  for (const Vec3& p : hull) {
    const double weight = std::pow(rng.uniform(), 4);
    sum += weight * p;
    weights += weight;
  }
  return sum / weights;
}

// Meshes with and without holes, coarser and finer than the boxes.
TEST(CoveringTriangles, AreNearAllOfTheHullWheneverTheyAreSaidTo) {
  Rng rng(4);
  int covered = 0, open = 0;
  for (const auto& scene : {testing::field_scene("gyroid", 8), testing::noise_scene({6, 5, 5}, 3, {1, 1, 1})}) {
    const ExactSurface surface = scene->surface();
    for (const double holes : {0.0, 0.15}) {
      SurfaceMesh mesh = exact_polygonization(surface).mesh;
      std::erase_if(mesh.triangles, [&](const auto&) { return rng.uniform() < holes; });
      for (int i = 0; i < 1500; ++i) {
        const double most = 0.05 + 0.5 * rng.uniform(), size = 0.1 + 0.5 * rng.uniform();
        const EdgeCrossing& crossing = scene->topology.crossings[rng.below(scene->topology.crossings.size())];
        CellIndex cell = sample_of(crossing, scene->grid.dims());
        for (std::size_t axis = 0; axis < 3; ++axis) cell[axis] = std::min(cell[axis], scene->grid.dims()[axis] - 2);
        const Vec3 low = (1 - size) * Vec3{rng.uniform(), rng.uniform(), rng.uniform()};
        PartOfCell part{{low, low + Vec3{size, size, size}}, {}};
        const CellCorners field = relative_to(scene->grid.cell(cell[0], cell[1], cell[2]), scene->isovalue);
        for (unsigned k = 0; k < 8; ++k) part.values[k] = relative_value(field, corner_of(part.box, k));
        SurfaceHull hull(part);
        for (Vec3& p : hull) p = p + Vec3{double(cell[0]), double(cell[1]), double(cell[2])};
        Box3 around;
        for (const Vec3& p : hull) around.extend(p);
        const Box3 reach{around.low - Vec3{most, most, most}, around.high + Vec3{most, most, most}};
        std::vector<std::uint32_t> near;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
          if (reach.meets(box_of(mesh, t))) near.push_back(t);
        }
        const Vec3 falling = -1.0 * hull.rise();
        if (!CoveringTriangles(mesh, most).cover(hull, falling, near)) {
          ++open;
          continue;
        }
        ++covered;
        for (int k = 0; k < 30; ++k) EXPECT_LE(testing::distance_to(point_within(hull, rng), mesh), most);
      }
    }
  }
  EXPECT_GT(covered, 300);
  EXPECT_GT(open, 300);
}

// A square of two triangles over a flat box, which no single one of them covers.
TEST(CoveringTriangles, HaveNoGapAndFaceOneWay) {
  SurfaceMesh mesh;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) mesh.points.push_back({double(i), double(j), 0.5});
  }
  for (std::uint32_t j = 0; j < 3; ++j) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t v = 4 * j + i;
      mesh.triangles.push_back({v, v + 1, v + 5});
      mesh.triangles.push_back({v, v + 5, v + 4});
    }
  }
  const PartOfCell part{{{1.1, 1.1, 0.3}, {1.9, 1.9, 0.7}}, {1, 1, 1, 1, -1, -1, -1, -1}};
  const SurfaceHull hull(part);
  const std::vector<std::uint32_t> middle = {8, 9};
  const Vec3 up{0, 0, 1};
  EXPECT_TRUE(CoveringTriangles(mesh, 0.1).cover(hull, up, middle));
  EXPECT_FALSE(CoveringTriangles(mesh, 0.1).cover(hull, -1.0 * up, middle));  // they face the other way
  SurfaceMesh holed = mesh;
  holed.triangles.erase(holed.triangles.begin() + 9);
  EXPECT_FALSE(CoveringTriangles(holed, 0.1).cover(hull, up, std::vector<std::uint32_t>{8}));
  SurfaceMesh steep = mesh;
  steep.points[5].z = 0.8;  // a corner of both
  EXPECT_FALSE(CoveringTriangles(steep, 0.1).cover(hull, up, middle));
  EXPECT_TRUE(CoveringTriangles(steep, 0.4).cover(hull, up, middle));
}

}  // namespace
}  // namespace deliso

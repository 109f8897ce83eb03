#include "surface/repair/diagnosis/small_components.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "raycast/isosurface.h"
#include "surface/base/exact_surface.h"
#include "surface/certificate/component_match.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "volume/marching_cubes/marching_cubes.h"

namespace deliso {
namespace {

// Two samples that stand out, one of them less than the other, and a third beside the second.
ScalarGrid two_specks() {
  std::vector<double> samples(9 * 5 * 5, 0);
  const auto at = [&](std::size_t x, std::size_t y, std::size_t z) -> double& { return samples[x + 9 * (y + 5 * z)]; };
  at(2, 2, 2) = 1.1;
  at(6, 2, 2) = 3;
  at(6, 3, 2) = 3;
  return {{9, 5, 5}, samples};
}

MatchedMesh matched(const TriangleMesh& mesh, const IsosurfaceTopology& topology) {
  MatchedMesh matched;
  matched.built.mesh.points = mesh.points;
  matched.built.mesh.triangles = mesh.triangles;
  set_side_adjacency(matched.built.mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) matched.component.push_back(mesh.points[v].x < 4 ? 0 : 1);
  matched.match = match_components(matched.built.mesh, matched.component, topology.components);
  return matched;
}

TEST(SmallComponents, AreMissedWhereACrossingIsFarForTheirSize) {
  const ScalarGrid grid = two_specks();
  const IsosurfaceTopology topology = exact_topology(grid, 1);
  ASSERT_EQ(topology.components.size(), 2u);
  const MarchingCubesMesh cubes = marching_cubes(grid, 1);
  const TriangleMesh mesh{cubes.points, cubes.triangles};
  const Isosurface isosurface(grid, 1, {});
  const SmallComponents specks(ExactSurface{isosurface, topology});
  EXPECT_TRUE(specks.missed_by(matched(mesh, topology)).empty());

  // One corner of the small octahedron is drawn in to the middle: nearer than a tenth of a voxel, but half of it.
  TriangleMesh flat = mesh;
  const auto top = std::max_element(flat.points.begin(), flat.points.end(), [](const Vec3& a, const Vec3& b) {
    return (a.x < 4 ? a.z : -1) < (b.x < 4 ? b.z : -1);
  });
  ASSERT_LT(top->z, 2.1);
  top->z = 2;
  EXPECT_EQ(specks.missed_by(matched(flat, topology)), std::vector<std::uint32_t>{0});

  // A stray of its own there does not make up for it.
  TriangleMesh with_stray = flat;
  const auto first = static_cast<std::uint32_t>(flat.points.size());
  for (const Vec3& p : {Vec3{2, 2, 2.09}, Vec3{2.01, 2, 2.09}, Vec3{2, 2.01, 2.09}}) with_stray.points.push_back(p);
  with_stray.triangles.push_back({first, first + 1, first + 2});
  EXPECT_EQ(specks.missed_by(matched(with_stray, topology)), std::vector<std::uint32_t>{0});

  // As far as that the larger one may be off.
  TriangleMesh larger = mesh;
  for (Vec3& p : larger.points) p.z += p.x > 4 && p.z > 2.1 ? -0.1 : 0;
  EXPECT_TRUE(specks.missed_by(matched(larger, topology)).empty());

  // A speck without a piece is missed altogether.
  TriangleMesh none = mesh;
  std::erase_if(none.triangles, [&](const auto& t) { return none.points[t[0]].x > 4; });
  EXPECT_EQ(specks.missed_by(matched(none, topology)), std::vector<std::uint32_t>{1});
}

// A quarter of a long one would be more than a crossing may be off anywhere.
TEST(SmallComponents, MayBeOffByNoMoreThanAnyOtherPartOfTheSurface) {
  std::vector<double> samples(5 * 10 * 5, 0);
  for (std::size_t y = 2; y < 8; ++y) samples[2 + 5 * (y + 10 * 2)] = 3;
  const ScalarGrid grid({5, 10, 5}, samples);
  const IsosurfaceTopology topology = exact_topology(grid, 1);
  ASSERT_EQ(topology.components.size(), 1u);
  ASSERT_EQ(topology.crossings.size(), 26u);
  const MarchingCubesMesh cubes = marching_cubes(grid, 1);
  const Isosurface isosurface(grid, 1, {});
  const SmallComponents specks(ExactSurface{isosurface, topology});
  for (const double cut : {0.0, 0.6, 1.0, 1.3}) {
    TriangleMesh mesh{cubes.points, cubes.triangles};
    for (Vec3& p : mesh.points) p.y = std::min(p.y, 7 + 2.0 / 3 - cut);
    EXPECT_EQ(specks.missed_by(matched(mesh, topology)).size(), cut > 0.8 ? 1u : 0u) << cut;
  }
}

}  // namespace
}  // namespace deliso

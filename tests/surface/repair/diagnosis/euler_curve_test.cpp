#include "surface/repair/diagnosis/euler_curve.h"

#include <gtest/gtest.h>

#include "surface/certificate/exact_polygonization.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::field_scene;

EulerCurves swept(const SurfaceMesh& mesh, const std::array<std::int32_t, 3>& dims) {
  return euler_curves(mesh, std::vector<std::uint32_t>(mesh.points.size(), 0), 1, {1, 1, 1}, dims).front();
}

TEST(EulerCurve, EqualMeshesNeverDiffer) {
  const auto scene = field_scene("gyroid", 24);
  const SurfaceMesh mesh = exact_polygonization(scene->surface()).mesh;
  for (const auto& layers : jumps_between(swept(mesh, scene->grid.dims()), swept(mesh, scene->grid.dims()))) {
    EXPECT_TRUE(layers.empty());
  }
}

// A hole in the mesh changes its Euler characteristic by one from its layers on: the curves must show where.
TEST(EulerCurve, FindsWhereAHoleIsPunched) {
  const auto scene = field_scene("gyroid", 32);
  const SurfaceMesh exact = exact_polygonization(scene->surface()).mesh;
  // The same surface with a patch of a few triangles punched out: the Euler characteristic falls by one there.
  SurfaceMesh punched = exact;
  const Vec3 place = exact.points[exact.triangles[exact.triangles.size() / 2][0]];
  std::vector<bool> gone(punched.triangles.size());
  std::uint32_t kept = 0;
  std::vector<std::uint32_t> renamed(punched.triangles.size(), kNoSide);
  for (std::uint32_t t = 0; t < punched.triangles.size(); ++t) {
    gone[t] = distance(punched.points[punched.triangles[t][0]], place) == 0;
    if (!gone[t]) renamed[t] = kept++;
  }
  ASSERT_LT(kept, punched.triangles.size());
  SurfaceMesh left;
  left.points = punched.points;
  for (std::uint32_t t = 0; t < punched.triangles.size(); ++t) {
    if (gone[t]) continue;
    left.triangles.push_back(punched.triangles[t]);
    left.neighbours.push_back(punched.neighbours[t]);
    for (TriangleSide& side : left.neighbours.back()) {
      if (side != kNoSide) side = renamed[side >> 2] == kNoSide ? kNoSide : 4 * renamed[side >> 2] + (side & 3u);
    }
  }
  const auto jumps = jumps_between(swept(left, scene->grid.dims()), swept(exact, scene->grid.dims()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(jumps[axis].size(), 1u) << "axis " << axis;
    EXPECT_NEAR(jumps[axis][0], place[axis], 3) << "axis " << axis;
  }
}

TEST(EulerCurve, PartsInOnePassAreLikePartsAlone) {
  const auto scene = field_scene("bubbles", 26);
  const ExactPolygonization surface = exact_polygonization(scene->surface());
  const std::size_t parts = scene->topology.components.size();
  ASSERT_GT(parts, 1u);
  const auto all = euler_curves(surface.mesh, surface.component, parts, {1, 1, 1}, scene->grid.dims());
  for (std::uint32_t c = 0; c < parts; ++c) {
    std::vector<std::uint32_t> alone(surface.component.size(), kNoPart);
    for (std::size_t v = 0; v < alone.size(); ++v) alone[v] = surface.component[v] == c ? 0 : kNoPart;
    EXPECT_EQ(euler_curves(surface.mesh, alone, 1, {1, 1, 1}, scene->grid.dims()).front(), all[c]);
    for (const auto& along : all[c]) EXPECT_EQ(along.back(), scene->topology.components[c].euler_characteristic);
  }
}

}  // namespace
}  // namespace deliso

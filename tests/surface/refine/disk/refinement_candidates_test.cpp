// Points that stage 2 inserts where x_sigma is refused.
#include "surface/refine/disk/refinement_candidates.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

// Two triangles abc and bad in the surface of a linear field; c lies `height` off the middle of the edge ab.
class TwoTriangles {
 public:
  TwoTriangles(double length, double height) : scene_(testing::field_scene("plane", 33)) {
    const Isosurface& surface = *scene_->isosurface;
    const Vec3 middle = on_surface(0.5 * (surface.box().low + surface.box().high));
    const Vec3 normal = surface.gradient(middle) / norm(surface.gradient(middle));
    const Vec3 along = cross(normal, {0, 0, 1}) / norm(cross(normal, {0, 0, 1}));
    const Vec3 across =
        cross(along, normal);  // abc turns counterclockwise seen from lower values, against the gradient
    const Vec3 a = middle - 0.5 * length * along, b = middle + 0.5 * length * along;
    for (const Vec3& p : {a, b, middle + height * across, middle - 5 * across}) {
      mesh_.vertices.push_back({p});
    }
    const auto add = [&](const std::array<std::uint32_t, 3>& corners, TriangleSide side_2) {
      RefinementMesh::Triangle triangle;
      triangle.corners = corners;
      triangle.neighbours = {kNoSide, kNoSide, side_2};
      mesh_.triangles.push_back(triangle);
    };
    add({0, 1, 2}, 4 * 1 + 2);
    add({1, 0, 3}, 4 * 0 + 2);
  }
  [[nodiscard]] const RefinementMesh& mesh() const { return mesh_; }
  [[nodiscard]] std::optional<RefinementCandidate> halving(std::uint32_t triangle, double r_min) const {
    SearchCounters counters;
    return halving_candidate(mesh_, *scene_->isosurface, triangle, 1.5, r_min, counters);
  }
  [[nodiscard]] Vec3 on_surface(const Vec3& p) const {
    const Vec3 g = scene_->isosurface->gradient(p);
    return p - scene_->isosurface->value(p) / squared_norm(g) * g;
  }

 private:
  std::unique_ptr<testing::Scene> scene_;
  RefinementMesh mesh_;
};

TEST(HalvingCandidate, IsTheMiddleOfTheLongestEdge) {
  const TwoTriangles two(10, 4);
  for (const std::uint32_t t : {0u, 1u}) {
    const auto candidate = two.halving(t, 0.1);
    ASSERT_TRUE(candidate);
    EXPECT_NEAR(distance(candidate->point, 0.5 * (two.mesh().corner(0, 0) + two.mesh().corner(0, 1))), 0, 1e-9);
    EXPECT_EQ(candidate->halved, 4 * t + 2);
    EXPECT_EQ(candidate->seed, t);
  }
}

TEST(HalvingCandidate, MayBeNearAVertexOfASliver) {
  // A vertex this near to the middle once kept coarse slivers as they were.
  const TwoTriangles two(10, 0.5);
  const auto candidate = two.halving(0, 0.1);
  ASSERT_TRUE(candidate);
  EXPECT_LT(candidate->nearest, 0.5);
  EXPECT_GE(two.halving(0, 0.4)->nearest, 0.4) << "nothing gets finer than r_min";
}

TEST(HalvingCandidate, IsForCoarseEdgesOnly) {
  EXPECT_FALSE(TwoTriangles(1.4, 0.5).halving(0, 0.1));
  EXPECT_TRUE(TwoTriangles(1.6, 0.5).halving(0, 0.1));
  EXPECT_FALSE(TwoTriangles(1.6, 0.5).halving(0, 0.9)) << "halves would be finer than r_min";
}

// Of an edge in the low face of z, of a triangle in the isosurface x = 16.3 with an apex as far off as that.
std::optional<RefinementCandidate> on_boundary(double length, double apex) {
  const ScalarGrid grid = testing::sampled({33, 33, 33}, [](const Vec3& p) { return 16.3 - p.x; });
  const Isosurface surface(grid, 0, {});
  RefinementMesh mesh;
  for (const double side : {-0.5, 0.5}) mesh.vertices.push_back({{16.3, 16 + side * length, 0}});
  mesh.vertices.push_back({{16.3, 16, apex}});
  RefinementMesh::Triangle triangle;
  triangle.corners = {0, 1, 2};
  triangle.neighbours = {kNoSide, kNoSide, kNoSide};
  mesh.triangles.push_back(triangle);
  SearchCounters counters;
  return boundary_candidate(mesh, surface, 2, 0.001, counters);
}

TEST(BoundaryCandidate, IsInTheMiddleOfAnEdgeUnlessItsTriangleIsANeedle) {
  for (const double apex : {0.1, 1.0, 9.0}) {
    const auto candidate = on_boundary(1, apex);
    ASSERT_TRUE(candidate) << apex;
    EXPECT_EQ(candidate->split, 2u);
    EXPECT_EQ(candidate->point.z, 0);
  }
  EXPECT_FALSE(on_boundary(1, 11));
  EXPECT_FALSE(on_boundary(0.01, 1));
}

}  // namespace
}  // namespace deliso

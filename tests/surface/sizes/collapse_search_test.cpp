// Which collapses are refused.
#include "surface/sizes/collapse_search.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "delaunay/triangle_contact.h"
#include "tests/support/mesh_fields.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

constexpr std::uint32_t kSide = 7;  // vertices along each side of the mesh
constexpr std::uint32_t kMiddle = kSide * kSide / 2;

// A flat mesh of a plane, with other triangles beside it.
struct Plane {
  testing::Scene scene{"plane", testing::sampled({9, 9, 9}, [](const Vec3& p) { return -p.z; }), -4.25};
  Patch mesh{1};

  Plane() {
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      mesh.add_vertex({1.25 + i % kSide, 1.25 + static_cast<double>(i / kSide), 4.25});
    }
    for (std::uint32_t i = 0; i + kSide < kSide * kSide; ++i) {
      if (i % kSide == kSide - 1) continue;
      mesh.add_triangle({i, i + 1, i + kSide});
      mesh.add_triangle({i + 1, i + kSide + 1, i + kSide});
    }
  }
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::uint32_t first = mesh.add_vertex(a);
    mesh.add_vertex(b);
    mesh.add_vertex(c);
    mesh.add_triangle({first, first + 1, first + 2});
  }
  [[nodiscard]] bool has_collapse_in_the_middle() {
    const ExactSurface surface = scene.surface();
    DecimationOptions options;
    options.max_error = 0.5;
    const Witnesses witnesses(mesh, surface, options.max_error, {});
    SearchCounters counters;
    CollapseSearch search(mesh, witnesses, *scene.isosurface, options, counters);
    return search.find(kMiddle, true).has_value();
  }
};

TEST(CollapseSearch, ACollapseMeetsNoTriangleWhoseSineRoundsToZero) {
  Plane free, pierced, touched_by_a_line;
  EXPECT_TRUE(free.has_collapse_in_the_middle());

  const Vec3 a{4.25, 3.75, 3.75}, b = a + Vec3{0, 1 + 0x1p-30, 1}, c = a + Vec3{0, 1 + 0x1p-29, 1 + 0x1p-30};
  pierced.add(a, b, c);
  ASSERT_EQ(pierced.mesh.quality(static_cast<std::uint32_t>(pierced.mesh.triangle_count() - 1)), 0);
  ASSERT_TRUE(has_area(a, b, c));
  EXPECT_FALSE(pierced.has_collapse_in_the_middle());

  // One without area is told of elsewhere: how it meets others is not defined.
  touched_by_a_line.add(a, a + Vec3{0, 0.5, 0.5}, a + Vec3{0, 1, 1});
  EXPECT_TRUE(touched_by_a_line.has_collapse_in_the_middle());
}

}  // namespace
}  // namespace deliso

// Vertices of a small component that a large one is made to swallow must go, and all else must stay.
#include "surface/intruders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "surface/link_sides.h"
#include "surface/polygonized_components.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct Swallowing {
  std::unique_ptr<testing::Scene> scene = testing::field_scene("bubbles", 26);
  PolygonizedSurface surface = polygonized_surface(scene->grid, *scene->isosurface, scene->topology);

  std::int64_t remove() { return remove_intruders(surface.mesh, scene->grid, *scene->isosurface, scene->topology); }
  // A triangle gets a new corner in its middle, at the place of a vertex of another component. Returns the new corner.
  std::uint32_t swallow(std::uint32_t triangle, std::uint32_t vertex) {
    SurfaceMesh& mesh = surface.mesh;
    const auto corner = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(Vec3{mesh.points[vertex]});
    mesh.pole_heights.push_back(1);
    const auto [a, b, c] = Triangle{mesh.triangles[triangle]};
    mesh.triangles[triangle] = {a, b, corner};
    mesh.triangles.push_back({b, c, corner});
    mesh.triangles.push_back({c, a, corner});
    link_sides(mesh);
    return corner;
  }
  // With their smallest corner first, in order.
  [[nodiscard]] std::vector<Triangle> triangles() const {
    std::vector<Triangle> all = surface.mesh.triangles;
    for (Triangle& t : all) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(all.begin(), all.end());
    return all;
  }
  // The first triangle of the largest component, and a vertex of another one.
  [[nodiscard]] std::uint32_t host() const {
    const std::vector<std::uint32_t>& component = surface.component;
    std::vector<std::size_t> sizes(scene->topology.components.size(), 0);
    for (const Triangle& t : surface.mesh.triangles) ++sizes[component[t[0]]];
    const auto largest = static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    std::uint32_t t = 0;
    while (component[surface.mesh.triangles[t][0]] != largest) ++t;
    return t;
  }
  [[nodiscard]] std::uint32_t guest(std::uint32_t number) const {
    const std::uint32_t host_component = surface.component[surface.mesh.triangles[host()][0]];
    for (std::uint32_t v = 0; v < scene->topology.crossings.size(); ++v) {
      if (surface.component[v] != host_component && number-- == 0) return v;
    }
    return 0;
  }
};

TEST(Intruders, AMeshWithoutAnyStaysAsItIs) {
  Swallowing mesh;
  ASSERT_GT(mesh.scene->topology.components.size(), 1u);
  const std::vector<Triangle> before = mesh.triangles();
  EXPECT_EQ(mesh.remove(), 0);
  EXPECT_EQ(mesh.triangles(), before);
}

TEST(Intruders, OneVertexGoesAndItsTriangleComesBack) {
  Swallowing mesh;
  const std::vector<Triangle> before = mesh.triangles();
  mesh.swallow(mesh.host(), mesh.guest(0));
  ASSERT_NE(mesh.triangles(), before);
  EXPECT_EQ(mesh.remove(), 1);
  EXPECT_EQ(mesh.triangles(), before);
}

TEST(Intruders, SeveralThatHangTogetherGo) {
  Swallowing mesh;
  const std::vector<Triangle> before = mesh.triangles();
  const std::uint32_t host = mesh.host();
  for (std::uint32_t i = 0; i < 4; ++i) mesh.swallow(host, mesh.guest(i));
  EXPECT_EQ(mesh.remove(), 4);
  EXPECT_EQ(mesh.triangles(), before);
}

}  // namespace
}  // namespace deliso

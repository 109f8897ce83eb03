// Foreign vertices of a small component in the mesh of a large one must be removed, and everything else must stay.
#include "surface/repair/finish/foreign_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "surface/certificate/exact_polygonization.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/mesh/side_adjacency.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct Swallowing {
  std::unique_ptr<testing::Scene> scene = testing::field_scene("bubbles", 26);
  ExactPolygonization surface = exact_polygonization(scene->surface());

  ForeignVertices remove() { return remove_foreign_vertices(surface.mesh, surface.component); }
  // Splits a triangle at a new vertex, at the position of a vertex of another component.
  void swallow(std::uint32_t triangle, std::uint32_t vertex) {
    SurfaceMesh& mesh = surface.mesh;
    const auto corner = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(Vec3{mesh.points[vertex]});
    mesh.pole_heights.push_back(1);
    surface.component.push_back(std::uint32_t{surface.component[vertex]});
    const auto [a, b, c] = Triangle{mesh.triangles[triangle]};
    mesh.triangles[triangle] = {a, b, corner};
    mesh.triangles.push_back({b, c, corner});
    mesh.triangles.push_back({c, a, corner});
    set_side_adjacency(mesh);
  }
  // The triangles with their lowest corner first, sorted.
  [[nodiscard]] std::vector<Triangle> triangles() const {
    std::vector<Triangle> all = surface.mesh.triangles;
    for (Triangle& t : all) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(all.begin(), all.end());
    return all;
  }
  // The first triangle of the largest component. Call before foreign vertices are added.
  [[nodiscard]] std::uint32_t host() const {
    const std::vector<std::uint32_t>& component = surface.component;
    std::vector<std::size_t> sizes(scene->topology.components.size(), 0);
    for (const Triangle& t : surface.mesh.triangles) ++sizes[component[t[0]]];
    const auto largest = static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    std::uint32_t t = 0;
    while (component[surface.mesh.triangles[t][0]] != largest) ++t;
    return t;
  }
  // Vertices of other components than a triangle's. Call before foreign vertices are added.
  [[nodiscard]] std::vector<std::uint32_t> guests(std::uint32_t triangle, std::size_t count) const {
    const std::uint32_t own = surface.component[surface.mesh.triangles[triangle][0]];
    std::vector<std::uint32_t> found;
    for (std::uint32_t v = 0; v < scene->topology.crossings.size() && found.size() < count; ++v) {
      if (surface.component[v] != own) found.push_back(v);
    }
    return found;
  }
};

TEST(ForeignVertices, AMeshWithoutAnyStaysAsItIs) {
  Swallowing mesh;
  ASSERT_GT(mesh.scene->topology.components.size(), 1u);
  const std::vector<Triangle> before = mesh.triangles();
  const auto [removed, left] = mesh.remove();
  EXPECT_EQ(removed, 0);
  EXPECT_EQ(left, 0);
  EXPECT_EQ(mesh.triangles(), before);
}

TEST(ForeignVertices, VerticesGoAndTheTriangleThatWasSplitAtThemComesBack) {
  for (const std::size_t count : {1u, 4u}) {
    SCOPED_TRACE(count);
    Swallowing mesh;
    const std::vector<Triangle> before = mesh.triangles();
    const std::uint32_t host = mesh.host();
    for (const std::uint32_t guest : mesh.guests(host, count)) mesh.swallow(host, guest);
    ASSERT_EQ(mesh.triangles().size(), before.size() + 2 * count);
    const auto [removed, left] = mesh.remove();
    EXPECT_EQ(removed, static_cast<std::int64_t>(count));
    EXPECT_EQ(left, 0);
    EXPECT_EQ(mesh.triangles(), before);
  }
}

TEST(ForeignVertices, AVertexOnNoComponentIsNone) {
  Swallowing mesh;
  const std::vector<Triangle> before = mesh.triangles();
  mesh.surface.component[mesh.surface.mesh.triangles[mesh.host()][0]] = kNoComponent;
  const auto [removed, left] = mesh.remove();
  EXPECT_EQ(removed, 0);
  EXPECT_EQ(left, 0);
  EXPECT_EQ(mesh.triangles(), before);
}

TEST(ForeignVertices, AVertexStaysWhenNothingElseIsNearOnItsComponent) {
  Swallowing mesh;
  const std::uint32_t host = mesh.host();
  const std::uint32_t guest = mesh.guests(host, 1).front();
  mesh.swallow(host, guest);
  std::vector<bool> is_gone;
  for (const Triangle& t : mesh.surface.mesh.triangles) {
    is_gone.push_back(std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return mesh.surface.component[v] == mesh.surface.component[guest];
    }));
  }
  const std::vector<Vec3> points = mesh.surface.mesh.points;
  drop_triangles(mesh.surface.mesh, is_gone);
  // Vertices without triangles are removed, too; the others keep their order.
  std::vector<std::uint32_t> component;
  for (std::size_t v = 0, next = 0; v < points.size() && next < mesh.surface.mesh.points.size(); ++v) {
    if (points[v] != mesh.surface.mesh.points[next]) continue;
    component.push_back(mesh.surface.component[v]);
    ++next;
  }
  ASSERT_EQ(component.size(), mesh.surface.mesh.points.size());
  const auto [removed, left] = remove_foreign_vertices(mesh.surface.mesh, component);
  EXPECT_EQ(removed, 0);
  EXPECT_EQ(left, 1);
}

}  // namespace
}  // namespace deliso

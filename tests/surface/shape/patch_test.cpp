// Patches: links against a count of edges and against all orders of their arcs, and steps that are taken back.
#include "surface/shape/patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "delaunay/base/parallel.h"
#include "delaunay/base/rng.h"
#include "surface/mesh/triangle_shape.h"
#include "tests/support/mesh_examples.h"

namespace deliso {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct Example {
  BoxSet room;
  Patch patch{room, 1};

  explicit Example(const TriangleMesh& mesh) {
    Box3 box;
    for (const Vec3& p : mesh.points) box.extend(p);
    room.add(box);
    for (const Vec3& p : mesh.points) patch.add_vertex(p);
    for (const Triangle& t : mesh.triangles) patch.add_triangle(t);
  }
  // The triangles there are, each from its lowest corner on, with their qualities.
  [[nodiscard]] std::map<Triangle, double> triangles() const {
    std::map<Triangle, double> all;
    for (std::uint32_t t = 0; t < patch.triangle_count(); ++t) {
      if (!patch.has(t)) continue;
      Triangle corners = patch.corners(t);
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      all[corners] = patch.quality(t);
    }
    return all;
  }
};

TEST(Patch, LinksAreTheEdgesAcrossFromAVertex) {
  for (const TriangleMesh& mesh : {testing::sphere_mesh(2), testing::torus_mesh(7, 5)}) {
    const Example example(mesh);
    for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
      VertexLink link;
      ASSERT_TRUE(example.patch.find_link(v, link));
      EXPECT_TRUE(link.is_closed);
      std::set<std::pair<std::uint32_t, std::uint32_t>> edges, expected;
      for (std::size_t i = 0; i < link.vertices.size(); ++i) {
        edges.emplace(link.vertices[i], link.vertices[(i + 1) % link.vertices.size()]);
        const Triangle& t = example.patch.corners(link.triangles[i]);
        EXPECT_NE(std::find(t.begin(), t.end(), link.vertices[i]), t.end());
      }
      for (const Triangle& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
          if (t[i] == v) expected.emplace(t[(i + 1) % 3], t[(i + 2) % 3]);
        }
      }
      EXPECT_EQ(edges, expected);
      EXPECT_TRUE(example.patch.is_whole(v));
    }
  }
}

TEST(Patch, RefusesLinksOfVerticesThatAreNoDisk) {
  TriangleMesh mesh = testing::tetrahedron_mesh();
  TriangleMesh other = testing::tetrahedron_mesh();
  for (Vec3& p : other.points) p = Vec3{} - p;
  mesh = testing::disjoint_union(mesh, other);
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = v == 4 ? 0 : v;  // both at one vertex
  }
  const Example example(mesh);
  VertexLink link;
  EXPECT_FALSE(example.patch.find_link(0, link));
  EXPECT_TRUE(example.patch.find_link(1, link));
}

using Arc = std::array<std::uint32_t, 2>;

// Whether arcs in this order are one path without a vertex twice, or one cycle of three or more.
bool is_path_or_cycle(const std::vector<Arc>& arcs) {
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (!seen.insert(arcs[i][0]).second || (i > 0 && arcs[i - 1][1] != arcs[i][0])) return false;
  }
  return seen.count(arcs.back()[1]) == 0 || (arcs.back()[1] == arcs.front()[0] && arcs.size() >= 3);
}

TEST(Patch, LinksAreThePathsAndCyclesAmongAllSetsOfArcs) {
  Rng rng(5);
  int paths = 0, cycles = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Patch patch(1);
    for (int v = 0; v < 6; ++v) patch.add_vertex({rng.uniform(), rng.uniform(), rng.uniform()});
    std::vector<Arc> arcs(1 + rng.below(5));
    for (Arc& arc : arcs) {
      arc[0] = 1 + static_cast<std::uint32_t>(rng.below(5));
      do arc[1] = 1 + static_cast<std::uint32_t>(rng.below(5));
      while (arc[1] == arc[0]);
      patch.add_triangle({0, arc[0], arc[1]});
    }
    std::sort(arcs.begin(), arcs.end());
    bool expected = false;
    do expected = expected || is_path_or_cycle(arcs);
    while (std::next_permutation(arcs.begin(), arcs.end()));
    VertexLink link;
    ASSERT_EQ(patch.find_link(0, link), expected) << trial;
    if (!expected) continue;
    ++(link.is_closed ? cycles : paths);
    ASSERT_EQ(link.vertices.size(), arcs.size() + (link.is_closed ? 0 : 1));
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const auto& corners = patch.corners(link.triangles[i]);
      EXPECT_EQ(corners[1], link.vertices[i]);
      EXPECT_EQ(corners[2], link.vertices[(i + 1) % link.vertices.size()]);
    }
  }
  EXPECT_GT(paths, 1000);
  EXPECT_GT(cycles, 50);
}

// As decimation asks, of neighbours at the same time.
TEST(Patch, SeveralThreadsMaySearchLinks) {
  const Example example(testing::sphere_mesh(1));
  const auto vertices = static_cast<std::uint32_t>(example.patch.vertex_count());
  std::vector<VertexLink> links(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) ASSERT_TRUE(example.patch.find_link(v, links[v]));
  std::array<int, 4> wrong{};
  run_tasks(wrong.size(), static_cast<int>(wrong.size()), [&](std::size_t task) {
    VertexLink link;
    for (int turn = 0; turn < 3000; ++turn) {
      for (std::uint32_t i = 0; i < vertices; ++i) {
        const std::uint32_t v = task % 2 == 0 ? i : vertices - 1 - i;
        const bool is_same = example.patch.find_link(v, link) && link.is_closed && link.vertices == links[v].vertices &&
                             link.triangles == links[v].triangles;
        wrong[task] += is_same ? 0 : 1;
      }
    }
  });
  for (const int count : wrong) EXPECT_EQ(count, 0);
}

TEST(Patch, StepsAreTakenBackInTurn) {
  Rng rng(4);
  Example example(testing::sphere_mesh(2));
  Patch& patch = example.patch;
  std::vector<std::map<Triangle, double>> states;
  VertexLink link;
  while (patch.steps() < 60) {
    const auto v = static_cast<std::uint32_t>(rng.below(patch.vertex_count()));
    if (!patch.find_link(v, link)) continue;
    states.push_back(example.triangles());
    PatchStep step;
    step.removed = link.triangles;
    const bool is_new = rng.below(2) == 0;
    step.vertex = is_new ? static_cast<std::uint32_t>(patch.vertex_count()) : v;
    step.point = 1.1 * patch.point(v);
    for (std::size_t i = 0; i < link.vertices.size(); ++i) {
      step.added.push_back({step.vertex, link.vertices[i], link.vertices[(i + 1) % link.vertices.size()]});
    }
    patch.apply(step);
    for (const auto& [corners, quality] : example.triangles()) {
      EXPECT_NEAR(quality,
                  sine_of_least_angle(patch.point(corners[0]), patch.point(corners[1]), patch.point(corners[2])),
                  1e-14);
    }
  }
  for (; !states.empty(); states.pop_back()) {
    patch.undo();
    EXPECT_EQ(example.triangles(), states.back());
    for (std::uint32_t v = 0; v < patch.vertex_count(); ++v) {
      EXPECT_TRUE(patch.star(v).empty() || patch.find_link(v, link));
    }
  }
  EXPECT_EQ(patch.steps(), 0u);
}

TEST(Patch, IsFoundByPlaceAsItIsNow) {
  Rng rng(5);
  Example example(testing::sphere_mesh(3, 10));
  Patch& patch = example.patch;
  VertexLink link;
  for (int trial = 0; trial < 100; ++trial) {
    const auto v = static_cast<std::uint32_t>(rng.below(patch.vertex_count()));
    if (patch.find_link(v, link)) {
      PatchStep step;
      step.removed = link.triangles;
      step.vertex = v;
      step.point = (0.9 + 0.2 * rng.uniform()) * patch.point(v);
      for (std::size_t i = 0; i < link.vertices.size(); ++i) {
        step.added.push_back({v, link.vertices[i], link.vertices[(i + 1) % link.vertices.size()]});
      }
      patch.apply(step);
      if (rng.below(3) == 0) patch.undo();
    }
    Box3 box;
    box.extend(patch.point(v));
    box.extend(0.8 * patch.point(v));
    std::vector<std::uint32_t> near;
    patch.append_near(box, near);
    for (std::uint32_t t = 0; t < patch.triangle_count(); ++t) {
      if (!patch.has(t) || !patch.box_of(t).meets(box)) continue;
      EXPECT_NE(std::find(near.begin(), near.end(), t), near.end());
    }
  }
}

}  // namespace
}  // namespace deliso

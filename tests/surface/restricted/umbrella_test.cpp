#include "surface/restricted/umbrella.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

// Every vertex; returns how often each shape was met.
std::map<UmbrellaShape, int> compare_all(const Scene& scene, const SignedDelaunay& restricted) {
  SCOPED_TRACE(scene.name);
  UmbrellaInspector inspector(restricted);
  const auto facets = testing::restricted_by_name(restricted);
  std::map<UmbrellaShape, int> met;
  for (std::size_t i = 0; i < restricted.delaunay().vertex_count(); ++i) {
    const VertexId q(i);
    if (restricted.is_virtual(q)) continue;
    const UmbrellaShape shape = inspector.inspect(q);
    EXPECT_EQ(shape, testing::brute_umbrella(restricted, facets, q)) << "vertex " << i;
    ++met[shape];

    // The walk from any facet finds the same.
    const auto size = static_cast<std::uint32_t>(inspector.facets().size());
    for (const FacetId f : inspector.facets()) EXPECT_EQ(shape_by_walk(restricted, q, f, size), shape) << i;

    // Its facets are all restricted facets at q, seen from above; its star is all tetrahedra at q.
    std::size_t at_q = 0;
    for (const auto& f : facets) at_q += std::count(f.begin(), f.end(), q.value) != 0 ? 1u : 0u;
    EXPECT_EQ(inspector.facets().size(), at_q);
    for (const FacetId f : inspector.facets()) {
      EXPECT_TRUE(restricted.is_above(f.tet()) && restricted.is_restricted(f));
    }
    std::size_t star = 0;
    for (std::size_t t = 0; t < restricted.delaunay().tet_slots(); ++t) {
      if (!restricted.delaunay().is_live(TetId(t))) continue;
      const auto& v = restricted.delaunay().vertices(TetId(t));
      star += std::find(v.begin(), v.end(), q) != v.end() ? 1 : 0;
    }
    EXPECT_EQ(inspector.star().size(), star);
  }
  return met;
}

TEST(Umbrella, ShapesAreThoseOfTheDefinition) {
  std::map<UmbrellaShape, int> met;
  const auto add = [&](const Scene& scene) {
    const SignedDelaunay restricted(*scene.isosurface, scene.start());
    for (const auto& [shape, count] : compare_all(scene, restricted)) met[shape] += count;
  };
  add(*field_scene("torus", 16));
  add(*field_scene("gyroid", 10));
  for (std::uint64_t seed = 0; seed < 6; ++seed) add(*noise_scene({5, 4, 5}, seed));
  // All four occur, or the test would say little.
  EXPECT_EQ(met.size(), 4u);
}

TEST(Umbrella, RandomSignsMakeEveryKindOfStar) {
  const auto scene = field_scene("torus", 14);
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SignedDelaunay restricted(*scene->isosurface, scene->start());
    Rng rng(seed);
    for (std::size_t i = 0; i < restricted.delaunay().tet_slots(); ++i) {
      if (restricted.delaunay().is_live(TetId(i)) && rng.below(4 + 8 * seed) == 0) restricted.flip_sign(TetId(i));
    }
    compare_all(*scene, restricted);
  }
}

// Sampled densely enough, closed surfaces have disks everywhere, cut ones half disks exactly at the box.
TEST(Umbrella, DenseSamplesGiveDisksInsideAndHalfDisksOnTheBox) {
  for (const char* name : {"sphere", "torus", "sheets"}) {
    const auto scene = field_scene(name, 20);
    SCOPED_TRACE(name);
    std::vector<Vec3> points;
    for (const EdgeCrossing& c : scene->topology.crossings) points.push_back(crossing_position(scene->grid, c));
    const SignedDelaunay restricted(*scene->isosurface, points);
    UmbrellaInspector inspector(restricted);
    for (std::size_t i = 0; i < restricted.delaunay().vertex_count(); ++i) {
      const VertexId q(i);
      if (restricted.is_virtual(q)) continue;
      EXPECT_EQ(inspector.inspect(q), restricted.is_on_box(q) ? UmbrellaShape::kHalfDisk : UmbrellaShape::kDisk) << i;
    }
  }
}

}  // namespace
}  // namespace deliso

// A round that continues the one before must equal a round built anew.
#include "surface/repair/rounds/round.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "surface/certificate/mesh_pieces.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/lattice/sample_lattice.h"
#include "surface/restricted/restricted_delaunay.h"
#include "tests/support/surface_fields.h"
#include "tests/support/surface_oracle.h"

namespace deliso {
namespace {

using testing::noise_scene;
using testing::Scene;

std::unique_ptr<SignedDelaunay> triangulation(const Scene& scene, const std::vector<Vec3>& points) {
  return std::make_unique<SignedDelaunay>(*scene.isosurface, points);
}

// The same as after stage 1: built point by point, so that slots were reused.
std::unique_ptr<SignedDelaunay> grown(const Scene& scene, const std::vector<Vec3>& points) {
  RestrictedDelaunay restricted(*scene.isosurface, std::span(points).first(points.size() / 4));
  for (const Vec3& p : points) {
    restricted.insert(p, restricted.delaunay().incident_tet(restricted.last_vertex()), 0);
  }
  return std::make_unique<SignedDelaunay>(std::move(restricted));
}

std::vector<Vec3> points_of(const RepairRound& round) {
  const auto points = round.restricted().delaunay().points();
  return {points.begin(), points.end()};
}

std::vector<Vec3> all_crossings(const Scene& scene) {
  std::vector<Vec3> points;
  for (const EdgeCrossing& c : scene.topology.crossings) {
    points.push_back(scaled(crossing_position(scene.grid, c), scene.isosurface->step()));
  }
  return points;
}

// A mesh's triangles by the vertices of the triangulation, the lowest first, so copies of a vertex are not
// distinguished. A vertex on a subdivided edge, whose position may be rounded differently, counts as the infinite
// vertex.
std::vector<std::array<std::uint32_t, 3>> triangles_by_name(const BuiltMesh& built, const RepairRound& round) {
  const auto name = [&](std::uint32_t v) {
    const VertexId vertex = built.vertex_of[v];
    return built.mesh.points[v] == round.restricted().delaunay().point(vertex) ? vertex.value : kInfiniteVertex.value;
  };
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& v : built.mesh.triangles) {
    triangles.push_back({name(v[0]), name(v[1]), name(v[2])});
    auto& triangle = triangles.back();
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

std::vector<std::array<std::int64_t, 5>> sorted_pieces(const ComponentMatch& match) {
  std::vector<std::array<std::int64_t, 5>> pieces;
  for (const MeshPiece& piece : match.pieces) {
    pieces.push_back({piece.topology.euler_characteristic, piece.topology.boundary_loops, piece.vertices,
                      piece.component, piece.mixed ? 1 : 0});
  }
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

// Sets plain signs, then those of the rule, in both rounds, and compares all results.
void compare(RepairRound& continued, RepairRound& fresh, const std::string& where) {
  ASSERT_EQ(points_of(continued), points_of(fresh)) << where;
  ASSERT_EQ(continued.component_of_vertex(), fresh.component_of_vertex()) << where;
  const std::vector<bool> all(points_of(fresh).size(), true);
  for (const bool is_plain : {false, true}) {
    is_plain ? continued.take_plain_signs() : continued.take_signs();
    is_plain ? fresh.take_plain_signs() : fresh.take_signs();
    ASSERT_EQ(testing::signs_by_name(continued.restricted()), testing::signs_by_name(fresh.restricted())) << where;
    // Circumcenters are rounded differently when the vertices of a tetrahedron are in another order.
    const std::vector<double>& heights = continued.pole_heights(all);
    const std::vector<double>& fresh_heights = fresh.pole_heights(all);
    ASSERT_EQ(heights.size(), fresh_heights.size()) << where;
    for (std::size_t v = 0; v < heights.size(); ++v) {
      ASSERT_NEAR(heights[v], fresh_heights[v], 1e-6 * fresh_heights[v]) << where << ", vertex " << v;
    }
    const MatchedMesh mesh = continued.assemble(), expected = fresh.assemble();
    ASSERT_EQ(triangles_by_name(mesh.built, continued), triangles_by_name(expected.built, fresh)) << where;
    ASSERT_EQ(mesh.built.mesh.points.size(), expected.built.mesh.points.size()) << where;
    ASSERT_EQ(mesh.built.copies.size(), expected.built.copies.size()) << where;
    ASSERT_EQ(sorted_pieces(mesh.match), sorted_pieces(expected.match)) << where;
    ASSERT_EQ(mesh.match.agreement, expected.match.agreement) << where;
    ASSERT_EQ(mesh.match.error, expected.match.error) << where;
  }
}

// Refines some active cells by one level.
void refine_some(const Scene& scene, CellLevels& cell_levels, Rng& rng) {
  std::vector<CellName> cells;
  scene.topology.index.for_each_active_cell([&](const CellIndex& cell, unsigned) {
    if (rng.below(40) == 0) cells.push_back(cell_levels.name(cell));
  });
  cell_levels.refine(cells);
}

void go_on_and_compare(const Scene& scene, std::uint64_t seed, int threads, bool is_grown = false) {
  Rng rng(seed);
  const SampleLattice lattice(scene.surface());
  CellLevels cell_levels(*scene.isosurface);
  const std::vector<Vec3> start = all_crossings(scene);
  RepairRound continued(scene.surface(threads), cell_levels,
                        is_grown ? grown(scene, start) : triangulation(scene, start));
  std::vector<Vec3> points = points_of(continued);
  continued.take_plain_signs();
  continued.assemble();
  for (int round = 1; round <= 5; ++round) {
    const std::string where = scene.name + ", round " + std::to_string(round);
    refine_some(scene, cell_levels, rng);
    std::vector<LatticeSample> samples;
    for (const auto& [name, level] : cell_levels.levels()) lattice.append(cell_levels.cell(name), level, samples);
    std::vector<Vec3> coming;
    coming.reserve(samples.size());
    for (const LatticeSample& sample : samples) coming.push_back(scaled(sample.point, scene.isosurface->step()));
    if (round == 4) coming.clear();
    std::vector<VertexId> leaving;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (rng.below(30) == 0 && round != 3) leaving.push_back(VertexId(i));
    }

    ExchangedPoints exchanged;
    ASSERT_TRUE(continued.exchange(leaving, coming, exchanged)) << where;
    std::vector<Vec3> left;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool leaves = std::find(leaving.begin(), leaving.end(), VertexId(i)) != leaving.end();
      ASSERT_EQ(exchanged.renamed[i].is_none(), leaves) << where;
      if (!leaves) left.push_back(points[i]);
    }
    left.insert(left.end(), coming.begin(), coming.end());
    for (std::size_t i = 0; i < coming.size(); ++i) {
      ASSERT_EQ(continued.restricted().delaunay().point(exchanged.vertex_of[i]),
                continued.restricted().snapped(coming[i]));
    }
    RepairRound fresh(scene.surface(), cell_levels, triangulation(scene, left));
    compare(continued, fresh, where);
    if (::testing::Test::HasFatalFailure()) return;
    points = points_of(continued);
  }
}

TEST(RepairRound, GoingOnIsLikeBeginningAnew) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    go_on_and_compare(*noise_scene({11, 10, 9}, seed), seed, seed % 2 == 0 ? 3 : 1);
    if (HasFatalFailure()) return;
  }
}

TEST(RepairRound, GoingOnFromStageOneIsLikeBeginningAnew) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    go_on_and_compare(*noise_scene({10, 9, 9}, seed), seed, 1, true);
    if (HasFatalFailure()) return;
  }
}

// Where many samples of the grid lie on facets.
TEST(RepairRound, GoingOnIsLikeBeginningAnewOnASymmetricField) {
  go_on_and_compare(*testing::field_scene("sphere", 24), 1, 1);
}

// A vertex off the surface, in a cell that the surface does not meet, lies on no component.
TEST(RepairRound, VerticesOffTheSurfaceLieOnNoComponent) {
  const auto scene = testing::field_scene("sphere", 24);
  std::vector<Vec3> points = all_crossings(*scene);
  points.push_back({11.5, 11.6, 11.7});
  points.push_back({1.4, 1.5, 1.6});
  const CellLevels cell_levels(*scene->isosurface);
  RepairRound round(scene->surface(), cell_levels, triangulation(*scene, points));
  std::size_t off = 0;
  for (std::size_t i = 0; i < round.component_of_vertex().size(); ++i) {
    const Vec3& p = round.restricted().delaunay().point(VertexId(i));
    const bool is_off = distance(p, points.back()) < 0.1 || distance(p, points[points.size() - 2]) < 0.1;
    EXPECT_EQ(round.component_of_vertex()[i], is_off ? kNoComponent : 0u) << i;
    off += is_off ? 1 : 0;
  }
  EXPECT_EQ(off, 2u);
  // It does not count as a part that the mesh misses, either.
  round.take_plain_signs();
  EXPECT_FALSE(round.assemble().built.mesh.triangles.empty());
}

TEST(RepairRound, WithGuardsHasToBeginAnew) {
  const auto scene = testing::field_scene("sphere", 12);
  const std::vector<Vec3> points = {{3, 3, 3}, {5, 3, 3}, {3, 6, 3}, {6, 7, 3}};
  CellLevels cell_levels(*scene->isosurface);
  RepairRound round(scene->surface(), cell_levels, triangulation(*scene, points));
  ExchangedPoints exchanged;
  const std::vector<Vec3> coming = {{5, 5, 5}};
  EXPECT_FALSE(round.exchange({}, coming, exchanged));
}

}  // namespace
}  // namespace deliso

#include "surface/repair/lattice/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::noise_scene;

// The samples are the vertices, one by one, whatever the exchanges: also with lattice samples that equal free samples
// or removed vertices.
TEST(RepairSamples, StayTheVerticesOfTheTriangulation) {
  int exchanges = 0;
  int rebuilds = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    const auto scene = noise_scene({9, 8, 9}, seed);
    std::vector<Vec3> points = testing::crossing_points(*scene);  // lattice samples of level 1 equal these
    auto restricted = std::make_unique<SignedDelaunay>(*scene->isosurface, points);
    RepairSamples samples(*restricted, {});
    const SampleLattice lattice(scene->surface());
    CellLevels cell_levels(*scene->isosurface);
    Rng rng(seed);
    for (int round = 0; round < 6; ++round) {
      std::vector<CellName> cells;
      for (int i = 0; i < 1 + 4 * (round % 3); ++i) {
        const auto layer = [&](std::size_t axis) {
          return static_cast<std::int32_t>(rng.below(static_cast<std::uint64_t>(scene->grid.dims()[axis] - 1)));
        };
        cells.push_back(cell_levels.name({layer(0), layer(1), layer(2)}));
      }
      cell_levels.refine(cells);
      const Resampling resampling = samples.resampling(cell_levels, lattice, *scene->isosurface);
      ExchangedPoints exchanged;
      if (round % 2 == 1 && restricted->exchange(resampling.leaving, resampling.coming_points(), exchanged)) {
        samples.exchange(resampling, exchanged.vertex_of);
        ++exchanges;
      } else {
        samples.replace(resampling);
        std::vector<VertexId> vertex_of;
        restricted = std::make_unique<SignedDelaunay>(*scene->isosurface, samples.points(), 1, &vertex_of);
        samples.take_vertices(vertex_of);
        ++rebuilds;
      }
      const auto& vertices = restricted->delaunay().points();
      ASSERT_EQ(samples.size(), vertices.size());
      const std::vector<Vec3> now = samples.points();
      for (std::size_t i = 0; i < vertices.size(); ++i) ASSERT_EQ(restricted->snapped(now[i]), vertices[i]) << i;
      // Every sample of every refined cell is there, also those that were hidden by a vertex that has left.
      std::vector<LatticeSample> wanted;
      for (const auto& [cell, level] : cell_levels.levels()) lattice.append(cell_levels.cell(cell), level, wanted);
      for (const LatticeSample& sample : wanted) {
        const Vec3 p = restricted->snapped(scaled(sample.point, scene->isosurface->step()));
        ASSERT_NE(std::find(vertices.begin(), vertices.end(), p), vertices.end()) << sample.key;
      }
    }
  }
  EXPECT_GT(exchanges, 10);
  EXPECT_GT(rebuilds, 10);
}

// Samples that stage 1 was given because the mesh would be too far from the isosurface without them: where repair took
// them out again, as free samples of refined cells, no number of them brought the mesh nearer.
TEST(RepairSamples, FixedOnesStayInRefinedCells) {
  const auto scene = noise_scene({9, 8, 9}, 3);
  std::vector<Vec3> points = testing::crossing_points(*scene);
  const SignedDelaunay restricted(*scene->isosurface, points);
  const auto& vertices = restricted.delaunay().points();
  std::vector<VertexId> inside;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const bool is_on_box = SignedDelaunay::on_box(scene->isosurface->box(), vertices[i]);
    if (!restricted.is_virtual(VertexId(i)) && !is_on_box) inside.push_back(VertexId(i));
  }
  std::vector<Vec3> fixed;
  for (std::size_t i = 0; i < inside.size(); i += 2) fixed.push_back(vertices[inside[i].index()]);
  CellLevels cell_levels(*scene->isosurface);
  std::vector<CellName> cells;
  for (const Vec3& p : vertices) cell_levels.append_cells_of(p, cells);
  cell_levels.refine(cells);
  const SampleLattice lattice(scene->surface());
  const auto leaving = [&](std::span<const Vec3> kept) {
    return RepairSamples(restricted, kept).resampling(cell_levels, lattice, *scene->isosurface).leaving;
  };
  EXPECT_EQ(leaving({}), inside);
  std::vector<VertexId> free;
  for (std::size_t i = 1; i < inside.size(); i += 2) free.push_back(inside[i]);
  EXPECT_EQ(leaving(fixed), free);
}

}  // namespace
}  // namespace deliso

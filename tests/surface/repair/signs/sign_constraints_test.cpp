#include "surface/repair/signs/sign_constraints.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/surface_fields.h"

namespace deliso {
namespace {

using testing::dense;
using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

std::vector<std::uint8_t> constraints_in(const SignedDelaunay& restricted, const CellLevels& cell_levels,
                                         int threads = 1) {
  SignConstraints constraints(restricted);
  constraints.update(cell_levels, threads);
  return constraints.sides();
}

CellLevels everywhere(const Scene& scene) {
  CellLevels cell_levels(*scene.isosurface);
  std::vector<CellName> cells;
  scene.topology.index.for_each_active_cell(
      [&](const CellIndex& cell, unsigned) { cells.push_back(cell_levels.name(cell)); });
  cell_levels.refine(cells);
  return cell_levels;
}

// Points strictly between two samples of one side lie on that side: every tetrahedron that holds one must have this
// constraint.
TEST(SignConstraint, TetrahedraOnGridEdgesOfOneSideHaveTheirSide) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto scene = noise_scene({7, 6, 5}, seed);
    const SignedDelaunay signed_delaunay = dense(*scene);
    const CellLevels cell_levels = everywhere(*scene);
    const std::vector<std::uint8_t> constraints = constraints_in(signed_delaunay, cell_levels);
    TetId hint = signed_delaunay.delaunay().incident_tet(VertexId(std::size_t{0}));
    for (const auto& [name, level] : cell_levels.levels()) {
      const CellIndex cell = cell_levels.cell(name);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        CellIndex end = cell;
        ++end[axis];
        const bool above = scene->grid.at(cell[0], cell[1], cell[2]) > scene->isovalue;
        if (above != (scene->grid.at(end[0], end[1], end[2]) > scene->isovalue)) continue;
        for (const double t : {0.0, 0.25, 0.5, 1.0}) {
          Vec3 p{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
          p[axis] += t;
          const Vec3 center{cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5};
          hint = signed_delaunay.locate(p, center, hint);
          if (signed_delaunay.delaunay().is_ghost(hint)) continue;
          const bool known = (constraints[hint.index()] & (above ? kAbove : kBelow)) != 0;
          EXPECT_TRUE(known) << "seed " << seed << " at " << p.x << " " << p.y << " " << p.z;
        }
      }
    }
  }
}

// However short the passage of a segment through a tetrahedron within the box.
TEST(SignConstraint, NoShortPassageIsMissed) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto scene = noise_scene({7, 6, 5}, seed);
    const SignedDelaunay signed_delaunay = dense(*scene);
    const CellLevels cell_levels = everywhere(*scene);
    const std::vector<std::uint8_t> constraints = constraints_in(signed_delaunay, cell_levels);
    const Box3& box = scene->isosurface->box();
    TetId hint = signed_delaunay.delaunay().incident_tet(VertexId(std::size_t{0}));
    for (const auto& [name, level] : cell_levels.levels()) {
      const CellIndex cell = cell_levels.cell(name);
      const Vec3 start{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
      const bool above = scene->grid.at(cell[0], cell[1], cell[2]) > scene->isovalue;
      if (SignedDelaunay::on_box(box, start)) continue;
      if (above != (scene->grid.at(cell[0] + 1, cell[1], cell[2]) > scene->isovalue)) continue;
      for (int step = 0; step <= 2000; ++step) {
        const Vec3 p{start.x + step / 2000.0, start.y, start.z};
        hint = signed_delaunay.locate(p, {cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5}, hint);
        ASSERT_NE(constraints[hint.index()] & (above ? kAbove : kBelow), 0) << "seed " << seed << " at " << p.x;
      }
    }
  }
}

// The crossings on two grid edges in a row are joined by edges of tetrahedra through the sample between them, and
// segments of either side pass through such edges. That is no reason for either side.
TEST(SignConstraint, TouchedTetrahedraHaveNone) {
  std::ptrdiff_t conflicts = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto scene = noise_scene({9, 8, 7}, seed);
    const SignedDelaunay lattice(*scene->isosurface, testing::crossing_points(*scene));
    const std::vector<std::uint8_t> constraints = constraints_in(lattice, everywhere(*scene));
    conflicts += std::count(constraints.begin(), constraints.end(), kConflict);
    all +=
        std::count_if(constraints.begin(), constraints.end(), [](std::uint8_t side) { return side != kNoConstraint; });
  }
  EXPECT_LT(conflicts, all / 1000);
}

// Enough cells for several blocks. In the symmetric field many samples lie on facets of tetrahedra.
TEST(SignConstraint, IsTheSameForAnyNumberOfThreads) {
  for (const auto& scene : {noise_scene({24, 23, 22}, 1), field_scene("sphere", 60)}) {
    const SignedDelaunay signed_delaunay = dense(*scene);
    const CellLevels cell_levels = everywhere(*scene);
    EXPECT_GT(cell_levels.levels().size(), 4096u);
    const std::vector<std::uint8_t> one = constraints_in(signed_delaunay, cell_levels);
    EXPECT_GT(std::count(one.begin(), one.end(), kAbove), 1000) << scene->name;
    EXPECT_EQ(constraints_in(signed_delaunay, cell_levels, 3), one) << scene->name;
  }
}

TEST(SignConstraint, IsNoneWithoutRefinedCells) {
  const auto scene = noise_scene({6, 6, 6}, 3);
  const SignedDelaunay signed_delaunay = dense(*scene);
  for (const std::uint8_t e : constraints_in(signed_delaunay, CellLevels(*scene->isosurface))) {
    ASSERT_EQ(e, kNoConstraint);
  }
}

}  // namespace
}  // namespace deliso

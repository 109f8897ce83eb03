#include "surface/repair/lattice/sample_lattice.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <memory>

#include "surface/repair/lattice/cell_pieces.h"
#include "tests/support/surface_fields.h"
#include "volume/trilinear_cell.h"

namespace deliso {
namespace {

using testing::field_scene;
using testing::noise_scene;
using testing::Scene;

template <class Visit>
void for_each_cell(const ScalarGrid& grid, Visit visit) {
  for (std::int32_t k = 0; k + 1 < grid.dims()[2]; ++k) {
    for (std::int32_t j = 0; j + 1 < grid.dims()[1]; ++j) {
      for (std::int32_t i = 0; i + 1 < grid.dims()[0]; ++i) visit(CellIndex{i, j, k});
    }
  }
}

std::vector<std::unique_ptr<Scene>> scenes() {
  std::vector<std::unique_ptr<Scene>> all;
  all.push_back(field_scene("gyroid", 9));
  all.push_back(field_scene("marschner_lobb", 9));
  for (std::uint64_t seed = 0; seed < 4; ++seed) all.push_back(noise_scene({4, 5, 3}, seed));
  for (const Vec3& spacing : {Vec3{1, 1, 5}, Vec3{4, 1, 0.7}}) {
    Rng rng(9);
    all.push_back(std::make_unique<Scene>("flat", testing::noise_grid({4, 3, 4}, spacing, rng), 127.5));
  }
  return all;
}

TEST(SampleLattice, EqualKeysMeanEqualPointsWhicheverCellAndLevelAsks) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    const SampleLattice lattice(scene->surface());
    std::map<std::uint64_t, Vec3> point_of;
    std::size_t shared = 0;
    for (int level = 1; level <= kMaxLatticeLevel; ++level) {
      for_each_cell(scene->grid, [&](const CellIndex& cell) {
        std::vector<LatticeSample> samples;
        lattice.append(cell, level, samples);
        for (const LatticeSample& sample : samples) {
          EXPECT_NE(sample.key, 0u);
          const auto [at, is_new] = point_of.emplace(sample.key, sample.point);
          EXPECT_EQ(at->second, sample.point);
          shared += is_new ? 0 : 1;
        }
      });
    }
    EXPECT_GT(shared, 100u);
  }
}

TEST(SampleLattice, NoKeyIsGivenTwiceByOneCell) {
  for (const auto& scene : scenes()) {
    const SampleLattice lattice(scene->surface());
    for_each_cell(scene->grid, [&](const CellIndex& cell) {
      std::vector<LatticeSample> samples;
      lattice.append(cell, kMaxLatticeLevel, samples);
      std::map<std::uint64_t, int> count;
      for (const LatticeSample& sample : samples) EXPECT_EQ(++count[sample.key], 1);
    });
  }
}

TEST(SampleLattice, SamplesLieOnTheSurfaceInTheirCell) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    const SampleLattice lattice(scene->surface());
    const auto [low, high] = scene->grid.range();
    const double range = high - low;
    for_each_cell(scene->grid, [&](const CellIndex& cell) {
      std::vector<LatticeSample> samples;
      lattice.append(cell, kMaxLatticeLevel, samples);
      const CellCorners corners = scene->grid.cell(cell[0], cell[1], cell[2]);
      for (const LatticeSample& sample : samples) {
        const Vec3 uvw = sample.point - Vec3{double(cell[0]), double(cell[1]), double(cell[2])};
        EXPECT_TRUE((Box3{{0, 0, 0}, {1, 1, 1}}).contains(uvw));
        EXPECT_NEAR(trilinear_value(corners, uvw), scene->isovalue, 1e-9 * range)
            << "key " << sample.key << " at " << uvw.x << " " << uvw.y << " " << uvw.z;
      }
    });
  }
}

// The samples of a level include those of the level below; those of level 1 are the crossings of the grid edges, and in
// flat cells those of lines between them.
TEST(SampleLattice, LevelsGrow) {
  for (const auto& scene : scenes()) {
    SCOPED_TRACE(scene->name);
    const SampleLattice lattice(scene->surface());
    std::map<std::uint64_t, Vec3> before;
    for (int level = 1; level <= kMaxLatticeLevel; ++level) {
      std::map<std::uint64_t, Vec3> now;
      for_each_cell(scene->grid, [&](const CellIndex& cell) {
        std::vector<LatticeSample> samples;
        lattice.append(cell, level, samples);
        for (const LatticeSample& sample : samples) now.emplace(sample.key, sample.point);
      });
      if (level == 1) {
        const bool is_flat = scene->name == "flat";
        EXPECT_GE(now.size(), (is_flat ? 2 : 1) * scene->topology.crossings.size());
        EXPECT_TRUE(is_flat || now.size() == scene->topology.crossings.size());
      }
      // Lines at multiples of 1/2 pass through the cell only; grid edges are among them at every level.
      for (const auto& [key, point] : before) EXPECT_EQ(now.count(key), 1u) << "level " << level;
      before = std::move(now);
    }
  }
}

TEST(CellPieces, AreAboutAsLongAsTheSmallestSpacing) {
  const auto pieces = [](const Dims& dims, const Vec3& spacing) {
    Rng rng(1);
    const Scene scene("flat", testing::noise_grid(dims, spacing, rng), 127.5);
    return cell_pieces(*scene.isosurface);
  };
  using Pieces = std::array<std::int32_t, 3>;
  EXPECT_EQ(pieces({3, 3, 3}, {1, 1, 1}), (Pieces{1, 1, 1}));
  EXPECT_EQ(pieces({3, 3, 3}, {1, 1.5, 1.6}), (Pieces{1, 1, 3}));
  EXPECT_EQ(pieces({3, 3, 3}, {0.2, 1, 2.6}), (Pieces{1, 5, 9}));
  EXPECT_EQ(pieces({3, 3, 3}, {1, 1, 1000}), (Pieces{1, 1, 63}));
  EXPECT_EQ(pieces({2, 2, 20000}, {1, 1, 1000}), (Pieces{1, 1, 5}));  // coordinates of 20 bits
}

}  // namespace
}  // namespace deliso

// Places: distances from them, and which of them the boxes around them find to differ.
#include "surface/repair/diagnosis/index_ranges.h"

#include <gtest/gtest.h>

#include "delaunay/base/rng.h"
#include "surface/repair/diagnosis/euler_boxes.h"

namespace deliso {
namespace {

TEST(IndexRanges, DistancesAreThoseFromTheNearest) {
  Rng rng(3);
  const std::array<std::int32_t, 3> dims = {9, 12, 7};
  for (int round = 0; round < 40; ++round) {
    std::vector<IndexBox> places(rng.below(5) + 1);
    for (IndexBox& place : places) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto first = static_cast<std::int32_t>(rng.below(static_cast<std::uint64_t>(dims[axis])));
        place[axis] = {first, std::min(first + static_cast<std::int32_t>(rng.below(3)), dims[axis] - 1)};
      }
    }
    const auto reach = static_cast<std::int32_t>(rng.below(6));
    const DistanceFromRanges distance(places, dims, reach);
    for (std::int32_t k = 0; k < dims[2]; ++k) {
      for (std::int32_t j = 0; j < dims[1]; ++j) {
        for (std::int32_t i = 0; i < dims[0]; ++i) {
          // To the layers of each place, one by one.
          std::int32_t nearest = dims[0] + dims[1] + dims[2];
          for (const auto& [xs, ys, zs] : places) {
            for (std::int32_t x = xs.first; x <= xs.last; ++x) {
              for (std::int32_t y = ys.first; y <= ys.last; ++y) {
                for (std::int32_t z = zs.first; z <= zs.last; ++z) {
                  nearest = std::min(nearest, std::max({std::abs(x - i), std::abs(y - j), std::abs(z - k)}));
                }
              }
            }
          }
          ASSERT_EQ(distance.reaches({i, j, k}), nearest <= reach) << "round " << round;
          if (nearest <= reach) {
            ASSERT_EQ(distance({i, j, k}), nearest) << "round " << round;
          }
        }
      }
    }
  }
}

TEST(CellLayers, HaveTheActiveCellsInThem) {
  Rng rng(4);
  const Dims dims{70, 9, 8};
  std::vector<double> samples(70 * 9 * 8);
  for (double& sample : samples) sample = rng.uniform(-1, 2);
  const ScalarGrid grid(dims, samples);
  const CrossingIndex index(grid, 0);
  for (int round = 0; round < 10; ++round) {
    std::array<std::vector<bool>, 3> some;
    for (auto& along : some) {
      for (std::int32_t layer = 0; layer < dims[0]; ++layer) along.push_back(rng.below(3) != 0);
    }
    const auto is_in = [&](std::size_t axis, std::int32_t layer) -> bool {
      return some[axis][static_cast<std::size_t>(layer)];
    };
    const CellLayers layers(dims, is_in);
    std::vector<std::pair<CellIndex, std::uint8_t>> expected, found;
    index.for_each_active_cell([&](const CellIndex& cell, std::uint8_t pattern) {
      const bool is_here = is_in(0, cell[0]) && is_in(1, cell[1]) && is_in(2, cell[2]);
      EXPECT_EQ(layers.contain(cell), is_here);
      if (is_here) expected.emplace_back(cell, pattern);
    });
    layers.for_each_active_cell(
        index, [&](const CellIndex& cell, std::uint8_t pattern) { found.emplace_back(cell, pattern); });
    EXPECT_EQ(found, expected) << round;
    EXPECT_GT(found.size(), 0u);
  }
}

using Layers = std::array<std::int32_t, 3>;

IndexBox place_at(const Layers& at) {
  return {LayerRange{at[0], at[0]}, LayerRange{at[1], at[1]}, LayerRange{at[2], at[2]}};
}

// Of eight crossings of layers two differ; what differs in shape is the same and the contrary side by side.
TEST(EulerBoxes, FindWhereSomethingDiffersIndeed) {
  const std::array<std::int32_t, 3> dims = {60, 60, 60};
  const Layers here = {12, 40, 11}, there = {45, 13, 44};
  auto boxes = EulerBoxes::around({{{12, 45}, {13, 40}, {11, 44}}}, dims);
  ASSERT_TRUE(boxes);
  EXPECT_EQ(boxes->count(), 8u);
  boxes->add({13, 39, 12}, -2);
  boxes->add({44, 13, 46}, 1);
  for (const std::int32_t i : {4, 9, 13, 22, 41, 50}) {
    boxes->add({i, 13, 11}, 1);
    boxes->add({i + 1, 13, 11}, -1);
  }
  const IndexRanges places = boxes->places();
  EXPECT_EQ(places.all.size(), 8u);
  EXPECT_EQ(places.likely, (std::vector<IndexBox>{place_at(here), place_at(there)}));
}

TEST(EulerBoxes, AllPlacesAreLikelyWhenNoneIs) {
  const auto boxes = EulerBoxes::around({{{12, 45}, {13}, {11}}}, {60, 60, 60});
  ASSERT_TRUE(boxes);
  EXPECT_EQ(boxes->places().likely, (std::vector<IndexBox>{place_at({12, 13, 11}), place_at({45, 13, 11})}));
}

TEST(EulerBoxes, LayersThatAreCloseBelongTogether) {
  const auto boxes = EulerBoxes::around({{{12, 15, 17, 25}, {0}, {59}}}, {60, 60, 60});
  ASSERT_TRUE(boxes);
  const IndexBox close = {LayerRange{12, 17}, LayerRange{0, 0}, LayerRange{59, 59}};
  EXPECT_EQ(boxes->places().all, (std::vector<IndexBox>{close, place_at({25, 0, 59})}));
}

TEST(EulerBoxes, NeedALayerAlongEachAxisAndAreNotTooMany) {
  EXPECT_FALSE(EulerBoxes::around({{{12}, {}, {11}}}, {60, 60, 60}));
  std::vector<std::int32_t> many;
  for (std::int32_t layer = 0; layer < 400; layer += 10) many.push_back(layer);
  EXPECT_FALSE(EulerBoxes::around({{many, many, many}}, {400, 400, 400}));
}

}  // namespace
}  // namespace deliso

// Boxes in which jumps of Euler curves meet, and which of them contain a difference.
#include "surface/repair/diagnosis/euler_boxes.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace deliso {
namespace {

using Jumps = std::array<std::vector<std::int32_t>, 3>;

constexpr std::size_t kNoLimit = 1u << 30;
constexpr std::array<std::int32_t, 3> kDims = {60, 60, 60};

IndexBox box_at(const SampleLayers& at) {
  return {LayerRange{at[0], at[0]}, LayerRange{at[1], at[1]}, LayerRange{at[2], at[2]}};
}

// Jumps meet in eight boxes, of which two contain a difference. Differences in shape cancel side by side.
TEST(EulerBoxes, TheLikelyOnesContainADifference) {
  auto boxes = EulerBoxes::around(Jumps{{{12, 45}, {13, 40}, {11, 44}}}, kDims, kNoLimit);
  ASSERT_TRUE(boxes);
  EXPECT_EQ(boxes->count(), 8u);
  boxes->add({13, 39, 12}, -2);
  boxes->add({44, 13, 46}, 1);
  for (const std::int32_t i : {4, 9, 13, 22, 41, 50}) {
    boxes->add({i, 13, 11}, 1);
    boxes->add({i, 13, 12}, -1);
  }
  const IndexRanges found = boxes->boxes();
  EXPECT_EQ(found.all.size(), 8u);
  EXPECT_EQ(found.likely, (std::vector<IndexBox>{box_at({12, 40, 11}), box_at({45, 13, 44})}));
}

TEST(EulerBoxes, AllAreLikelyIfNoneContainsADifference) {
  const auto boxes = EulerBoxes::around(Jumps{{{12, 45}, {13}, {11}}}, kDims, kNoLimit);
  ASSERT_TRUE(boxes);
  EXPECT_EQ(boxes->boxes().likely, (std::vector<IndexBox>{box_at({12, 13, 11}), box_at({45, 13, 11})}));
}

TEST(EulerBoxes, NearJumpsFormOneRange) {
  const auto boxes = EulerBoxes::around(Jumps{{{12, 15, 17, 25}, {0}, {59}}}, kDims, kNoLimit);
  ASSERT_TRUE(boxes);
  const IndexBox close = {LayerRange{12, 17}, LayerRange{0, 0}, LayerRange{59, 59}};
  EXPECT_EQ(boxes->boxes().all, (std::vector<IndexBox>{close, box_at({25, 0, 59})}));
}

TEST(EulerBoxes, NeedAJumpAlongEachAxisAndAreNotTooMany) {
  EXPECT_FALSE(EulerBoxes::around(Jumps{{{12}, {}, {11}}}, kDims, kNoLimit));
  EXPECT_TRUE(EulerBoxes::around(Jumps{{{12, 20}, {5, 30}, {11}}}, kDims, 4));
  EXPECT_FALSE(EulerBoxes::around(Jumps{{{12, 20}, {5, 30}, {11}}}, kDims, 3));
}

}  // namespace
}  // namespace deliso

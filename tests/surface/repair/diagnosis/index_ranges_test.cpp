// Distances from boxes of sample layers.
#include "surface/repair/diagnosis/index_ranges.h"

#include <gtest/gtest.h>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

TEST(IndexRanges, DistancesAreThoseFromTheNearest) {
  Rng rng(3);
  const std::array<std::int32_t, 3> dims = {9, 12, 7};
  for (int round = 0; round < 40; ++round) {
    std::vector<IndexBox> boxes(rng.below(5) + 1);
    for (IndexBox& box : boxes) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto first = static_cast<std::int32_t>(rng.below(static_cast<std::uint64_t>(dims[axis])));
        box[axis] = {first, std::min(first + static_cast<std::int32_t>(rng.below(3)), dims[axis] - 1)};
      }
    }
    const auto reach = static_cast<std::int32_t>(rng.below(6));
    const DistanceFromRanges distance(boxes, dims, reach);
    for (std::int32_t k = 0; k < dims[2]; ++k) {
      for (std::int32_t j = 0; j < dims[1]; ++j) {
        for (std::int32_t i = 0; i < dims[0]; ++i) {
          // To the layers of each box, one by one.
          std::int32_t nearest = dims[0] + dims[1] + dims[2];
          for (const auto& [xs, ys, zs] : boxes) {
            for (std::int32_t x = xs.first; x <= xs.last; ++x) {
              for (std::int32_t y = ys.first; y <= ys.last; ++y) {
                for (std::int32_t z = zs.first; z <= zs.last; ++z) {
                  nearest = std::min(nearest, std::max({std::abs(x - i), std::abs(y - j), std::abs(z - k)}));
                }
              }
            }
          }
          ASSERT_EQ(distance({i, j, k}) <= reach, nearest <= reach) << "round " << round;
          if (nearest <= reach) {
            ASSERT_EQ(distance({i, j, k}), nearest) << "round " << round;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace deliso

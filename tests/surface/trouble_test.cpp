#include "surface/trouble.h"

#include <gtest/gtest.h>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

TEST(Places, DistancesFromATableAreTheSame) {
  Rng rng(3);
  const std::array<std::int32_t, 3> dims = {9, 12, 7};
  for (int round = 0; round < 20; ++round) {
    Places places;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::uint64_t i = rng.below(4) + 1; i > 0; --i) {
        places.layers[axis].push_back(static_cast<std::int32_t>(rng.below(static_cast<std::uint64_t>(dims[axis]))));
      }
    }
    const DistanceFromPlaces distance(places, dims);
    for (std::int32_t k = 0; k < dims[2]; ++k) {
      for (std::int32_t j = 0; j < dims[1]; ++j) {
        for (std::int32_t i = 0; i < dims[0]; ++i) {
          std::int32_t nearest = dims[0] + dims[1] + dims[2];
          for (const std::int32_t x : places.layers[0]) {
            for (const std::int32_t y : places.layers[1]) {
              for (const std::int32_t z : places.layers[2]) {
                nearest = std::min(nearest, std::max({std::abs(x - i), std::abs(y - j), std::abs(z - k)}));
              }
            }
          }
          ASSERT_EQ(distance({i, j, k}), nearest) << "round " << round;
          ASSERT_EQ(places.distance({i, j, k}), nearest) << "round " << round;
        }
      }
    }
  }
}

}  // namespace
}  // namespace deliso

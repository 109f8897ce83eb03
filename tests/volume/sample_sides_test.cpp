#include "volume/sample_sides.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

// Samples from all over the type's range, with its ends and neighbours of round numbers.
template <class Sample>
std::vector<Sample> some_samples(std::size_t count, Rng& rng) {
  using Limits = std::numeric_limits<Sample>;
  std::vector<Sample> samples = {Limits::lowest(), Limits::max(), Sample{0}, Sample{1}, Sample{100}};
  while (samples.size() < count) {
    if constexpr (std::is_floating_point_v<Sample>) {
      const auto round = static_cast<Sample>(static_cast<double>(rng.below(7)) - 3);
      samples.push_back(rng.below(2) == 0 ? std::nextafter(round, Sample{9}) : static_cast<Sample>(rng.uniform(-3, 3)));
    } else {
      samples.push_back(static_cast<Sample>(rng.next()));
    }
  }
  samples.resize(count);
  return samples;
}

template <class T>
class SampleSides : public ::testing::Test {};
using AllTypes = ::testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(SampleSides, AllTypes);

TYPED_TEST(SampleSides, AreThoseOfTheComparisonInDoublePrecision) {
  using Limits = std::numeric_limits<TypeParam>;
  Rng rng(1);
  const double lowest = static_cast<double>(Limits::lowest());
  const double highest = static_cast<double>(Limits::max());
  std::vector<double> isovalues = {lowest,
                                   lowest - 0.5,
                                   lowest * 2,
                                   highest,
                                   highest + 0.5,
                                   highest * 2,
                                   0,
                                   1,
                                   0.5,
                                   99.999,
                                   100,
                                   -0.1,
                                   std::nextafter(1.0, 0.0),
                                   1e300,
                                   -1e300};
  for (int i = 0; i < 20; ++i) isovalues.push_back(rng.uniform(-200, 200));
  for (const std::size_t count :
       {std::size_t{1}, std::size_t{63}, std::size_t{64}, std::size_t{65}, std::size_t{300}}) {
    const std::vector<TypeParam> samples = some_samples<TypeParam>(count, rng);
    for (const double isovalue : isovalues) {
      const SideTest<TypeParam> sides(isovalue);
      std::vector<std::uint64_t> words((count + 63) / 64, ~std::uint64_t{0});
      sides.pack(samples.data(), count, words.data());
      for (std::size_t i = 0; i < 64 * words.size(); ++i) {
        const bool bit = (words[i / 64] >> (i % 64) & 1) != 0;
        const bool expected = i<count&& static_cast<double>(samples[i])> isovalue;
        ASSERT_EQ(bit, expected) << "sample " << i << " of " << count << ", isovalue " << isovalue;
        if (i >= count) continue;
        ASSERT_EQ(sides.is_above(samples[i]), expected);
        ASSERT_EQ(sides.equals(samples[i]), static_cast<double>(samples[i]) == isovalue) << isovalue;
      }
    }
  }
}

}  // namespace
}  // namespace deliso

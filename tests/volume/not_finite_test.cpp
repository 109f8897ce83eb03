#include "volume/not_finite.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "delaunay/base/check.h"

namespace deliso {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

TEST(NotFinite, AreCountedNamedAndReplaced) {
  const Samples samples{SampleArray<double>(std::vector<double>{1, kNan, 3, -kInf, kInf, 2, kNan, 0})};
  const NotFiniteCounts counts = count_not_finite(samples);
  EXPECT_EQ(counts.nan, 2u);
  EXPECT_EQ(counts.plus_infinite, 1u);
  EXPECT_EQ(counts.minus_infinite, 1u);
  EXPECT_EQ(counts.count(), 4u);
  EXPECT_EQ(first_not_finite_text(samples, {2, 2, 2}), "sample (1, 0, 0) is NaN");
  EXPECT_EQ(finite_range(samples), std::pair(0.0, 3.0));
  EXPECT_EQ(finite_samples(samples), Samples(SampleArray<double>(std::vector<double>{1, 3, 2, 0})));
  EXPECT_EQ(with_finite_samples(samples, 9, -5, 5),
            Samples(SampleArray<double>(std::vector<double>{1, 9, 3, -5, 5, 2, 9, 0})));
  EXPECT_EQ(count_not_finite(Samples(SampleArray<float>(std::vector<float>{1, 2}))).count(), 0u);
}

TEST(NotFinite, SomeSampleMustBeFinite) {
  EXPECT_THROW(finite_range(Samples(SampleArray<double>(std::vector<double>{kNan, kInf}))), InputError);
  // What is beyond the range of floats becomes its last.
  const Samples floats{SampleArray<float>(std::vector<float>{1, static_cast<float>(kNan)})};
  EXPECT_EQ(with_finite_samples(floats, 1e300, 0, 0),
            Samples(SampleArray<float>(std::vector<float>{1, std::numeric_limits<float>::max()})));
}

}  // namespace
}  // namespace deliso

// Parts of a volume.
#include "volume/region.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "delaunay/base/check.h"

namespace deliso {
namespace {

ScalarGrid numbered() {
  std::vector<std::uint16_t> samples(5 * 4 * 3);
  std::iota(samples.begin(), samples.end(), std::uint16_t{0});
  return {{5, 4, 3}, std::move(samples), {1, 2, 0.5}, {10, 20, 30}};
}

TEST(Region, SamplesKeepTheirValuesAndPlaces) {
  const ScalarGrid all = numbered(), part = cropped(all, parse_region("1:3,2:,:1", "r"));
  EXPECT_EQ(part.dims(), (Dims{3, 2, 2}));
  EXPECT_EQ(part.type_name(), all.type_name());
  EXPECT_EQ(part.spacing(), all.spacing());
  EXPECT_EQ(part.origin(), (Vec3{11, 24, 30}));
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 3; ++i) EXPECT_EQ(part.at(i, j, k), all.at(i + 1, j + 2, k));
    }
  }
}

TEST(Region, TextAndRegionAreInverse) {
  for (const std::string text : {"1:3,2:,:1", ":,:,:", "0:4,1:2,0:2"}) {
    EXPECT_EQ(region_text(parse_region(text, "r")), text);
  }
  EXPECT_TRUE(parse_region(":,:,:", "r").is_all());
  EXPECT_FALSE(parse_region(":,:,:1", "r").is_all());
}

TEST(Region, WhatIsNoneIsRefused) {
  for (const std::string text :
       {"", "1:3", "1:3,2:3", "1:3,2:3,1:2,4:5", "a:3,:,:", "-1:3,:,:", "1-3,:,:", "1:3,:,:2x"}) {
    EXPECT_THROW(parse_region(text, "r"), InputError) << text;
  }
  for (const std::string text : {"3:3,:,:", "3:2,:,:", "0:5,:,:", "9:,:,:"}) {
    EXPECT_THROW(cropped(numbered(), parse_region(text, "r")), InputError) << text;
  }
}

}  // namespace
}  // namespace deliso

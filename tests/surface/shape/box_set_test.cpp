// Sets and maps of boxes against a look at all of them.
#include "surface/shape/box_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "delaunay/base/rng.h"
#include "tests/support/random_boxes.h"

namespace deliso {
namespace {

TEST(BoxSet, FindsTheBoxesThatMeetAnotherAndThoseThatHoldIt) {
  Rng rng(2);
  BoxSet set;
  for (const Box3& box : testing::random_boxes(rng, 300, 40)) set.add(box);
  std::vector<std::uint32_t> near;
  for (const Box3& box : testing::random_boxes(rng, 300, 40)) {
    std::set<std::uint32_t> found;
    set.for_each_meeting(box, near, [&](std::uint32_t i) { found.insert(i); });
    bool is_held = false;
    for (std::uint32_t i = 0; i < set.boxes().size(); ++i) {
      EXPECT_EQ(found.contains(i), testing::have_common_point(set.boxes()[i], box));
      is_held = is_held || (set.boxes()[i].contains(box.low) && set.boxes()[i].contains(box.high));
    }
    EXPECT_EQ(set.holds(box, near), is_held);
  }
}

TEST(BoxMap, NamesEveryBoxThatASmallThingMeets) {
  Rng rng(3);
  for (const double side : {5.0, 60.0, 2000.0}) {
    const std::vector<Box3> boxes = testing::random_boxes(rng, 100, side);
    const BoxMap map(boxes);
    for (int trial = 0; trial < 2000; ++trial) {
      const Vec3 low{side * (1.4 * rng.uniform() - 0.2), side * (1.4 * rng.uniform() - 0.2),
                     side * (1.4 * rng.uniform() - 0.2)};
      const double size = map.reach() * rng.uniform();
      const Box3 thing{low, low + Vec3{size, size, size}};
      const auto near = map.near(low);
      for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i].meets(thing)) continue;
        EXPECT_NE(std::find(near.begin(), near.end(), i), near.end()) << side << ' ' << trial << ' ' << i;
      }
    }
  }
}

TEST(BoxMap, VisitsEveryBoxThatALargerThingMeetsUnlessThereAreTooMany) {
  Rng rng(4);
  int seen = 0, refused = 0;
  for (const double side : {5.0, 60.0, 2000.0}) {
    const std::vector<Box3> boxes = testing::random_boxes(rng, 100, side);
    const BoxMap map(boxes);
    const auto random = [&](double from, double to) {
      return Vec3{rng.uniform(from, to), rng.uniform(from, to), rng.uniform(from, to)};
    };
    for (int trial = 0; trial < 2000; ++trial) {
      const Vec3 low = random(-0.2 * side, 1.2 * side);
      const Box3 thing{low, low + random(0, (trial % 2 == 0 ? 3 : 12) * map.reach())};
      std::set<std::uint32_t> near;
      if (!map.visit_near(thing, [&](std::uint32_t i) { near.insert(i); })) {
        ++refused;
        continue;
      }
      for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i].meets(thing)) continue;
        ++seen;
        EXPECT_TRUE(near.contains(i)) << side << ' ' << trial << ' ' << i;
      }
    }
  }
  EXPECT_GT(seen, 1000);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace deliso

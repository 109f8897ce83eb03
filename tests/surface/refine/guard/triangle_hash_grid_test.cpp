#include "surface/refine/guard/triangle_hash_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"

namespace deliso {
namespace {

// Sizes from a thousandth to a thousand times `size`, evenly in their logarithms.
Box3 random_box(Rng& rng, double side, double size) {
  Box3 box;
  const Vec3 at{side * rng.uniform(), side * rng.uniform(), side * rng.uniform()};
  const double scale = size * std::pow(10, rng.uniform(-3, 3));
  box.extend(at);
  box.extend(at + scale * Vec3{rng.uniform(), rng.uniform(), rng.uniform()});
  return box;
}

Box3 widened(const Box3& box, double by) { return {box.low - Vec3{by, by, by}, box.high + Vec3{by, by, by}}; }

// What a search finds is what meets the box, and maybe what misses it by the rounding to floats.
void expect_what_is_near(TriangleHashGrid& tight, const std::vector<Box3>& boxes, const std::vector<bool>& held,
                         const Box3& box) {
  std::vector<std::uint32_t> found;
  tight.append_near(box, found);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end()) << "nothing is found twice";
  const double rounding = 1e-6 * norm(box.high);
  for (std::uint32_t t = 0; t < boxes.size(); ++t) {
    const bool is_found = std::binary_search(found.begin(), found.end(), t);
    EXPECT_EQ(tight.holds(t), held[t]);
    if (held[t] && boxes[t].meets(box)) {
      EXPECT_TRUE(is_found) << t;
    } else if (!held[t] || !boxes[t].meets(widened(box, rounding))) {
      EXPECT_FALSE(is_found) << t;
    }
  }
}

// Searches in small boxes look at cells one by one, in larger ones block by block, in the largest at all blocks; and
// far from the origin cells run together.
TEST(TriangleHashGrid, FindsWhatIsNearWhileTheSetChanges) {
  for (const double side : {50.0, 3000.0, 1e8}) {
    Rng rng(static_cast<std::uint64_t>(side));
    TriangleHashGrid tight;
    std::vector<Box3> boxes;
    std::vector<bool> held;
    for (int round = 0; round < 60; ++round) {
      for (int i = 0; i < 20; ++i) {
        boxes.push_back(random_box(rng, side, 2));
        held.push_back(true);
        tight.add(static_cast<std::uint32_t>(boxes.size() - 1), boxes.back());
      }
      for (int i = 0; i < 8; ++i) {
        const std::uint32_t t = static_cast<std::uint32_t>(rng.below(boxes.size()));
        held[t] ? tight.remove(t, boxes[t]) : tight.add(t, boxes[t]);
        held[t] = !held[t];
      }
      for (const double size : {0.1, 10.0, 0.3 * side}) {
        expect_what_is_near(tight, boxes, held, random_box(rng, side, size));
      }
    }
  }
}

// Far apart along an axis, at places whose distance is a power of two: no cell may be taken for another one.
TEST(TriangleHashGrid, FindsWhatIsFarFromTheOriginInBoxesOfAnySize) {
  for (int power = 10; power <= 40; ++power) {
    TriangleHashGrid tight;
    const Vec3 step{std::ldexp(1.0, power), 0, 0};
    const Box3 here{{1, 1, 1}, {1.5, 1.5, 1.5}};
    const Box3 there{here.low + step, here.high + step};
    tight.add(0, here);
    tight.add(1, there);
    for (const double width : {0.0, 1.0, 5.0, 12.0, 100.0}) {
      std::vector<std::uint32_t> found;
      tight.append_near(widened(there, width), found);
      EXPECT_EQ(found, std::vector<std::uint32_t>{1}) << power << " " << width;
    }
  }
}

TEST(TriangleHashGrid, AnEmptySetHasNothingNear) {
  TriangleHashGrid tight;
  std::vector<std::uint32_t> found;
  tight.append_near({{0, 0, 0}, {1e9, 1e9, 1e9}}, found);
  EXPECT_TRUE(found.empty());
  EXPECT_FALSE(tight.holds(3));
}

}  // namespace
}  // namespace deliso

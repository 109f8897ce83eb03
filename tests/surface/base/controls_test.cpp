#include "surface/base/controls.h"

#include <gtest/gtest.h>

#include <atomic>

namespace deliso {
namespace {

// Else a check that has ended early because of the flag would be taken for a whole one.
TEST(Controls, StayOverWhenTheCallerTakesTheStopBack) {
  std::atomic<bool> stop{false};
  Controls controls({}, &stop, {});
  EXPECT_FALSE(controls.is_over());
  stop = true;
  EXPECT_TRUE(controls.is_over());
  stop = false;
  EXPECT_TRUE(controls.is_over());
  EXPECT_TRUE(controls.poll());
  EXPECT_TRUE(controls.stopped());
}

TEST(Controls, AreOverTogetherWithTheirParts) {
  std::atomic<bool> stop{false};
  Controls controls({}, &stop, {});
  Controls part = controls.for_part(0.5, 0);
  const Controls copy = controls;
  stop = true;
  EXPECT_TRUE(part.poll());
  stop = false;
  EXPECT_TRUE(controls.is_over());
  EXPECT_TRUE(copy.is_over());
}

// A part that has used up its share of the vertices stops no other.
TEST(Controls, GoOnWhenAPartHasUsedUpItsVertices) {
  BudgetParameters budget;
  budget.max_vertices = 8;
  const Controls controls(budget, nullptr, {});
  Controls part = controls.for_part(0.5, 0);
  EXPECT_TRUE(part.must_stop("refine", 4, 0));
  EXPECT_TRUE(part.is_over());
  EXPECT_FALSE(controls.is_over());
}

}  // namespace
}  // namespace deliso

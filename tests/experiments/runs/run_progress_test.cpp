// What `deliso run` says of the time that is left.
#include "experiments/runs/run_progress.h"

#include <gtest/gtest.h>

namespace deliso::testing {
namespace {

TEST(RunProgress, TheTimeLeftComesFromRunsOfTheSameDataSet) {
  RemainingTime remaining({0, 0, 1, 1});
  EXPECT_LT(remaining.seconds(), 0);
  remaining.finished(2);
  EXPECT_DOUBLE_EQ(remaining.seconds(), 6);  // three more like it
  remaining.finished(4);
  EXPECT_DOUBLE_EQ(remaining.seconds(), 6);  // two of a data set not met yet: 3 each
  remaining.finished(10);
  EXPECT_DOUBLE_EQ(remaining.seconds(), 10);  // one more like the last
}

TEST(RunProgress, DurationsAreReadable) {
  EXPECT_EQ(duration_text(0.2), "0 s");
  EXPECT_EQ(duration_text(89), "89 s");
  EXPECT_EQ(duration_text(600), "10 min");
  EXPECT_EQ(duration_text(3 * 3600 + 20 * 60), "3 h 20 min");
}

}  // namespace
}  // namespace deliso::testing

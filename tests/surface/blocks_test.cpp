#include "surface/blocks.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace deliso {
namespace {

TEST(RunInTurn, FirstStepsComeInOrderAndSecondStepsAfterThem) {
  for (const int threads : {1, 2, 5}) {
    std::vector<std::size_t> order;  // written by one task at a time
    std::vector<int> steps(40, 0);
    run_in_turn(
        steps.size(), threads,
        [&](std::size_t i) {
          order.push_back(i);
          steps[i] = steps[i] == 0 ? 1 : -1;
        },
        [&](std::size_t i) { steps[i] = steps[i] == 1 ? 2 : -1; });
    ASSERT_EQ(order.size(), steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_EQ(order[i], i) << threads;
      EXPECT_EQ(steps[i], 2) << threads;
    }
  }
}

TEST(RunInTurn, TheFirstExceptionIsThrownOnAfterAllHaveEnded) {
  for (const int threads : {1, 3}) {
    std::vector<int> ended(10, 0);
    const auto first = [](std::size_t i) {
      if (i == 7) throw std::runtime_error("7");
    };
    const auto second = [&](std::size_t i) {
      if (i == 4) throw std::runtime_error("4");
      ended[i] = 1;
    };
    try {
      run_in_turn(ended.size(), threads, first, second);
      FAIL() << threads;
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "4") << threads;
    }
    for (std::size_t i = 0; i < ended.size(); ++i) EXPECT_EQ(ended[i], i == 4 || i == 7 ? 0 : 1) << threads;
  }
}

}  // namespace
}  // namespace deliso

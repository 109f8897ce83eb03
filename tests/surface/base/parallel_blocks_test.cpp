#include "surface/base/parallel_blocks.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace deliso {
namespace {

TEST(RunInTurn, FirstAndSecondStepsComeInOrderAndLastStepsAfterThem) {
  for (const int threads : {1, 2, 3, 5}) {
    std::vector<std::size_t> first_order, second_order;  // each written by one task at a time
    std::vector<int> steps(40, 0);
    const auto step = [&](std::size_t i, int before) { steps[i] = steps[i] == before ? before + 1 : -1; };
    run_in_turn(
        steps.size(), threads,
        [&](std::size_t i) {
          first_order.push_back(i);
          step(i, 0);
        },
        [&](std::size_t i) {
          second_order.push_back(i);
          step(i, 1);
        },
        [&](std::size_t i) { step(i, 2); });
    ASSERT_EQ(first_order.size(), steps.size());
    ASSERT_EQ(second_order.size(), steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_EQ(first_order[i], i) << threads;
      EXPECT_EQ(second_order[i], i) << threads;
      EXPECT_EQ(steps[i], 3) << threads;
    }
  }
}

TEST(RunInTurn, TheFirstExceptionIsThrownOnAfterAllHaveEnded) {
  for (const int threads : {1, 3}) {
    std::vector<int> ended(10, 0);
    const auto fail_at = [](std::size_t i, std::size_t at) {
      if (i == at) throw std::runtime_error(std::to_string(at));
    };
    const auto first = [&](std::size_t i) { fail_at(i, 7); };
    const auto second = [&](std::size_t i) { fail_at(i, 5); };
    const auto last = [&](std::size_t i) {
      fail_at(i, 4);
      ended[i] = 1;
    };
    try {
      run_in_turn(ended.size(), threads, first, second, last);
      FAIL() << threads;
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "4") << threads;
    }
    for (std::size_t i = 0; i < ended.size(); ++i) {
      EXPECT_EQ(ended[i], i == 4 || i == 5 || i == 7 ? 0 : 1) << threads;
    }
  }
}

}  // namespace
}  // namespace deliso

// Tasks on threads, and what stands in for the threads.
#include "delaunay/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace deliso {
namespace {

TEST(RunTasks, RunsEachOnce) {
  for (const int threads : {-1, 1, 2, 7}) {
    std::vector<std::atomic<int>> runs(100);
    run_tasks(runs.size(), threads, [&](std::size_t i) { ++runs[i]; });
    for (const auto& count : runs) EXPECT_EQ(count, 1);
  }
}

TEST(RunTasks, ThrowsWhatTheFirstOfThemThrew) {
  std::atomic<int> ended = 0;
  try {
    run_tasks(20, 3, [&](std::size_t i) {
      ++ended;
      if (i % 7 == 5) throw std::runtime_error(std::to_string(i));
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "5");
  }
  EXPECT_EQ(ended, 20);
}

// A runner gets every task of a run on several threads, those within tasks, too.
TEST(RunTasks, AreGivenToTheRunner) {
  std::vector<std::size_t> counts;
  task_runner() = [&](std::size_t count, const std::function<void(std::size_t)>& task) {
    counts.push_back(count);
    for (std::size_t i = 0; i < count; ++i) task(i);
  };
  std::vector<std::size_t> ran;
  run_tasks(3, 2, [&](std::size_t i) {
    ran.push_back(i);
    if (i == 1) run_tasks(2, 2, [&](std::size_t j) { ran.push_back(10 + j); });
  });
  run_tasks(2, 1, [&](std::size_t i) { ran.push_back(20 + i); });
  task_runner() = nullptr;
  EXPECT_EQ(counts, (std::vector<std::size_t>{3, 2}));
  EXPECT_EQ(ran, (std::vector<std::size_t>{0, 1, 10, 11, 2, 20, 21}));
}

}  // namespace
}  // namespace deliso

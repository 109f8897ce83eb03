// Chapter 11 of the page: its experiments are those of configs/teaching, run when the page is made.
#include "experiments/lesson/lesson_experiments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <set>
#include <string>

#include "delaunay/base/check.h"
#include "experiments/lesson/lesson_page.h"
#include "tests/support/pages.h"

namespace deliso::testing {
namespace {

TEST(LessonExperiments, AreThoseOfTheFolderWithTheirTables) {
  const Json all = lesson_experiments(nullptr);
  std::set<std::string> made, present;
  for (const auto& entry : std::filesystem::directory_iterator(root() / "configs/teaching")) {
    if (entry.path().extension() == ".json") present.insert("configs/teaching/" + entry.path().filename().string());
  }
  for (const Json& experiment : all) {
    SCOPED_TRACE(experiment.at("file"));
    made.insert(experiment.at("file").get<std::string>());
    // The answers hold in these records, and have their figures.
    EXPECT_TRUE(experiment.at("untrue").empty()) << experiment.at("untrue");
    EXPECT_EQ(experiment.at("answer").get<std::string>().find('{'), std::string::npos);
    EXPECT_FALSE(experiment.at("claims").empty());
    for (const Json& row : experiment.at("rows")) {
      EXPECT_EQ(row.at("cells").size(), experiment.at("metrics").size());
      for (const Json& cell : row.at("cells")) EXPECT_FALSE(cell.at("text").get<std::string>().empty());
    }
  }
  EXPECT_EQ(made, present);
  const std::string page = lesson_page({.experiments = &all});
  EXPECT_GT(page.size(), lesson_page({}).size() + 10'000);
  EXPECT_LE(page.size(), 2u << 20);
}

TEST(LessonExperiments, StopWhenTheyAreTold) {
  const std::atomic<bool> stop = true;
  EXPECT_THROW(lesson_experiments(&stop), InputError);
}

}  // namespace
}  // namespace deliso::testing

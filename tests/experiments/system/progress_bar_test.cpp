// The line that shows progress: within the terminal, and never backwards.
#include "experiments/system/progress_bar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>

namespace deliso {
namespace {

std::size_t filled(const std::string& line) {
  return static_cast<std::size_t>(std::count(line.begin(), line.end(), '#'));
}

TEST(ProgressLine, FitsIntoAnyWidth) {
  const std::string text = "refine  123456 vertices, 7890 waiting, 12.3 s";
  for (std::size_t width = 1; width < 120; ++width) {
    const std::string line = progress_line(0.5, text, width);
    EXPECT_LE(line.size(), width);
    EXPECT_NE(line.find(text.substr(0, width < 18 ? width : width / 2)), std::string::npos) << line;
    if (width >= 80) {
      EXPECT_NE(line.find(text), std::string::npos);
    }
  }
  EXPECT_EQ(progress_line(0.5, "x", 80), "[##############..............] x");
  EXPECT_EQ(filled(progress_line(7, text, 100)), 28u);
}

// Slabs count their own vertices, and stage 2 goes on after the shape stage.
TEST(ProgressBar, NeverGoesBack) {
  std::ostringstream stream;
  setenv("COLUMNS", "70", 1);
  ProgressBar bar(stream, true, 0);
  std::size_t most = 0;
  long count = 0;
  std::string stage_before;
  const auto look = [&](const Progress& progress) {
    stream.str("");
    bar.show(progress);
    const std::string line = stream.str().substr(4);  // behind the return and the wiping of the line
    EXPECT_LT(line.size(), 70u) << line;
    EXPECT_GE(filled(line), most) << line;
    most = filled(line);
    const std::string text = line.substr(line.find("] ") + 2);
    const std::string stage = text.substr(0, text.find(' '));
    const long vertices = std::stol(text.substr(text.find("  ") + 2));
    EXPECT_TRUE(stage != stage_before || vertices >= count) << line;
    stage_before = stage;
    count = vertices;
  };
  for (const char* stage : {"index", "initial", "recover", "repair", "refine", "shape", "refine", "shape", "certify"}) {
    look({stage, 0, 0});
    for (const std::int64_t done : {500, 100, 900, 20}) look({stage, done, 400});
  }
  EXPECT_GT(most, 20u);
  unsetenv("COLUMNS");
  EXPECT_GE(terminal_width(), 2u);
}

TEST(ProgressBar, CommandsShowTheirSteps) {
  std::ostringstream stream;
  setenv("COLUMNS", "81", 1);
  {
    ProgressBar bar(stream, true, 0);
    bar.show(0.5, "distances");
    EXPECT_NE(stream.str().find("[##############..............] distances"), std::string::npos) << stream.str();
    bar.show(0.1, "again");
    EXPECT_EQ(filled(stream.str()), 28u);  // twice a half
  }
  EXPECT_TRUE(stream.str().ends_with("\r\033[K"));
  unsetenv("COLUMNS");
  std::ostringstream hidden;
  ProgressBar(hidden, false).show(0.5, "x");
  EXPECT_EQ(hidden.str(), "");
}

}  // namespace
}  // namespace deliso

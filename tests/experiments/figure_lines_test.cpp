// The lines of the paper's figures and the functions that implement them: checks that surface/README.md names existing
// ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/pages.h"

namespace deliso::testing {
namespace {

namespace fs = std::filesystem;

struct FigureLine {
  std::string line;  // of the paper
  std::string file;
  std::string name;
};

// The rows "| line | `file` | `name` |" of a page.
std::vector<FigureLine> figure_lines(const std::string& page) {
  const std::regex row(R"(\| ([^|`]+) \| `([^`|]+)` \| `([A-Za-z_]\w*)` \|)");
  std::vector<FigureLine> lines;
  for (const std::string& text : lines_of(page)) {
    std::smatch match;
    if (std::regex_match(text, match, row)) lines.push_back({match[1], match[2], match[3]});
  }
  return lines;
}

bool has_identifier(const std::string& text, const std::string& name) {
  return std::regex_search(text, std::regex("\\b" + name + "\\b"));
}

TEST(FigureLines, EveryLineHasItsFileAndItsName) {
  const std::vector<FigureLine> lines = figure_lines(page_text("surface/README.md"));
  EXPECT_GE(lines.size(), 18u);
  for (const FigureLine& line : lines) {
    SCOPED_TRACE(line.line);
    const fs::path file = root() / line.file;
    ASSERT_TRUE(fs::is_regular_file(file)) << line.file;
    EXPECT_TRUE(has_identifier(read_text(file), line.name)) << line.file << " does not name " << line.name;
  }
}

// Figures 4, 5, 9 and 12 have so many lines that call something.
TEST(FigureLines, NoLineIsLeftOut) {
  const std::vector<FigureLine> lines = figure_lines(page_text("surface/README.md"));
  const std::vector<std::string> wanted = {
      "Figure 4, 1", "Figure 4, 2", "Figure 4, 3", "Figure 4, 4", "Figure 5, 1",  "Figure 5, 2",  "Figure 5, 3 and 5",
      "Figure 5, 4", "Figure 9, 2", "Figure 9, 3", "Figure 9, 4", "Figure 12, 1", "Figure 12, 2", "Figure 12, 3"};
  for (const std::string& name : wanted) {
    const auto is_it = [&](const FigureLine& line) { return line.line.starts_with(name + ":"); };
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(), is_it), 1) << name;
  }
}

TEST(FigureLines, AWrongNameWouldBeSeen) {
  const std::vector<FigureLine> lines =
      figure_lines("| a | `b.h` | `c` |\n| word | meaning | `d.h` |\n| `x` | y | z |\n");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].name, "c");
  EXPECT_TRUE(has_identifier("int multi_intersect(", "multi_intersect"));
  EXPECT_FALSE(has_identifier("int multi_intersects(", "multi_intersect"));
}

}  // namespace
}  // namespace deliso::testing

// The README pages: each folder has one of limited size, and the names in it exist.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/pages.h"

namespace deliso::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Whether a page may name a file in this way: from the root, from the page's own folder or, without a folder, anywhere
// below it.
bool is_there(const std::string& name, const std::string& page) {
  const fs::path folder = (root() / page).parent_path();
  if (fs::exists(root() / name) || fs::exists(folder / name)) return true;
  if (name.find('/') != std::string::npos) return false;
  const auto has_name = [&](const fs::directory_entry& entry) { return entry.path().filename() == name; };
  return std::any_of(fs::recursive_directory_iterator(folder), fs::recursive_directory_iterator(), has_name);
}

// What a page names of the project: sources, scripts and pages in backquotes, folders and files by their paths.
std::set<std::string> names_in(const std::string& text) {
  static const std::regex kQuoted(R"(`([.\w][\w./-]*)`)");
  static const std::regex kSource(R"([\w./-]+\.(h|cpp|sh|py|cmake|md))");
  static const std::regex kPath(R"((delaunay|volume|raycast|surface|experiments|configs|tests|\.ci)/[\w./-]*)");
  std::set<std::string> names;
  for (std::sregex_iterator match(text.begin(), text.end(), kQuoted), end; match != end; ++match) {
    const std::string name = (*match)[1];
    const bool is_output = name == "table.md";
    if (!is_output && (std::regex_match(name, kSource) || std::regex_match(name, kPath))) names.insert(name);
  }
  return names;
}

// Where a page leads by links, those to other sites left out; and its pictures.
std::set<std::string> links_in(const std::string& text) {
  static const std::regex kLink(R"(\]\(([^)#\s]+)[^)]*\))");
  std::set<std::string> links;
  for (std::sregex_iterator match(text.begin(), text.end(), kLink), end; match != end; ++match) {
    if (!(*match)[1].str().starts_with("http")) links.insert((*match)[1]);
  }
  return links;
}

TEST(Pages, EveryTopFolderAndEveryWingHasAPageThatIsRead) {
  std::vector<std::string> folders(std::begin(kTopFolders), std::end(kTopFolders));
  for (const std::string& wing : surface_wings()) folders.push_back(wing);
  EXPECT_GE(folders.size(), 17u);
  for (const std::string& folder : folders) {
    const std::size_t lines = lines_of(page_text(folder + "/README.md")).size();
    EXPECT_GE(lines, 20u) << folder;
    EXPECT_LE(lines, folder == "surface" ? 160u : 80u) << folder;  // surface/ has the glossary
  }
}

TEST(Pages, TheFirstPageIsShort) { EXPECT_LE(lines_of(page_text("README.md")).size(), 200u); }

TEST(Pages, WhatAPageNamesIsThere) {
  std::size_t count = 0;
  for (const std::string& page : all_pages()) {
    const std::string text = page_text(page);
    for (const std::string& name : names_in(text)) EXPECT_TRUE(is_there(name, page)) << page << " names " << name;
    for (const std::string& link : links_in(text)) {
      EXPECT_TRUE(fs::exists((root() / page).parent_path() / link)) << page << " leads to " << link;
    }
    count += names_in(text).size();
  }
  EXPECT_GT(count, 150u);
}

TEST(Pages, AHeadingThatAPageLeadsToIsThere) {
  static const std::regex kHeading(R"(\]\(([^)#\s]+)#([\w-]+)\))");
  const std::string text = page_text("README.md");
  for (std::sregex_iterator match(text.begin(), text.end(), kHeading), end; match != end; ++match) {
    std::string heading = (*match)[2];
    std::replace(heading.begin(), heading.end(), '-', ' ');
    heading[0] = static_cast<char>(std::toupper(heading[0]));
    EXPECT_NE(page_text((*match)[1]).find("\n## " + heading + "\n"), std::string::npos) << heading;
  }
}

// A generated section: its name, and what stands between its markers.
std::vector<std::pair<std::string, std::string>> sections_of(const std::string& text) {
  std::vector<std::pair<std::string, std::string>> sections;
  const std::string begin = "<!-- generated: ";
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::size_t first = at + begin.size();
    const std::string name = text.substr(first, text.find_first_of(" ;", first) - first);
    const std::size_t last = text.find("<!-- end of " + name + " -->", first);
    EXPECT_NE(last, std::string::npos) << name << " has no end";
    if (last != std::string::npos) sections.emplace_back(name, text.substr(first, last - first));
  }
  return sections;
}

// Figures come from records: a section says of which commit, and how to make it where it has not been made.
TEST(Pages, GeneratedSectionsNameTheirCommit) {
  static const std::regex kCommit(R"(\nCommit [0-9a-f]{7,40}(,|;| |\.))");
  std::set<std::string> names;
  for (const std::string& page : all_pages()) {
    for (const auto& [name, text] : sections_of(page_text(page))) {
      EXPECT_TRUE(names.insert(name).second) << name << " stands twice";
      if (name == "parameters") continue;  // Schema.ThePageHoldsTheTableOfTheParameters
      const bool is_made = text.find("Not made yet: `experiments/regenerate_tables.py --only ") == std::string::npos;
      EXPECT_TRUE(!is_made || std::regex_search(text, kCommit)) << page << ", " << name;
    }
  }
  const std::set<std::string> expected = {"parameters",
                                          "table1",
                                          "table2",
                                          "table3",
                                          "table4",
                                          "fidelity",
                                          "ablations",
                                          "error_against_size",
                                          "two_threads",
                                          "seven_volumes",
                                          "noisy_isovalues",
                                          "time_by_stage",
                                          "verification",
                                          "compare_fields_vertices",
                                          "compare_fields_error",
                                          "compare_volumes_vertices",
                                          "compare_volumes_error"};
  EXPECT_EQ(names, expected);
}

std::vector<std::string> cells_of(const std::string& row) {
  static const std::regex kCell(R"(\|\s*([^|]*?)\s*(?=\|))");
  std::vector<std::string> cells;
  for (std::sregex_iterator match(row.begin(), row.end(), kCell), end; match != end; ++match) {
    cells.push_back((*match)[1]);
  }
  return cells;
}

// The columns "..., paper" show configs/reference, row by row.
TEST(Pages, TheTablesShowThePapersFigures) {
  int compared = 0;
  for (const auto& [name, text] : sections_of(page_text("configs/paper/README.md"))) {
    if (!name.starts_with("table")) continue;
    SCOPED_TRACE(name);
    const Json experiment = Json::parse(page_text("configs/paper/" + name + ".json"));
    const Json rows = Json::parse(page_text("configs/reference/" + name + ".json"))["rows"];
    std::vector<std::string> heads;
    for (const std::string& line : lines_of(text)) {
      const std::vector<std::string> cells = cells_of(line);
      if (cells.empty() || cells[0].starts_with("---")) continue;
      if (heads.empty()) {
        heads = cells;
        continue;
      }
      ASSERT_EQ(cells.size(), heads.size()) << line;
      for (const Json& metric : experiment["metrics"]) {
        if (!metric.contains("reference")) continue;
        const auto head = std::find(heads.begin(), heads.end(), metric["name"].get<std::string>() + ", paper");
        ASSERT_NE(head, heads.end()) << metric["name"];
        const std::string& shown = cells[static_cast<std::size_t>(head - heads.begin())];
        const Json& published = rows[cells[0]][metric["reference"].get<std::string>()];
        if (published.is_string()) {
          EXPECT_EQ(shown, published.get<std::string>()) << line;
        } else {
          EXPECT_NEAR(std::stod(shown) / published.get<double>(), 1, 1e-3) << line;
        }
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 6 * 13);
}

// Each ablation has its answer, and no answer is left over.
TEST(Pages, EveryAblationHasAnAnswer) {
  const std::string answers = page_text("configs/ablation/answers.txt");
  std::set<std::string> asked, answered;
  for (const auto& entry : fs::directory_iterator(root() / "configs/ablation")) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".json" && name != "fidelity") asked.insert(name);
  }
  static const std::regex kAnswer(R"((\w+): .*)");
  for (const std::string& line : lines_of(answers)) {
    std::smatch match;
    if (std::regex_match(line, match, kAnswer)) answered.insert(match[1]);
  }
  EXPECT_EQ(answered, asked);
}

TEST(Pages, WrongNamesWouldBeSeen) {
  EXPECT_EQ(names_in("`surface/a.h`, `b.cpp`, `configs/`, `report.json`, `--set`, `x = 1`, plain c.h"),
            (std::set<std::string>{"surface/a.h", "b.cpp", "configs/"}));
  EXPECT_TRUE(is_there("recover.h", "surface/recover/README.md"));
  EXPECT_TRUE(is_there("disk/refinement_disk.h", "surface/refine/README.md"));
  EXPECT_FALSE(is_there("recover.h", "volume/README.md"));
  EXPECT_FALSE(is_there("surface/no_such_file.h", "README.md"));
  EXPECT_EQ(links_in("[a](b/c.md#d), [e](https://f.g), ![h](i.png)"), (std::set<std::string>{"b/c.md", "i.png"}));
}

}  // namespace
}  // namespace deliso::testing

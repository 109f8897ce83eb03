// What configs/teaching holds is true: answers, errata, lab sheet, glossary.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "experiments/runs/answer_config.h"
#include "tests/support/pages.h"
#include "tests/support/run_examples.h"

namespace deliso::testing {
namespace {

namespace fs = std::filesystem;

const std::string kTeaching = "configs/teaching/";

std::vector<fs::path> teaching_experiments() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(root() / kTeaching)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Large pieces come up however few the rays are, small ones are lost: the answer of 3_seeding once more, from the
// table.
void expect_lost_components(const Json& table) {
  ASSERT_EQ(table["rows"].size(), 12u);
  for (const Json& row : table["rows"]) {
    SCOPED_TRACE(row.dump());
    const Json& components = row["cells"][0];
    ASSERT_EQ(components["metric"], "components");
    const bool is_blobs = row["dataset"] == "blobs";
    const int all = is_blobs ? 15 : row["dataset"] == "bubbles" ? 27 : 4;
    EXPECT_EQ(components["max"] == all, row["variant"] != "5 random rays" || !is_blobs);
    EXPECT_EQ(components["min"] == all, row["variant"] == "a point on every component" || !is_blobs);
    EXPECT_GE(components["min"], 4);
  }
}

// Seconds, and shares of seconds, are the machine's: an answer may show them, and claims nothing of them.
void expect_no_claim_of_time(const Experiment& experiment) {
  for (const Answer& answer : experiment.answers) {
    for (const Claim& claim : answer.holds) {
      const std::string name = parse_figure_reference(claim.figure, experiment, experiment.name).metric;
      const auto metric = std::find_if(experiment.metrics.begin(), experiment.metrics.end(),
                                       [&](const Metric& each) { return each.name == name; });
      ASSERT_NE(metric, experiment.metrics.end()) << name;
      EXPECT_EQ(metric->value.find("seconds"), std::string::npos) << claim.figure;
      EXPECT_EQ(metric->value.find("share_restricted"), std::string::npos) << claim.figure;
    }
  }
}

TEST(Teaching, EachExperimentAsksFirstAndItsAnswerHolds) {
  const std::vector<fs::path> files = teaching_experiments();
  EXPECT_EQ(files.size(), 8u);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file);
    const Experiment experiment = read_experiment(file);
    EXPECT_NE(experiment.question.find('?'), std::string::npos);
    expect_no_claim_of_time(experiment);
    const TemporaryFolder folder;
    const ProgramResult run = run_deliso({"run", file.string(), "--out", folder / "out"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_LT(run.out.find(experiment.question), run.out.find("\n| data set |"));

    std::size_t claims = 0;
    for (const Answer& answer : experiment.answers) {
      claims += answer.holds.size();
      EXPECT_FALSE(answer.holds.empty()) << answer.text;
      EXPECT_EQ(answer.unknown_variants, std::vector<std::string>());
      for (const TextPart& part : parts_of(answer.text)) {
        if (part.is_figure || part.text.size() <= 20) continue;
        EXPECT_EQ(run.out.find(part.text), std::string::npos) << part.text;
      }
    }
    EXPECT_GE(claims, 8u);
    const ProgramResult table = run_deliso({"table", folder / "out", "--answers"});
    EXPECT_EQ(table.exit_code, 0) << table.err;
    if (experiment.name == "3_seeding") expect_lost_components(read_json(folder / "out/table.json"));
  }
}

std::string python() {
  for (const std::string path : {"/usr/bin/python3", "/usr/local/bin/python3"}) {
    if (fs::exists(path)) return path;
  }
  return "";
}

ProgramResult worksheet(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {(root() / "experiments/worksheet.py").string(), "--deliso", DELISO_PROGRAM});
  return run_program_at(python(), arguments);
}

TEST(Teaching, TheErrataShowWhatTheProgramPrints) {
  if (python().empty()) GTEST_SKIP() << "needs python3";
  const ProgramResult result = worksheet({"--check", (root() / kTeaching / "errata.md").string()});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err
                                 << "experiments/worksheet.py --write configs/teaching/errata.md puts new outputs in";
}

TEST(Teaching, TheLabSheetHasNoSolutionsAndTheProgramMakesThem) {
  if (python().empty()) GTEST_SKIP() << "needs python3";
  const std::string sheet = page_text(kTeaching + "lab.md");
  bool inside = false;
  for (const std::string& line : lines_of(sheet)) {
    if (line.starts_with("```")) {
      inside = line == "```console";
    } else if (inside) {
      EXPECT_TRUE(line.starts_with("$ ")) << line;
    }
  }
  const ProgramResult result = worksheet({(root() / kTeaching / "lab.md").string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const std::string& line : lines_of(sheet)) EXPECT_NE(result.out.find(line), std::string::npos) << line;
  // Exercise 1: a tunnel below the value of the saddle, two disks above.
  EXPECT_NE(result.out.find("annulus      1                     0               2\n"), std::string::npos);
  EXPECT_NE(result.out.find("disk         2                     1               1\n"), std::string::npos);
  // Exercise 3: counted in the file without the program, V - E + F = 22 - 66 + 44 is that of a torus, and each edge has
  // two triangles.
  EXPECT_NE(result.out.find("\n22 44 0\n"), std::string::npos);
  EXPECT_NE(result.out.find("\n66 edges with 2 triangles\n```"), std::string::npos);
  // Every answer was printed.
  std::size_t answers = 0;
  for (std::size_t at = result.out.find("\n## Answer\n"); at != std::string::npos; ++answers) {
    at = result.out.find("\n## Answer\n", at + 1);
  }
  EXPECT_EQ(answers, teaching_experiments().size());
}

TEST(Teaching, ACommandThatFailsOrABlockWithoutAnEndIsAnError) {
  if (python().empty()) GTEST_SKIP() << "needs python3";
  const TemporaryFolder folder;
  const auto run = [&](const std::string& page) {
    write_file(folder / "page.md", page);
    return worksheet({"--check", folder / "page.md"});
  };
  EXPECT_EQ(run("```console\n$ echo a; echo b >&2\na\nb\n```\n").exit_code, 0);
  const ProgramResult other = run("```console\n$ echo a\nb\n```\n");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.out.find("\n-b\n+a\n"), std::string::npos) << other.out;
  const ProgramResult failed = run("```console\n$ deliso topology nothing.nrrd --isovalue 1\n```\n");
  EXPECT_EQ(failed.exit_code, 2);
  EXPECT_NE(failed.err.find("worksheet.py: ended with 2: deliso topology nothing.nrrd"), std::string::npos);
  EXPECT_EQ(run("```console\n$ true\n").exit_code, 2);
}

// The names of all tests, "Suite.Name".
std::set<std::string> test_names() {
  static const std::regex kTest(R"(TEST(?:_F|_P)?\((\w+),\s*(\w+)\))");
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(root() / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = read_text(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), kTest), end; match != end; ++match) {
      names.insert((*match)[1].str() + "." + (*match)[2].str());
    }
  }
  return names;
}

TEST(Teaching, EveryErratumHasItsPlaceItsCommandAndTestsThatExist) {
  const std::string page = page_text(kTeaching + "errata.md");
  std::vector<std::size_t> begins;
  for (std::size_t at = page.find("\n## "); at != std::string::npos; at = page.find("\n## ", at + 1)) {
    begins.push_back(at);
  }
  EXPECT_GE(begins.size(), 14u);
  begins.push_back(page.size());
  for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
    const std::string entry = page.substr(begins[i], begins[i + 1] - begins[i]);
    EXPECT_EQ(entry.find("\n## " + std::to_string(i + 1) + ". "), 0u) << entry;
    for (const std::string part : {"\n**Where.** ", "\n**What.** ", "```console\n$ ", "\n**Here.** "}) {
      EXPECT_NE(entry.find(part), std::string::npos) << part << entry;
    }
  }
  static const std::regex kName(R"(`([A-Z]\w+\.[A-Z]\w+)`)");
  const std::set<std::string> known = test_names();
  std::size_t named = 0;
  for (std::sregex_iterator match(page.begin(), page.end(), kName), end; match != end; ++match, ++named) {
    EXPECT_TRUE(known.contains((*match)[1])) << (*match)[1];
  }
  EXPECT_GE(named, 6u);
}

// A program reads it: word, section of the paper, meaning, page, one line each.
TEST(Teaching, TheGlossaryIsOneWordALine) {
  static const std::regex kLine(
      R"(\| ([^|`]+) \| (-|\d(?:\.\d){0,2}) \| ([^|`]+\.) \| (-|`configs/teaching/[\w.]+`) \|)");
  const std::vector<std::string> lines = lines_of(page_text(kTeaching + "glossary.md"));
  const auto first = std::find(lines.begin(), lines.end(), "|---|---|---|---|");
  ASSERT_NE(first, lines.end());
  std::string last;
  std::size_t words = 0;
  for (auto line = first + 1; line != lines.end(); ++line, ++words) {
    std::smatch match;
    ASSERT_TRUE(std::regex_match(*line, match, kLine)) << *line;
    std::string word = match[1];
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
    EXPECT_LT(last, word);  // in order, and none twice
    last = word;
    EXPECT_LE(match[3].length(), 220) << "too long for a tooltip: " << match[3];
  }
  EXPECT_GE(words, 30u);
}

}  // namespace
}  // namespace deliso::testing

// `deliso table --by`: programs compared by paired runs; and the files for papers beside a table.
#include "experiments/results/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "experiments/results/table_files.h"
#include "tests/support/run_examples.h"

namespace deliso::testing {
namespace {

// Two variants, three repeats; times are made up from the record's data by `seconds`.
template <class Seconds>
void write_compared(const TemporaryFolder& folder, const std::string& name, const std::string& commit,
                    const Seconds& seconds) {
  Json document = small_document();
  document["metrics"] = Json::array({Json{{"name", "seconds_of"}, {"value", "total_seconds"}},
                                     Json{{"name", "vertices"}, {"value", "vertices"}},
                                     Json{{"name", "verdict"}, {"value", "certificate.verdict"}}});
  std::filesystem::create_directories(folder / name);
  write_file(folder / (name + "/experiment.json"),
             json_text(experiment_to_json(parse_experiment(document, "small.json"))));
  std::string text;
  for (const char* dataset : {"ball", "ring"}) {
    for (const char* variant : {"fine", "coarse"}) {
      for (int repeat = 1; repeat <= 3; ++repeat) {
        text += Json{{"experiment", "small"},
                     {"dataset", dataset},
                     {"variant", variant},
                     {"repeat", repeat},
                     {"status", "done"},
                     {"seed", repeat},
                     {"vertices", 100},
                     {"total_seconds", seconds(std::string(dataset), repeat)},
                     {"certificate", {{"verdict", commit == "b" && repeat == 2 ? "different" : "homeomorphic"}}},
                     {"program", {{"commit", commit}, {"version", "1"}}}}
                    .dump() +
                "\n";
      }
    }
  }
  write_file(folder / (name + "/records.jsonl"), text);
}

TEST(Comparison, PairsRunsByDataSetVariantAndSeed) {
  const TemporaryFolder folder;
  // Runs differ a thousandfold among each other, their quotients do not: 2 on the ball, 0.5 on the ring.
  write_compared(folder, "A", "a", [](const std::string&, int repeat) { return std::pow(1000.0, repeat); });
  write_compared(folder, "B", "b", [](const std::string& dataset, int repeat) {
    return std::pow(1000.0, repeat) * (dataset == "ball" ? 2 : 0.5);
  });
  const ProgramResult result = run_deliso({"table", folder / "A", folder / "B", "--by", "commit", "-o", folder / "T"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("## b over a"), std::string::npos);
  EXPECT_NE(result.out.find("| ball | fine | 3 | 2 | 1 | 1 of 3 differ |"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("| ring | coarse | 3 | 0.5 | 1 | 1 of 3 differ |"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("| all |  | 12 | 1 | 1 | 4 of 12 differ |"), std::string::npos) << result.out;
  EXPECT_EQ(read_file(folder / "T/comparison.md"), result.out);
  for (const char* name : {"comparison.csv", "comparison.json", "comparison.tex"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / ("T/" + std::string(name)))) << name;
  }
  // The other way round is the reciprocal.
  const ProgramResult other = run_deliso({"table", folder / "B", folder / "A", "--by", "commit", "-o", folder / "T"});
  EXPECT_NE(other.out.find("| ball | fine | 3 | 0.5 |"), std::string::npos) << other.out;
}

TEST(Comparison, RefusesWhatCannotBeCompared) {
  const TemporaryFolder folder;
  write_compared(folder, "A", "a", [](const std::string&, int) { return 1.0; });
  const auto message = [&](const std::string& by) {
    const ProgramResult result = run_deliso({"table", folder / "A", "--by", by});
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  EXPECT_EQ(message("commit"), "deliso: --by commit: all records are of commit 'a', expected those of two at least\n");
  EXPECT_EQ(message("comit"), "deliso: --by: expected commit, version, compiler, flags or cpu, found 'comit'\n");
}

// The interval is that of the normal distribution where there are many pairs, and the same at every call.
TEST(Comparison, TheIntervalIsThatOfTheMean) {
  std::vector<std::vector<double>> rows(2);
  for (int i = 0; i < 400; ++i) rows[static_cast<std::size_t>(i) % 2].push_back(0.1 + (i % 4 < 2 ? 0.3 : -0.3));
  const Quotients quotients = summary_of(rows);
  EXPECT_EQ(quotients.pairs, 400U);
  EXPECT_NEAR(std::log(quotients.mean), 0.1, 1e-12);
  ASSERT_TRUE(quotients.interval);
  const double error = 1.96 * 0.3 / std::sqrt(400);
  EXPECT_NEAR(std::log((*quotients.interval)[0]), 0.1 - error, 0.1 * error);
  EXPECT_NEAR(std::log((*quotients.interval)[1]), 0.1 + error, 0.1 * error);
  EXPECT_EQ(*quotients.interval, *summary_of(rows).interval);
  // What differs between rows alone is no chance.
  const Quotients constant = summary_of({{1, 1, 1}, {-1, -1, -1}});
  EXPECT_EQ(constant.mean, 1);
  EXPECT_EQ((*constant.interval)[0], 1);
  EXPECT_EQ((*constant.interval)[1], 1);
  EXPECT_FALSE(summary_of({{0.5}}).interval);
}

TEST(TableFiles, LatexHasNoBareSpecialCharacters) {
  EXPECT_EQ(latex_text("<1|2>"), "\\textless{}1\\textbar{}2\\textgreater{}");
  EXPECT_EQ(latex_text("a_b & 5 % of #1 {x} ~^\\ $ 1–2"),
            "a\\_b \\& 5 \\% of \\#1 \\{x\\} \\~{}\\^{}\\textbackslash{} \\$ 1--2");
  const TemporaryFolder folder;
  write_compared(folder, "A", "a", [](const std::string&, int repeat) { return repeat; });
  ASSERT_EQ(run_deliso({"table", folder / "A"}).exit_code, 0);
  const std::string latex = read_file(folder / "A/table.tex");
  EXPECT_NE(
      latex.find("\\begin{tabular}{llrrr}\n\\toprule\ndata set & variant & seconds\\_of & vertices & verdict \\\\\n"
                 "\\midrule\nball & fine & 2 (1--3) & 100 & homeomorphic \\\\\n & coarse & "),
      std::string::npos)
      << latex;
  EXPECT_NE(latex.find("\\bottomrule\n\\end{tabular}\n"), std::string::npos);
}

// Where matplotlib is there.
TEST(TableFiles, TheScriptDrawsTheTable) {
  if (std::system("python3 -c 'import matplotlib' >/dev/null 2>&1") != 0 &&
      std::system("/usr/bin/python3 -c 'import matplotlib' >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "matplotlib is not there (Debian: python3-matplotlib)";
  }
  const TemporaryFolder folder;
  Json document = small_document();
  document["plots"] = parse_json(R"([
    {"name": "a", "title": "A", "kind": "curve", "x": "vertices", "y": ["share"], "log": ["x"]},
    {"name": "b", "title": "B", "kind": "bars", "y": ["vertices", "share"], "share": true},
    {"name": "c", "title": "C", "kind": "histogram", "value": "quality.min_angle_histogram", "bin_width": 5,
     "x_label": "angle"}])",
                                 "plots");
  for (const bool has_plots : {true, false}) {
    if (!has_plots) document.erase("plots");
    write_file(folder / "small.json", json_text(document));
    const std::string out = folder / (has_plots ? "plots" : "plain");
    ASSERT_EQ(run_deliso({"run", folder / "small.json", "--out", out}).exit_code, 0);
    EXPECT_EQ(std::system(("PATH=/usr/bin:$PATH python3 '" + out + "/table.py'").c_str()), 0);
    for (const std::string name : {"a", "b", "c", "table"}) {
      EXPECT_EQ(std::filesystem::exists(std::filesystem::path(out) / (name + ".pdf")), has_plots == (name != "table"));
    }
  }
}

}  // namespace
}  // namespace deliso::testing

// Programs compared by their records: how much more or less each figure is, run by run.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/json.h"
#include "experiments/runs/experiment.h"

namespace deliso {

// Of a record's program, what tells the compared ones apart.
inline constexpr std::array<std::string_view, 5> kComparedBy = {"commit", "version", "compiler", "flags", "cpu"};

// The quotients of paired runs: one of the other program over that of the first with the same data set, variant and
// seed.
struct Quotients {
  std::size_t pairs = 0;
  double mean = 1;  // geometric
  // 95 % of the means of samples of the pairs, drawn with replacement by a generator of our own with a fixed seed; none
  // with fewer than two pairs. Of all rows together each row is drawn from on its own.
  std::optional<std::array<double, 2>> interval;
  std::size_t unequal = 0;  // pairs whose figures differ; for texts all that is told
  bool is_text = false;
};

struct ComparisonRow {
  std::string dataset;  // empty: all
  std::string variant;
  std::vector<Quotients> figures;  // one for each metric
};

struct Comparison {
  std::string by;
  std::string first;  // what all others are compared with: of the first record
  struct Other {
    std::string name;
    std::vector<ComparisonRow> rows;  // the last is of all
    std::size_t unpaired = 0;         // runs that one of the two has alone
  };
  std::vector<Other> others;
};

// The mean and its interval. `rows`: logarithms of quotients.
Quotients summary_of(const std::vector<std::vector<double>>& rows);

// From the finished records of the folders, with the metrics of the first folder's experiment; the experiments need not
// be the same. Throws InputError when the records are of one program only, or no two runs pair.
Comparison compare_programs(const Experiment& experiment, const std::vector<std::filesystem::path>& folders,
                            const std::string& by);

std::string comparison_markdown(const Experiment& experiment, const Comparison& comparison);
std::string comparison_csv(const Experiment& experiment, const Comparison& comparison);
std::string comparison_latex(const Experiment& experiment, const Comparison& comparison);
Json comparison_json(const Experiment& experiment, const Comparison& comparison);

}  // namespace deliso

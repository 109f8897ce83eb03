// The table of an experiment, from its records.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/json.h"
#include "experiments/runs/experiment.h"

namespace deliso {

// One figure over the repeats of a run: numbers, or texts.
struct Figure {
  std::vector<double> numbers;  // ascending
  // Of figures that are not numbers: the text, or each text with its number of occurrences.
  std::string text;

  [[nodiscard]] bool empty() const { return numbers.empty() && text.empty(); }
  // The middle one, or the mean of the two in the middle. Precondition: numbers is not empty.
  [[nodiscard]] double median() const;
};

// Moving nlohmann's JSON is not declared noexcept. NOLINTNEXTLINE(bugprone-exception-escape)
struct TableCell {
  Figure ours;
  Json reference;               // a number or a text; null: none
  std::optional<double> ratio;  // our median over the reference
};

enum class RowState { kDone, kFailed, kAbsent, kNotRun };

struct TableRow {
  std::string dataset;
  std::string variant;  // empty where a row is a data set
  RowState state = RowState::kNotRun;
  std::vector<TableCell> cells;  // one for each metric
};

struct Table {
  std::vector<TableRow> rows;
  // What a reader must know: absent data sets and how to get them, failed runs, missing runs.
  std::vector<std::string> remarks;
  // Of the programs and machines that made the records, each once.
  std::vector<std::string> programs;
  // How many runs at most were made at a time: above 1, the times of runs are marked as shared.
  std::int64_t runs_at_a_time = 1;
  // With how many threads the runs were made: times of different numbers are not to be compared.
  std::set<std::int64_t> threads;
};

// The records must be of this experiment (otherwise InputError), at most one for each run, in any order.
Table make_table(const Experiment& experiment, const std::vector<Json>& records);

// "median (smallest–largest)", or the median alone where all agree; a text as it is; kNoFigure where there is none.
std::string spread_text(const Figure& figure);

// What follows the name of a metric whose times are shared; empty for others.
std::string shared_mark(const Metric& metric, const Table& table);
// Sentences on the times that the table shows: that they are shared, that numbers of threads differ.
std::vector<std::string> time_notes(const Experiment& experiment, const Table& table);

// With title, question, how to read it, remarks.
std::string table_markdown(const Experiment& experiment, const Table& table);

// One line for each row and metric: dataset, variant, metric, runs, median, min, max, text, reference.
std::string table_csv(const Experiment& experiment, const Table& table);

Json table_json(const Experiment& experiment, const Table& table);

// "done", "failed", "absent", "not run".
std::string state_name(RowState state);

// Shown where there is no figure.
inline constexpr std::string_view kNoFigure = "–";

// Integers and numbers from 1000 on without a fraction, others with four significant digits, small ones as "1.54e-3".
std::string figure_text(double value);

}  // namespace deliso

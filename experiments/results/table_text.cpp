// Tables as Markdown, CSV and JSON.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "experiments/config/config.h"
#include "experiments/results/table.h"
#include "experiments/runs/experiment_config.h"

namespace deliso {
namespace {

constexpr const char* kTableSchema = "deliso-table-1";
constexpr double kSmall = 0.01;  // numbers below are written with an exponent
constexpr const char* kThinkFirst =
    "Decide what you expect before you read the table; `deliso table FOLDER --answers` prints the answer below it.";
constexpr const char* kTo = "–";  // "10–30"

// All digits: the number reads back as it was.
std::string exact_text(double value) { return Json(value).dump(); }

std::string reference_text(const Json& value) {
  if (value.is_null()) return std::string(kNoFigure);
  if (value.is_string()) return value.get<std::string>();
  const auto number = value.get<double>();
  // A published value is shown with all its digits.
  const bool in_full = number == std::floor(number) || std::abs(number) < kSmall;
  return in_full ? figure_text(number) : exact_text(number);
}

// A cell of Markdown, escaped: a bar would end the cell, a line break the row.
std::string markdown_cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + markdown_cell(cell) + " |";
  return row + "\n";
}

bool shows_variants(const Experiment& experiment) {
  return experiment.rows == RowKind::kRuns && experiment.variants.size() > 1;
}

// A note may begin with a mark, which Markdown would take for a list.
std::string notes_text(const Experiment& experiment, const Table& table) {
  std::string text;
  for (const std::string& note : time_notes(experiment, table)) {
    text += std::string("\n") + (note.starts_with('*') ? "\\" : "") + note + "\n";
  }
  return text;
}

std::string markdown_header(const Experiment& experiment, const Table& table) {
  std::vector<std::string> names = {"data set"};
  std::string rule = "|---|";
  if (shows_variants(experiment)) {
    names.emplace_back("variant");
    rule += "---|";
  }
  for (const Metric& metric : experiment.metrics) {
    if (!metric.reference.empty()) names.push_back(metric.name + ", paper");
    names.push_back(metric.name + (metric.reference.empty() ? "" : ", ours") + shared_mark(metric, table));
    if (metric.ratio) names.push_back(metric.name + ", ours / paper");
  }
  for (std::size_t i = shows_variants(experiment) ? 2 : 1; i < names.size(); ++i) rule += "---:|";
  return markdown_row(names) + rule + "\n";
}

std::string markdown_body(const Experiment& experiment, const Table& table) {
  std::string text;
  for (const TableRow& row : table.rows) {
    std::vector<std::string> cells = {row.dataset};
    if (shows_variants(experiment)) cells.push_back(row.variant);
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const TableCell& cell = row.cells[i];
      const Metric& metric = experiment.metrics[i];
      if (!metric.reference.empty()) cells.push_back(reference_text(cell.reference));
      cells.push_back(row.state == RowState::kDone ? spread_text(cell.ours) : state_name(row.state));
      if (metric.ratio) cells.push_back(cell.ratio ? figure_text(*cell.ratio) : std::string(kNoFigure));
    }
    text += markdown_row(cells);
  }
  return text;
}

// " with `search.traversal` = kd_tree, `certify` = false", or nothing where nothing differs.
std::string changes_text(const Parameters& from, const Parameters& to) {
  std::string text;
  const Json changes = parameter_changes(from, to);
  for (const auto& [path, value] : changes.items()) {
    text.append(text.empty() ? " with `" : ", `").append(path).append("` = ");
    text += value.is_string() ? value.get<std::string>() : value.dump();
  }
  return text;
}

// "- kd-tree: the parameters 'default' with `search.traversal` = kd_tree"
std::string variant_line(const Experiment& experiment, const Variant& variant) {
  std::string text = "- " + variant.name + ": ";
  if (variant.mesher == Mesher::kMarchingCubes) return text + "marching cubes\n";
  if (variant.mesher == Mesher::kCommand) {
    // The program by its name: where it lies is of no interest to readers.
    text += "`" + std::filesystem::path(variant.command.arguments.front()).filename().string();
    for (std::size_t i = 1; i < variant.command.arguments.size(); ++i) text += " " + variant.command.arguments[i];
    return text + "`\n";
  }
  text += "the parameters '" + experiment.base.name + "'";
  return text + changes_text(experiment.base.parameters, variant.parameters) + "\n";
}

// The base of all variants, as changes of the program's defaults, and what each variant changes of the base.
std::string variants_text(const Experiment& experiment) {
  std::string text = "\nThe parameters '" + experiment.base.name + "' are the program's defaults" +
                     changes_text(Parameters(), experiment.base.parameters) + ".\n\nVariants:\n\n";
  for (const Variant& variant : experiment.variants) text += variant_line(experiment, variant);
  return text;
}

std::string repeats_line(const Experiment& experiment) {
  if (experiment.repeats == 1) return "One run each, seed " + std::to_string(experiment.seed) + ".";
  return "Median (smallest" + std::string(kTo) + "largest) of " + std::to_string(experiment.repeats) + " runs, seeds " +
         std::to_string(experiment.seed) + " to " + std::to_string(seed_of(experiment, experiment.repeats)) + ".";
}

// Quoted where necessary (RFC 4180).
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

Json cell_json(const Metric& metric, const TableCell& cell) {
  Json json{{"metric", metric.name}, {"runs", cell.ours.numbers.size()}};
  if (!cell.ours.numbers.empty()) {
    json["median"] = cell.ours.median();
    json["min"] = cell.ours.numbers.front();
    json["max"] = cell.ours.numbers.back();
  }
  if (!cell.ours.text.empty()) json["text"] = cell.ours.text;
  if (!cell.reference.is_null()) json["reference"] = cell.reference;
  if (cell.ratio) json["ratio"] = *cell.ratio;
  return json;
}

// "1.54e-3", with four significant digits but no zeros at the end.
std::string small_text(double value) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.3e", value);
  const std::string text = buffer.data();
  const std::size_t e = text.find('e');
  std::string digits = text.substr(0, e);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits + "e" + std::to_string(std::stoi(text.substr(e + 1)));
}

}  // namespace

std::string figure_text(double value) {
  constexpr double kLarge = 1000;
  std::array<char, 40> buffer{};
  const bool whole = value == std::floor(value) && std::abs(value) < 1e15;
  if (!whole && std::abs(value) < kSmall) return small_text(value);
  std::snprintf(buffer.data(), buffer.size(), whole || std::abs(value) >= kLarge ? "%.0f" : "%.4g", value);
  return buffer.data();
}

std::string spread_text(const Figure& figure) {
  if (figure.numbers.empty()) return figure.text.empty() ? std::string(kNoFigure) : figure.text;
  const std::string low = figure_text(figure.numbers.front());
  const std::string high = figure_text(figure.numbers.back());
  const std::string median = figure_text(figure.median());
  return low == high ? median : median + " (" + low + kTo + high + ")";
}

std::string table_markdown(const Experiment& experiment, const Table& table) {
  std::string text = "# " + experiment.title + "\n\n";
  if (!experiment.question.empty()) text += experiment.question + "\n\n";
  for (const std::string& note : experiment.notes) text += note + "\n\n";
  if (!experiment.answers.empty()) text += std::string(kThinkFirst) + "\n\n";
  text += markdown_header(experiment, table) + markdown_body(experiment, table) + "\n";
  text += repeats_line(experiment) + "\n" + notes_text(experiment, table);
  if (!experiment.reference.source.empty()) text += "\nPaper: " + experiment.reference.source + "\n";
  if (experiment.task == Task::kMesh) text += variants_text(experiment);
  if (!table.remarks.empty()) text += "\nRemarks:\n\n";
  for (const std::string& remark : table.remarks) text += "- " + remark + "\n";
  if (!table.programs.empty()) text += "\nMade by:\n\n";
  for (const std::string& program : table.programs) text += "- " + program + "\n";
  return text;
}

std::string table_csv(const Experiment& experiment, const Table& table) {
  std::string text = "dataset,variant,state,metric,runs,median,min,max,text,reference,ratio\n";
  for (const TableRow& row : table.rows) {
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const TableCell& cell = row.cells[i];
      const std::vector<double>& numbers = cell.ours.numbers;
      const bool has_numbers = !numbers.empty();
      const std::vector<std::string> cells = {row.dataset,
                                              row.variant,
                                              state_name(row.state),
                                              experiment.metrics[i].name,
                                              std::to_string(numbers.size()),
                                              has_numbers ? exact_text(cell.ours.median()) : "",
                                              has_numbers ? exact_text(numbers.front()) : "",
                                              has_numbers ? exact_text(numbers.back()) : "",
                                              cell.ours.text,
                                              cell.reference.is_string()
                                                  ? cell.reference.get<std::string>()
                                                  : (cell.reference.is_null() ? "" : cell.reference.dump()),
                                              cell.ratio ? exact_text(*cell.ratio) : ""};
      for (std::size_t c = 0; c < cells.size(); ++c) text += (c == 0 ? "" : ",") + csv_cell(cells[c]);
      text += '\n';
    }
  }
  return text;
}

Json table_json(const Experiment& experiment, const Table& table) {
  Json rows = Json::array();
  for (const TableRow& row : table.rows) {
    Json& json = rows.emplace_back(Json{{"dataset", row.dataset}, {"state", state_name(row.state)}});
    if (!row.variant.empty()) json["variant"] = row.variant;
    Json& cells = json["cells"] = Json::array();
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      cells.push_back(cell_json(experiment.metrics[i], row.cells[i]));
    }
  }
  return Json{
      {"schema", kTableSchema},          {"experiment", experiment.name}, {"title", experiment.title},
      {"question", experiment.question}, {"notes", experiment.notes},     {"rows", rows},
      {"remarks", table.remarks},        {"programs", table.programs},    {"runs_at_a_time", table.runs_at_a_time},
      {"threads", table.threads}};
}

}  // namespace deliso

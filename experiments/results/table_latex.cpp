#include "experiments/results/table_files.h"

#include <array>
#include <string_view>
#include <vector>

namespace deliso {
namespace {

std::string latex_row(const std::vector<std::string>& cells) {
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i) row += (i == 0 ? "" : " & ") + latex_text(cells[i]);
  return row + " \\\\\n";
}

// What LaTeX's usual encoding of fonts shows as something else, and how it calls it.
constexpr std::string_view kOtherGlyphs = "\\<>|";
constexpr std::array<std::string_view, 4> kGlyphNames = {"\\textbackslash{}", "\\textless{}", "\\textgreater{}",
                                                         "\\textbar{}"};

}  // namespace

std::string latex_text(const std::string& text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (text.compare(i, 3, "–") == 0) {
      escaped += "--";
      i += 2;
    } else if (const std::size_t at = kOtherGlyphs.find(c); at != std::string_view::npos) {
      escaped += kGlyphNames[at];
    } else if (c == '~' || c == '^') {
      escaped += std::string("\\") + c + "{}";
    } else if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) {
      escaped += std::string("\\") + c;
    } else {
      escaped += c == '\n' ? ' ' : c;
    }
  }
  return escaped;
}

std::string table_latex(const Experiment& experiment, const Table& table) {
  const bool has_variants = experiment.rows == RowKind::kRuns && experiment.variants.size() > 1;
  std::vector<std::string> names = {"data set"};
  if (has_variants) names.emplace_back("variant");
  std::string columns(names.size(), 'l');
  for (const Metric& metric : experiment.metrics) {
    if (!metric.reference.empty()) names.push_back(metric.name + ", paper");
    names.push_back(metric.name + shared_mark(metric, table));
    columns.append(metric.reference.empty() ? 1 : 2, 'r');
  }
  std::string text = "% " + latex_text(experiment.title) + "; \\usepackage{booktabs}\n";
  for (const std::string& program : table.programs) text += "% " + latex_text(program) + "\n";
  text += "\\begin{tabular}{" + columns + "}\n\\toprule\n" + latex_row(names) + "\\midrule\n";
  std::string previous;
  for (const TableRow& row : table.rows) {
    // A data set's name stands once, and a thin rule before the next.
    if (has_variants && !previous.empty() && previous != row.dataset) text += "\\addlinespace\n";
    std::vector<std::string> cells = {has_variants && previous == row.dataset ? "" : row.dataset};
    previous = row.dataset;
    if (has_variants) cells.push_back(row.variant);
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const TableCell& cell = row.cells[i];
      if (!experiment.metrics[i].reference.empty()) {
        cells.push_back(cell.reference.is_string()   ? cell.reference.get<std::string>()
                        : cell.reference.is_number() ? figure_text(cell.reference.get<double>())
                                                     : std::string(kNoFigure));
      }
      cells.push_back(row.state == RowState::kDone ? spread_text(cell.ours) : state_name(row.state));
    }
    text += latex_row(cells);
  }
  text += "\\bottomrule\n";
  for (const std::string& note : time_notes(experiment, table)) {
    text += "\\multicolumn{" + std::to_string(columns.size()) + "}{l}{" + latex_text(note) + "} \\\\\n";
  }
  return text + "\\end{tabular}\n";
}

}  // namespace deliso

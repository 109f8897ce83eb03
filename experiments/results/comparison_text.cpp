// Comparisons of programs as Markdown, CSV, LaTeX and JSON.
#include <algorithm>

#include "experiments/results/comparison.h"
#include "experiments/results/table.h"
#include "experiments/results/table_files.h"

namespace deliso {
namespace {

std::string quotient_text(const Quotients& quotients) {
  if (quotients.pairs == 0) return std::string(kNoFigure);
  if (quotients.is_text) {
    return quotients.unequal == 0
               ? "equal"
               : std::to_string(quotients.unequal) + " of " + std::to_string(quotients.pairs) + " differ";
  }
  std::string text = figure_text(quotients.mean);
  if (quotients.interval) {
    const std::string low = figure_text((*quotients.interval)[0]);
    const std::string high = figure_text((*quotients.interval)[1]);
    if (low != text || high != text) text += " [" + low + ", " + high + "]";
  }
  return text;
}

std::string row_name(const std::string& name) { return name.empty() ? "all" : name; }

}  // namespace

std::string comparison_markdown(const Experiment& experiment, const Comparison& comparison) {
  std::string text = "# " + experiment.title + ", by " + comparison.by + "\n";
  for (const Comparison::Other& other : comparison.others) {
    text += "\n## " + other.name + " over " + comparison.first + "\n\n| data set | variant | pairs |";
    std::string rule = "|---|---|---:|";
    for (const Metric& metric : experiment.metrics) {
      text += " " + metric.name + " |";
      rule += "---:|";
    }
    text += "\n" + rule + "\n";
    for (const ComparisonRow& row : other.rows) {
      std::size_t pairs = 0;
      for (const Quotients& quotients : row.figures) pairs = std::max(pairs, quotients.pairs);
      text += "| " + row_name(row.dataset) + " | " + row.variant + " | " + std::to_string(pairs) + " |";
      for (const Quotients& quotients : row.figures) text += " " + quotient_text(quotients) + " |";
      text += "\n";
    }
    text +=
        "\nGeometric means of the quotients of runs with the same data set, variant and seed; in brackets 95 % of "
        "their "
        "bootstrap samples.\n";
    if (other.unpaired > 0) text += "\nRuns without a partner: " + std::to_string(other.unpaired) + ".\n";
  }
  return text;
}

std::string comparison_latex(const Experiment& experiment, const Comparison& comparison) {
  std::string text = "% " + latex_text(experiment.title) + "; \\usepackage{booktabs}\n";
  for (const Comparison::Other& other : comparison.others) {
    text += "% " + latex_text(other.name + " over " + comparison.first) + "\n\\begin{tabular}{ll" +
            std::string(experiment.metrics.size(), 'r') + "}\n\\toprule\ndata set & variant";
    for (const Metric& metric : experiment.metrics) text += " & " + latex_text(metric.name);
    text += " \\\\\n\\midrule\n";
    for (const ComparisonRow& row : other.rows) {
      if (row.dataset.empty()) text += "\\midrule\n";
      text += latex_text(row_name(row.dataset)) + " & " + latex_text(row.variant);
      for (const Quotients& quotients : row.figures) text += " & " + latex_text(quotient_text(quotients));
      text += " \\\\\n";
    }
    text += "\\bottomrule\n\\end{tabular}\n";
  }
  return text;
}

std::string comparison_csv(const Experiment& experiment, const Comparison& comparison) {
  std::string text = "first,other,dataset,variant,metric,pairs,ratio,low,high,unequal\n";
  const auto quoted = [](const std::string& cell) {
    std::string all = "\"";
    for (const char c : cell) all += c == '"' ? std::string("\"\"") : std::string(1, c);
    return all + "\"";
  };
  for (const Comparison::Other& other : comparison.others) {
    for (const ComparisonRow& row : other.rows) {
      for (std::size_t i = 0; i < row.figures.size(); ++i) {
        const Quotients& q = row.figures[i];
        const bool has_ratio = q.pairs > 0 && !q.is_text;
        text += quoted(comparison.first) + "," + quoted(other.name) + "," + quoted(row_name(row.dataset)) + "," +
                quoted(row.variant) + "," + quoted(experiment.metrics[i].name) + "," + std::to_string(q.pairs) + "," +
                (has_ratio ? Json(q.mean).dump() : "") + "," + (q.interval ? Json((*q.interval)[0]).dump() : "") + "," +
                (q.interval ? Json((*q.interval)[1]).dump() : "") + "," + std::to_string(q.unequal) + "\n";
      }
    }
  }
  return text;
}

Json comparison_json(const Experiment& experiment, const Comparison& comparison) {
  Json others = Json::array();
  for (const Comparison::Other& other : comparison.others) {
    Json rows = Json::array();
    for (const ComparisonRow& row : other.rows) {
      Json figures = Json::array();
      for (std::size_t i = 0; i < row.figures.size(); ++i) {
        const Quotients& q = row.figures[i];
        Json& figure = figures.emplace_back(
            Json{{"metric", experiment.metrics[i].name}, {"pairs", q.pairs}, {"unequal", q.unequal}});
        if (q.pairs > 0 && !q.is_text) figure["ratio"] = q.mean;
        if (q.interval) figure["interval"] = *q.interval;
      }
      rows.push_back(Json{{"dataset", row_name(row.dataset)}, {"variant", row.variant}, {"figures", figures}});
    }
    others.push_back(Json{{comparison.by, other.name}, {"unpaired", other.unpaired}, {"rows", rows}});
  }
  return Json{{"schema", "deliso-comparison-1"},
              {"experiment", experiment.name},
              {"by", comparison.by},
              {"first", comparison.first},
              {"others", others}};
}

}  // namespace deliso

#include "experiments/results/answers.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "delaunay/base/check.h"
#include "experiments/runs/answer_config.h"
#include "experiments/runs/experiment_keys.h"

namespace deliso {
namespace {

// A number with two significant digits: how many times as much.
std::string quotient_text(double value) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), value < 99.5 ? "%.2g" : "%.0f", value);
  return buffer.data();
}

// Finds the figures that answers refer to.
class FigureFinder {
 public:
  FigureFinder(const Experiment& experiment, const Table& table) : experiment_(experiment), table_(table) {}

  // The figure of a reference without braces; empty where its runs are not finished.
  [[nodiscard]] Figure find(const std::string& text) const {
    const FigureReference reference = parse_figure_reference(text, experiment_, experiment_.name + "#/answers");
    if (reference.unknown_variant) return {};
    Figure figure = cell_figure(reference, reference.variant);
    if (!reference.over.empty()) {
      const Figure over = cell_figure(reference, reference.over);
      if (figure.numbers.empty() || over.numbers.empty() || over.median() == 0) return {};
      return Figure{{figure.median() / over.median()}, ""};
    }
    if (reference.statistic == Statistic::kAll || figure.numbers.empty()) return figure;
    const std::array<double, 3> choices = {figure.numbers.front(), figure.median(), figure.numbers.back()};
    return Figure{{choices[static_cast<std::size_t>(reference.statistic) - 1]}, ""};
  }

  // As it stands in a sentence.
  [[nodiscard]] std::string text_of(const std::string& reference) const {
    const Figure figure = find(reference);
    const bool is_quotient = !parse_figure_reference(reference, experiment_, "").over.empty();
    return is_quotient && !figure.numbers.empty() ? quotient_text(figure.numbers.front()) : spread_text(figure);
  }

  // Whether the experiment has the variants of a claim.
  [[nodiscard]] bool knows(const Claim& claim) const {
    const auto is_known = [this](const std::string& text) {
      return !parse_figure_reference(text, experiment_, "").unknown_variant;
    };
    const std::string than = claim.than.is_string() ? claim.than.get<std::string>() : "";
    return is_known(claim.figure) && (!than.starts_with('{') || is_known(than.substr(1, than.size() - 2)));
  }

 private:
  [[nodiscard]] Figure cell_figure(const FigureReference& reference, const std::string& variant) const {
    const auto row = std::find_if(table_.rows.begin(), table_.rows.end(), [&](const TableRow& one) {
      return one.dataset == reference.dataset && one.variant == variant;
    });
    if (row == table_.rows.end()) return {};
    const auto metric = std::find_if(experiment_.metrics.begin(), experiment_.metrics.end(),
                                     [&reference](const Metric& one) { return one.name == reference.metric; });
    return row->cells[static_cast<std::size_t>(metric - experiment_.metrics.begin())].ours;
  }

  const Experiment& experiment_;
  const Table& table_;
};

bool compare(Relation relation, double a, double b) {
  switch (relation) {
    case Relation::kEqual:
      return a == b;
    case Relation::kBelow:
      return a < b;
    case Relation::kAbove:
      return a > b;
    case Relation::kAtMost:
      return a <= b;
    case Relation::kAtLeast:
      return a >= b;
  }
  return false;
}

// What a claim compares a figure with.
Figure other_side(const Json& than, const FigureFinder& finder) {
  if (than.is_number()) return Figure{{than.get<double>()}, ""};
  const auto text = than.get<std::string>();
  return text.front() == '{' ? finder.find(text.substr(1, text.size() - 2)) : Figure{{}, text};
}

// Whether a claim holds, whichever runs are taken.
bool holds(const Claim& claim, const Figure& figure, const Figure& other) {
  if (figure.empty() || other.empty()) return false;
  if (figure.numbers.empty() || other.numbers.empty()) {
    return claim.relation == Relation::kEqual && figure.numbers.empty() == other.numbers.empty() &&
           figure.text == other.text;
  }
  return std::all_of(figure.numbers.begin(), figure.numbers.end(), [&](double a) {
    return std::all_of(other.numbers.begin(), other.numbers.end(),
                       [&](double b) { return compare(claim.relation, a, b); });
  });
}

std::string relation_text(Relation relation) {
  std::string text(kRelationNames[static_cast<std::size_t>(relation)]);
  std::replace(text.begin(), text.end(), '_', ' ');
  if (relation == Relation::kEqual) text += " to";
  return text;
}

std::string untrue_text(const Claim& claim, const Figure& figure, const Figure& other) {
  return claim.figure + " is " + spread_text(figure) + ", expected: " + relation_text(claim.relation) + " " +
         spread_text(other);
}

}  // namespace

AnswerText answer_text(const Experiment& experiment, const Table& table) {
  if (experiment.answers.empty()) {
    throw InputError("--answers: the experiment " + experiment.name + " has no answers (its key 'answers')");
  }
  const FigureFinder finder(experiment, table);
  AnswerText answer;
  std::size_t claims = 0;
  answer.markdown = "\n## Answer\n";
  for (const Answer& paragraph : experiment.answers) {
    answer.markdown += '\n';
    for (const TextPart& part : parts_of(paragraph.text)) {
      answer.markdown += part.is_figure ? finder.text_of(part.text) : part.text;
    }
    answer.markdown += '\n';
    for (const Claim& claim : paragraph.holds) {
      if (!finder.knows(claim)) continue;
      const Figure figure = finder.find(claim.figure);
      const Figure other = other_side(claim.than, finder);
      ++claims;
      if (!holds(claim, figure, other)) answer.untrue.push_back(untrue_text(claim, figure, other));
    }
  }
  answer.markdown += "\nCompared with the records: " + std::to_string(claims - answer.untrue.size()) + " of " +
                     std::to_string(claims) + " statements of this answer hold.\n";
  const std::string left_out = unknown_variants_remark(experiment.answers);
  if (!left_out.empty()) answer.markdown += "- " + left_out + "\n";
  for (const std::string& untrue : answer.untrue) answer.markdown += "- not so: " + untrue + "\n";
  return answer;
}

}  // namespace deliso

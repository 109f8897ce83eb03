#include "experiments/runs/answer_config.h"

#include <algorithm>
#include <array>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "experiments/runs/experiment_keys.h"

namespace deliso {
namespace {

constexpr std::array<std::string_view, 3> kStatisticNames = {"smallest", "median", "largest"};
constexpr std::string_view kOver = " over ";

std::vector<std::string> split_at_bars(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('|', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

template <class List>
void check_name(const std::string& name, const List& list, const char* kind, const std::string& place) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const auto& item : list) names.push_back(item.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  throw InputError(place + " names no " + kind + ": '" + name + "'" + nearest_name_hint(name, names));
}

bool is_variant(const std::string& name, const Experiment& experiment) {
  return std::any_of(experiment.variants.begin(), experiment.variants.end(),
                     [&name](const Variant& variant) { return variant.name == name; });
}

// "A", "A over B", or nothing where there is only one variant.
void parse_variant(const std::string& text, const Experiment& experiment, FigureReference& reference) {
  if (text.empty() && experiment.variants.size() == 1) {
    reference.variant = experiment.variants.front().name;
    return;
  }
  const std::size_t over = text.find(kOver);
  if (is_variant(text, experiment) || over == std::string::npos) {
    reference.variant = text;
  } else {
    reference.variant = text.substr(0, over);
    reference.over = text.substr(over + kOver.size());
    if (!is_variant(reference.over, experiment)) reference.unknown_variant = reference.over;
  }
  if (!is_variant(reference.variant, experiment)) reference.unknown_variant = reference.variant;
}

// The same, for an answer that keeps what it names in vain.
void parse_for(Answer& answer, const std::string& text, const Experiment& experiment, const std::string& place) {
  const std::optional<std::string> unknown = parse_figure_reference(text, experiment, place).unknown_variant;
  std::vector<std::string>& all = answer.unknown_variants;
  if (unknown && std::find(all.begin(), all.end(), *unknown) == all.end()) all.push_back(*unknown);
}

// A reference in braces and nothing else.
bool is_in_braces(const std::string& text) {
  return text.size() > 2 && text.front() == '{' && text.find('}') == text.size() - 1;
}

void check_than(const StrictObject& object, const Experiment& experiment, Answer& answer) {
  const Json& than = object.at("than");
  const bool is_text = than.is_string() && !than.get_ref<const std::string&>().empty();
  if (!than.is_number() && !is_text) {
    object.fail("than", "must be a number or a string that is not empty, found " + short_json(than));
  }
  if (!is_text) return;
  const auto text = than.get<std::string>();
  if (is_in_braces(text)) {
    parse_for(answer, text.substr(1, text.size() - 2), experiment, object.place_of("than"));
  } else if (object.at("is") != kRelationNames.front()) {
    object.fail("is", "can only be 'equal' where 'than' is a text");
  }
}

void parse_claims(const StrictObject& paragraph, const Experiment& experiment, Answer& answer) {
  if (!paragraph.has("holds")) return;
  for (const Json& item : paragraph.at("holds")) {
    const StrictObject object(item, paragraph.place_of("holds") + "/" + std::to_string(answer.holds.size()),
                              kClaimKeys);
    Claim claim;
    claim.figure = object.get<std::string>("figure", "");
    parse_for(answer, claim.figure, experiment, object.place_of("figure"));
    const auto name = object.get<std::string>("is", "");
    const auto* const relation = std::find(kRelationNames.begin(), kRelationNames.end(), name);
    claim.relation = static_cast<Relation>(relation - kRelationNames.begin());
    check_than(object, experiment, answer);
    claim.than = object.at("than");
    answer.holds.push_back(std::move(claim));
  }
}

}  // namespace

FigureReference parse_figure_reference(const std::string& text, const Experiment& experiment,
                                       const std::string& place) {
  const std::vector<std::string> parts = split_at_bars(text);
  if (parts.size() < 3 || parts.size() > 4) {
    throw InputError(place + " refers to a figure as DATASET|VARIANT|METRIC, not as '" + text + "'");
  }
  FigureReference reference;
  reference.dataset = parts[0];
  check_name(reference.dataset, experiment.datasets, "data set", place);
  parse_variant(parts[1], experiment, reference);
  reference.metric = parts[2];
  check_name(reference.metric, experiment.metrics, "metric", place);
  if (parts.size() == 4) {
    const auto* const name = std::find(kStatisticNames.begin(), kStatisticNames.end(), parts[3]);
    if (name == kStatisticNames.end()) {
      throw InputError(place + " names none of smallest, median and largest: '" + parts[3] + "'");
    }
    reference.statistic = static_cast<Statistic>(name - kStatisticNames.begin() + 1);
  }
  return reference;
}

std::vector<TextPart> parts_of(std::string_view paragraph) {
  std::vector<TextPart> parts;
  while (!paragraph.empty()) {
    const std::size_t open = paragraph.find('{');
    const std::size_t close = paragraph.find('}', open == std::string_view::npos ? 0 : open);
    if (open == std::string_view::npos || close == std::string_view::npos) break;
    if (open > 0) parts.push_back({std::string(paragraph.substr(0, open)), false});
    parts.push_back({std::string(paragraph.substr(open + 1, close - open - 1)), true});
    paragraph.remove_prefix(close + 1);
  }
  if (!paragraph.empty()) parts.push_back({std::string(paragraph), false});
  return parts;
}

std::vector<Answer> parse_answers(const StrictObject& object, const Experiment& experiment, Mistakes& mistakes) {
  std::vector<Answer> answers;
  if (!object.has("answers")) return answers;
  if (experiment.question.empty()) object.fail("answers", "need a question to answer: the key 'question'");
  if (experiment.rows != RowKind::kRuns) object.fail("answers", "need rows that are runs, not data sets");
  for (const Json& item : object.at("answers")) {
    Answer& answer = answers.emplace_back();
    const std::string place = object.place_of("answers") + "/" + std::to_string(answers.size() - 1);
    mistakes.gather([&] {
      const StrictObject paragraph(item, place, kAnswerKeys);
      answer.text = paragraph.get<std::string>("text", "");
      for (const TextPart& part : parts_of(answer.text)) {
        if (part.is_figure) parse_for(answer, part.text, experiment, paragraph.place_of("text"));
      }
      parse_claims(paragraph, experiment, answer);
    });
  }
  return answers;
}

std::string unknown_variants_remark(const std::vector<Answer>& answers) {
  std::vector<std::string> names;
  for (const Answer& answer : answers) {
    for (const std::string& name : answer.unknown_variants) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  if (names.empty()) return "";
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
  return "what the answers say of " + list + " is left out: the experiment has no such variant";
}

Json answers_to_json(const std::vector<Answer>& answers) {
  Json list = Json::array();
  for (const Answer& answer : answers) {
    Json& item = list.emplace_back(Json{{"text", answer.text}});
    if (answer.holds.empty()) continue;
    Json& claims = item["holds"] = Json::array();
    for (const Claim& claim : answer.holds) {
      claims.push_back(Json{{"figure", claim.figure},
                            {"is", kRelationNames[static_cast<std::size_t>(claim.relation)]},
                            {"than", claim.than}});
    }
  }
  return list;
}

}  // namespace deliso

// The answers of an experiment as JSON: paragraphs with figures of the table, and what they claim.
//
// A reference to a figure reads "DATASET|VARIANT|METRIC". Between the bars, "A over B" in the place of the variant is
// the median of A divided by that of B; the variant may be left empty where there is one only. A fourth part,
// |smallest, |median or |largest, takes one figure of several repeats. In a paragraph a reference stands in braces.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/strict_object.h"
#include "experiments/runs/experiment.h"

namespace deliso {

// Which figure of the repeats; all of them where none is named.
enum class Statistic { kAll, kSmallest, kMedian, kLargest };

struct FigureReference {
  std::string dataset;
  std::string variant;
  std::string over;  // another variant; empty: not divided
  std::string metric;
  Statistic statistic = Statistic::kAll;
  std::optional<std::string> unknown_variant;  // named, but not of the experiment: there is no such figure
};

// The figure that a text without braces refers to. Throws InputError, beginning with `place`, when it is no such text
// or names no data set or metric of the experiment (the message gives the nearest). A variant may be missing: who tries
// other parameters in an experiment changes the names of its variants.
FigureReference parse_figure_reference(const std::string& text, const Experiment& experiment, const std::string& place);

// A paragraph in parts: texts as they are, and references in braces.
struct TextPart {
  std::string text;  // of a reference: without the braces
  bool is_figure = false;
};
std::vector<TextPart> parts_of(std::string_view paragraph);

// The answers that an experiment gives. The other members of `experiment` must be set already. Throws InputError like
// parse_experiment.
std::vector<Answer> parse_answers(const StrictObject& object, const Experiment& experiment, Mistakes& mistakes);

// A line about what is left out of the answers because no variant has its name; empty where nothing is.
std::string unknown_variants_remark(const std::vector<Answer>& answers);

// For parse_answers to read back.
Json answers_to_json(const std::vector<Answer>& answers);

}  // namespace deliso

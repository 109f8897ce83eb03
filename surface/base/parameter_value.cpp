#include "surface/base/parameter_value.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "delaunay/base/shortest_text.h"

namespace deliso {
namespace {

// The known key that was probably meant: one in the same group with nearly the same spelling, else one that ends in the
// same word, else the one with the nearest spelling.
std::string nearest_key(std::string_view path) {
  constexpr std::size_t kNearly = 2;  // letters
  std::vector<std::string> paths;
  std::vector<std::string> of_group;
  std::string same_word;
  for (const ParameterField& field : parameter_table()) {
    if (key_of(field.path) == key_of(path) && same_word.empty()) same_word = field.path;
    if (is_parameter_group(group_of(path)) && group_of(field.path) == group_of(path)) of_group.emplace_back(field.path);
    paths.emplace_back(field.path);
    if (!group_of(field.path).empty()) paths.emplace_back(group_of(field.path));
  }
  std::string nearest = nearest_name(path, of_group);
  if (!nearest.empty() && edit_distance(path, nearest) <= kNearly) return nearest;
  return same_word.empty() ? nearest_name(path, paths) : same_word;
}

std::optional<double> number_of(const ParameterValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

// Whether the number's magnitude is at most 2^53: up to there doubles hold all integers exactly.
bool has_exact_double(const ParameterValue& value) {
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return -kMost <= *whole && *whole <= kMost;
  return std::abs(std::get<double>(value)) <= static_cast<double>(kMost);
}

bool is_in_range(double number, const ParameterRange& range) {
  const bool is_above = range.low_excluded ? number > range.low : number >= range.low;
  return std::isfinite(number) && is_above && number <= range.high;
}

// Whole numbers with all their digits, others like 1e-6.
std::string bound_text(double bound) {
  if (bound == std::trunc(bound)) return std::to_string(static_cast<std::int64_t>(bound));
  std::string text = shortest_text(bound);
  if (const std::size_t zero = text.find("e-0"); zero != std::string::npos) text.erase(zero + 2, 1);
  return text;
}

}  // namespace

const ParameterField* find_parameter(std::string_view path) {
  const auto table = parameter_table();
  const auto field = std::find_if(table.begin(), table.end(), [&](const ParameterField& f) { return f.path == path; });
  return field == table.end() ? nullptr : &*field;
}

bool is_parameter_group(std::string_view name) {
  const auto table = parameter_table();
  return !name.empty() && std::any_of(table.begin(), table.end(),
                                      [&](const ParameterField& field) { return group_of(field.path) == name; });
}

void fail_unknown_parameter(std::string_view path, const std::string& source) {
  throw InputError(source + ": unknown key '" + std::string(path) + "', the nearest known key is '" +
                   nearest_key(path) + "'");
}

void check_parameter_path(std::string_view path, const std::string& source) {
  if (find_parameter(path) != nullptr) return;
  if (is_parameter_group(path)) {
    throw InputError(source + ": '" + std::string(path) + "' is a group of keys, expected one of them");
  }
  fail_unknown_parameter(path, source);
}

std::optional<ParameterValue> converted_value(const ParameterField& field, const ParameterValue& given) {
  if (std::holds_alternative<std::monostate>(given) && field.nullable) return given;
  switch (field.type) {
    case ParameterType::kBoolean:
      if (std::holds_alternative<bool>(given)) return given;
      break;
    case ParameterType::kChoice:
      for (const std::string_view choice : field.choices) {
        if (given == ParameterValue(choice)) return choice;
      }
      break;
    case ParameterType::kInteger: {
      // 8.0 and 8e0 count as integers, too. Beyond 2^53 doubles cannot distinguish integers.
      const std::optional<double> number = number_of(given);
      if (!number || !has_exact_double(given) || *number != std::floor(*number)) break;
      if (*number < field.range.low || *number > field.range.high) break;
      return static_cast<std::int64_t>(*number);
    }
    case ParameterType::kNumber: {
      const std::optional<double> number = number_of(given);
      if (number && is_in_range(*number, field.range)) return *number;
      break;
    }
  }
  return std::nullopt;
}

void assign_parameter(const ParameterField& field, const std::optional<ParameterValue>& given, const std::string& found,
                      const std::string& source, Parameters& parameters) {
  const std::optional<ParameterValue> converted = given ? converted_value(field, *given) : std::nullopt;
  if (!converted) {
    throw InputError(source + ": " + std::string(field.path) + " must be " + allowed_values(field) + ", found " +
                     found);
  }
  field.set(parameters, *converted);
}

std::string allowed_values(const ParameterField& field) {
  std::string text;
  if (field.type == ParameterType::kBoolean) text = "true or false";
  if (field.type == ParameterType::kChoice) {
    for (const std::string_view choice : field.choices) {
      text += (text.empty() ? "one of '" : ", '") + std::string(choice) + "'";
    }
  }
  if (field.type == ParameterType::kNumber || field.type == ParameterType::kInteger) {
    text = field.type == ParameterType::kNumber ? "a number " : "an integer ";
    text += (field.range.low_excluded ? "> " : ">= ") + bound_text(field.range.low);
    if (std::isfinite(field.range.high)) text += " and <= " + bound_text(field.range.high);
  }
  return field.nullable ? text + " or null" : text;
}

}  // namespace deliso

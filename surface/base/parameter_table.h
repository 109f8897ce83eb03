// The one table of the mesher's parameters. JSON files, --set, the help text, the schema and the README's table are all
// made from it; defaults are those of surface/base/parameters.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "surface/base/parameters.h"

namespace deliso {

enum class ParameterType { kNumber, kInteger, kBoolean, kChoice };

// The value of a parameter. std::monostate is JSON's null: no limit. A choice is held by its name.
using ParameterValue = std::variant<std::monostate, bool, std::int64_t, double, std::string_view>;

// Which numbers are allowed: low (or just above it when low_excluded) to high.
struct ParameterRange {
  double low = 0;
  bool low_excluded = false;
  double high = std::numeric_limits<double>::infinity();
};

struct ParameterField {
  std::string_view path;  // "stage1.epsilon": group and key; a top-level key has no group
  ParameterType type = ParameterType::kNumber;
  bool nullable = false;
  ParameterRange range;                       // of a number or an integer
  std::span<const std::string_view> choices;  // of a choice, in the order of the enumerators
  std::string_view unit;                      // "-" for a pure number, "" for what is none
  std::string_view effect;
  ParameterValue (*get)(const Parameters&) = nullptr;
  // Precondition: the value has the field's type and lies in its range.
  void (*set)(Parameters&, const ParameterValue&) = nullptr;
};

// In the order in which they are written. The fields of one group follow each other.
std::span<const ParameterField> parameter_table();

// The two parts of a key path; a top-level key has an empty group.
constexpr std::string_view group_of(std::string_view path) {
  const std::size_t dot = path.find('.');
  return dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
}
constexpr std::string_view key_of(std::string_view path) {
  const std::size_t dot = path.find('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

}  // namespace deliso

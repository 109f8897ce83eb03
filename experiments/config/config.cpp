#include "experiments/config/config.h"

#include <cmath>
#include <optional>
#include <type_traits>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "experiments/config/mistakes.h"
#include "experiments/config/strict_object.h"

namespace deliso {
namespace {

bool is_group(std::string_view name) {
  for (const ParameterField& field : parameter_table()) {
    if (!name.empty() && group_of(field.path) == name) return true;
  }
  return false;
}

const ParameterField* find_field(std::string_view path) {
  for (const ParameterField& field : parameter_table()) {
    if (field.path == path) return &field;
  }
  return nullptr;
}

// The known key that was probably meant: one in the same group with nearly the same spelling, else one that ends in the
// same word, else the one with the nearest spelling.
std::string nearest_key(std::string_view path) {
  constexpr std::size_t kNearly = 2;  // letters
  std::vector<std::string> paths;
  std::vector<std::string> of_group;
  std::string same_word;
  for (const ParameterField& field : parameter_table()) {
    if (key_of(field.path) == key_of(path) && same_word.empty()) same_word = field.path;
    if (is_group(group_of(path)) && group_of(field.path) == group_of(path)) of_group.emplace_back(field.path);
    paths.emplace_back(field.path);
    if (!group_of(field.path).empty()) paths.emplace_back(group_of(field.path));
  }
  std::string nearest = nearest_name(path, of_group);
  if (!nearest.empty() && edit_distance(path, nearest) <= kNearly) return nearest;
  return same_word.empty() ? nearest_name(path, paths) : same_word;
}

[[noreturn]] void fail_unknown_key(std::string_view path, const std::string& source) {
  throw InputError(source + ": unknown key '" + std::string(path) + "', the nearest known key is '" +
                   nearest_key(path) + "'");
}

// A path like stage1.epsilon as a key of a file.
[[noreturn]] void fail_path_as_key(const std::string& path, const Json& value, const std::string& source) {
  throw InputError(source + ": the keys of a file are nested, expected {\"" + std::string(group_of(path)) + "\": {\"" +
                   std::string(key_of(path)) + "\": " + short_json(value) + "}}, found the key '" + path + "'");
}

// Whether the number's magnitude is at most 2^53: up to there doubles hold all integers exactly.
bool has_exact_double(const Json& value) {
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  if (value.is_number_unsigned()) return value.get<std::uint64_t>() <= static_cast<std::uint64_t>(kMost);
  if (value.is_number_integer()) return -kMost <= value.get<std::int64_t>() && value.get<std::int64_t>() <= kMost;
  return std::abs(value.get<double>()) <= static_cast<double>(kMost);
}

// The value if it has the field's type and lies in its range. A choice is returned as a view of the table's text.
std::optional<ParameterValue> convert(const ParameterField& field, const Json& value) {
  if (value.is_null() && field.nullable) return ParameterValue();
  switch (field.type) {
    case ParameterType::kBoolean:
      if (value.is_boolean()) return value.get<bool>();
      break;
    case ParameterType::kChoice:
      for (const std::string_view choice : field.choices) {
        if (value.is_string() && value.get_ref<const std::string&>() == choice) return choice;
      }
      break;
    case ParameterType::kInteger: {
      // 8.0 and 8e0 count as integers, too. Beyond 2^53 doubles cannot distinguish integers.
      if (!value.is_number() || !has_exact_double(value)) break;
      const auto number = value.get<double>();
      if (number != std::floor(number) || number < field.range.low || number > field.range.high) break;
      return static_cast<std::int64_t>(number);
    }
    case ParameterType::kNumber: {
      if (!value.is_number()) break;
      const auto number = value.get<double>();
      const bool above = field.range.low_excluded ? number > field.range.low : number >= field.range.low;
      if (std::isfinite(number) && above && number <= field.range.high) return number;
      break;
    }
  }
  return std::nullopt;
}

void apply_value(const ParameterField& field, const Json& value, const std::string& source, Parameters& parameters) {
  const std::optional<ParameterValue> converted = convert(field, value);
  if (!converted) {
    throw InputError(source + ": " + std::string(field.path) + " must be " + allowed_values(field) + ", found " +
                     value.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  field.set(parameters, *converted);
}

void require_object(const Json& value, const std::string& what) {
  if (!value.is_object()) {
    throw InputError(what + " must be a JSON object, found " +
                     value.dump(-1, ' ', false, Json::error_handler_t::replace));
  }
}

// A report, a record, or another document that holds parameters under this key and none beside it.
bool holds_parameters(const Json& document) {
  if (!document.is_object() || !document.contains("parameters") || !document["parameters"].is_object()) return false;
  for (const auto& [key, value] : document.items()) {
    if (is_group(key) || find_field(key) != nullptr) return false;
  }
  return true;
}

// A key of the top level: it holds a value, or a group of keys.
void apply_key(const std::string& key, const Json& value, const std::string& source, Parameters& parameters) {
  if (const ParameterField* field = find_field(key); field != nullptr) {
    if (!group_of(key).empty()) fail_path_as_key(key, value, source);
    return apply_value(*field, value, source, parameters);
  }
  if (!is_group(key)) fail_unknown_key(key, source);
  require_object(value, std::string(source).append(": ").append(key));
  Mistakes mistakes;
  for (const auto& item : value.items()) {
    mistakes.gather([&] {
      const std::string path = std::string(key).append(1, '.').append(item.key());
      const ParameterField* field = find_field(path);
      if (field == nullptr) fail_unknown_key(path, source);
      apply_value(*field, item.value(), source, parameters);
    });
  }
  mistakes.throw_all();
}

}  // namespace

void apply_parameters(const Json& document, const std::string& source, Parameters& parameters) {
  require_object(document, source + ": the parameters");
  Mistakes mistakes;
  for (const auto& item : document.items()) {
    mistakes.gather([&] { apply_key(item.key(), item.value(), source, parameters); });
  }
  mistakes.throw_all();
}

Parameters read_parameters(const std::filesystem::path& path) {
  Parameters parameters;
  const Json document = read_json(path);
  if (document.is_object() && document.contains("base"))
    throw InputError(path.string() +
                     ": this is an experiment (for deliso run), expected parameters: those of its runs " +
                     "are what stands under base.parameters, changed by each variant");
  const bool is_whole = holds_parameters(document);
  apply_parameters(is_whole ? document["parameters"] : document,
                   is_whole ? path.string() + ": parameters" : path.string(), parameters);
  return parameters;
}

Json value_to_json(const ParameterValue& value) {
  return std::visit(
      [](const auto& held) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>) {
          return nullptr;
        } else {
          return held;
        }
      },
      value);
}

Json parameters_to_json(const Parameters& parameters) {
  Json document = Json::object();
  for (const ParameterField& field : parameter_table()) {
    Json& object = group_of(field.path).empty() ? document : document[std::string(group_of(field.path))];
    object[std::string(key_of(field.path))] = value_to_json(field.get(parameters));
  }
  return document;
}

void set_parameter(std::string_view assignment, Parameters& parameters) {
  const std::string source = "--set " + std::string(assignment);
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0) throw InputError(source + ": expected key.path=value");
  const std::string_view path = assignment.substr(0, equals);
  const std::string text(assignment.substr(equals + 1));
  // Text that is not JSON is taken as a string, so that a choice needs no quotes.
  Json value = Json::parse(text, nullptr, false);
  if (value.is_discarded()) value = text;
  set_parameter(path, value, source, parameters);
}

void check_parameter_path(std::string_view path, const std::string& source) {
  if (find_field(path) != nullptr) return;
  if (is_group(path)) {
    throw InputError(source + ": '" + std::string(path) + "' is a group of keys, expected one of them");
  }
  fail_unknown_key(path, source);
}

void set_parameter(std::string_view path, const Json& value, const std::string& source, Parameters& parameters) {
  check_parameter_path(path, source);
  apply_value(*find_field(path), value, source, parameters);
}

}  // namespace deliso

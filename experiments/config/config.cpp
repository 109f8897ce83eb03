#include "experiments/config/config.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

#include "delaunay/base/check.h"
#include "experiments/config/mistakes.h"
#include "experiments/config/strict_object.h"
#include "surface/base/parameter_value.h"

namespace deliso {
namespace {

// A path like stage1.epsilon as a key of a file.
[[noreturn]] void fail_path_as_key(const std::string& path, const Json& value, const std::string& source) {
  throw InputError(source + ": the keys of a file are nested, expected {\"" + std::string(group_of(path)) + "\": {\"" +
                   std::string(key_of(path)) + "\": " + short_json(value) + "}}, found the key '" + path + "'");
}

// The value as the table knows it; nothing for an array or an object.
std::optional<ParameterValue> plain_value(const Json& value) {
  if (value.is_null()) return ParameterValue();
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_string()) return std::string_view(value.get_ref<const std::string&>());
  if (value.is_number_float()) return value.get<double>();
  // Whole numbers that no std::int64_t holds are out of any range.
  if (value.is_number_unsigned() && !std::in_range<std::int64_t>(value.get<std::uint64_t>()))
    return value.get<double>();
  if (value.is_number()) return value.get<std::int64_t>();
  return std::nullopt;
}

void apply_value(const ParameterField& field, const Json& value, const std::string& source, Parameters& parameters) {
  assign_parameter(field, plain_value(value), json_line(value), source, parameters);
}

void require_object(const Json& value, const std::string& what) {
  if (!value.is_object()) {
    throw InputError(what + " must be a JSON object, found " + json_line(value));
  }
}

// A report, a record, or another document that holds parameters under this key and none beside it. Reports and records,
// which name their schema, have results beside it that are called like groups of parameters.
bool holds_parameters(const Json& document) {
  if (!document.is_object() || !document.contains("parameters") || !document["parameters"].is_object()) return false;
  const auto schema = document.find("schema");
  if (schema != document.end() && schema->is_string() && schema->get_ref<const std::string&>().starts_with("deliso-"))
    return true;
  for (const auto& [key, value] : document.items()) {
    if (is_parameter_group(key) || find_parameter(key) != nullptr) return false;
  }
  return true;
}

// A key of the top level: it holds a value, or a group of keys.
void apply_key(const std::string& key, const Json& value, const std::string& source, Parameters& parameters) {
  if (const ParameterField* field = find_parameter(key); field != nullptr) {
    if (!group_of(key).empty()) fail_path_as_key(key, value, source);
    return apply_value(*field, value, source, parameters);
  }
  if (!is_parameter_group(key)) fail_unknown_parameter(key, source);
  require_object(value, std::string(source).append(": ").append(key));
  Mistakes mistakes;
  for (const auto& item : value.items()) {
    mistakes.gather([&] {
      const std::string path = std::string(key).append(1, '.').append(item.key());
      const ParameterField* field = find_parameter(path);
      if (field == nullptr) fail_unknown_parameter(path, source);
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

bool is_parameter_document(const Json& document) {
  if (!document.is_object()) return false;
  if (holds_parameters(document)) return true;
  for (const auto& [key, value] : document.items()) {
    if (is_parameter_group(key) || find_parameter(key) != nullptr) return true;
  }
  return false;
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

namespace {

// A number as other options take it, also where JSON has none: .5, 5., +2.
std::optional<Json> number_of_option(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  constexpr double kLargestInteger = 0x1p53;
  const bool is_whole = number == std::floor(number) && std::abs(number) <= kLargestInteger;
  return is_whole ? Json(static_cast<std::int64_t>(number)) : Json(number);
}

}  // namespace

Json typed_value(const std::string& text) {
  Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() ? number_of_option(text).value_or(Json(text)) : value;
}

void set_parameter(std::string_view assignment, Parameters& parameters) {
  const std::string source = "--set " + std::string(assignment);
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0) throw InputError(source + ": expected key.path=value");
  const std::string_view path = assignment.substr(0, equals);
  set_parameter(path, typed_value(std::string(assignment.substr(equals + 1))), source, parameters);
}

void set_parameter(std::string_view path, const Json& value, const std::string& source, Parameters& parameters) {
  check_parameter_path(path, source);
  apply_value(*find_parameter(path), value, source, parameters);
}

}  // namespace deliso

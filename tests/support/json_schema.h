// A small validator of JSON Schema, as far as the program's schemas use it; any other keyword is a failure.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "experiments/config/json.h"

namespace deliso::testing {

inline bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number() && value.get<double>() == std::floor(value.get<double>());
  ADD_FAILURE() << "the schema uses an unknown type " << type;
  return false;
}

inline bool type_fits(const Json& type, const Json& value) {
  if (type.is_string()) return has_type(value, type.get<std::string>());
  return std::any_of(type.begin(), type.end(),
                     [&value](const Json& one) { return has_type(value, one.get<std::string>()); });
}

// Whether `value` satisfies `schema`; references lead into `root`.
inline bool validates(const Json& schema, const Json& value, const Json& root = Json::object()) {
  static const std::vector<std::string> kKnown = {"type",
                                                  "enum",
                                                  "minimum",
                                                  "exclusiveMinimum",
                                                  "maximum",
                                                  "properties",
                                                  "additionalProperties",
                                                  "required",
                                                  "minItems",
                                                  "minLength",
                                                  "items",
                                                  "anyOf",
                                                  "$ref",
                                                  "description",
                                                  "default"};
  static const Json kNone = Json::object();
  for (const auto& [keyword, argument] : schema.items()) {
    EXPECT_NE(std::find(kKnown.begin(), kKnown.end(), keyword), kKnown.end()) << keyword;
    if (keyword == "type" && !type_fits(argument, value)) return false;
    if (keyword == "enum" && std::find(argument.begin(), argument.end(), value) == argument.end()) return false;
    if (keyword == "minimum" && value.is_number() && value < argument) return false;
    if (keyword == "exclusiveMinimum" && value.is_number() && value <= argument) return false;
    if (keyword == "maximum" && value.is_number() && value > argument) return false;
    if (keyword == "minItems" && value.is_array() && value.size() < argument.get<std::size_t>()) return false;
    if (keyword == "minLength" && value.is_string() && value.get<std::string>().size() < argument.get<std::size_t>()) {
      return false;
    }
    if (keyword == "$ref") {
      const auto path = argument.get<std::string>().substr(1);
      if (!validates(root.at(Json::json_pointer(path)), value, root)) return false;
    }
    if (keyword == "anyOf" && std::none_of(argument.begin(), argument.end(),
                                           [&value, &root](const Json& one) { return validates(one, value, root); })) {
      return false;
    }
    if (keyword == "items" && value.is_array()) {
      for (const Json& item : value) {
        if (!validates(argument, item, root)) return false;
      }
    }
    if (keyword == "required" && value.is_object()) {
      for (const Json& key : argument) {
        if (!value.contains(key.get<std::string>())) return false;
      }
    }
    if (!value.is_object()) continue;
    const Json& properties = schema.contains("properties") ? schema["properties"] : kNone;
    for (const auto& [key, inner] : value.items()) {
      if (keyword == "properties" && argument.contains(key) && !validates(argument[key], inner, root)) return false;
      if (keyword != "additionalProperties" || properties.contains(key)) continue;
      if (argument.is_boolean() ? !argument.get<bool>() : !validates(argument, inner, root)) return false;
    }
  }
  return true;
}

}  // namespace deliso::testing

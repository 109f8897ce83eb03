// Descriptions of the parameters: schema, help text and Markdown.
#include <cmath>
#include <cstdint>

#include "experiments/config/config.h"
#include "surface/base/parameter_table.h"
#include "surface/base/parameter_value.h"

namespace deliso {
namespace {

// The effect with its unit.
std::string described(const ParameterField& field) {
  const bool has_unit = !field.unit.empty() && field.unit != "-";
  return std::string(field.effect) + (has_unit ? " [" + std::string(field.unit) + "]" : "");
}

std::string default_text(const ParameterField& field) { return value_to_json(field.get(Parameters{})).dump(); }

// Whole for integers: only so does a validator compare the largest of them exactly.
Json bound_schema(const ParameterField& field, double bound) {
  if (field.type == ParameterType::kInteger) return static_cast<std::int64_t>(bound);
  return bound;
}

Json field_schema(const ParameterField& field) {
  Json schema;
  const auto type_name = [&field]() -> std::string {
    switch (field.type) {
      case ParameterType::kNumber:
        return "number";
      case ParameterType::kInteger:
        return "integer";
      case ParameterType::kBoolean:
        return "boolean";
      case ParameterType::kChoice:
        return "string";
    }
    return "";
  }();
  if (field.nullable) {
    schema["type"] = Json::array({type_name, "null"});
  } else {
    schema["type"] = type_name;
  }
  if (field.type == ParameterType::kChoice) schema["enum"] = field.choices;
  if (field.type == ParameterType::kNumber || field.type == ParameterType::kInteger) {
    schema[field.range.low_excluded ? "exclusiveMinimum" : "minimum"] = bound_schema(field, field.range.low);
    if (std::isfinite(field.range.high)) schema["maximum"] = bound_schema(field, field.range.high);
  }
  schema["default"] = value_to_json(field.get(Parameters{}));
  schema["description"] = described(field);
  return schema;
}

Json empty_object_schema() {
  return Json{{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
}

}  // namespace

Json parameters_schema() {
  Json schema = empty_object_schema();
  schema["description"] = "Parameters of `deliso mesh --config`";
  for (const ParameterField& field : parameter_table()) {
    const std::string group(group_of(field.path));
    Json* properties = &schema["properties"];
    if (!group.empty()) {
      if (!properties->contains(group)) (*properties)[group] = empty_object_schema();
      properties = &(*properties)[group]["properties"];
    }
    (*properties)[std::string(key_of(field.path))] = field_schema(field);
  }
  return schema;
}

std::string parameters_help() {
  std::string text = "Parameters (--config FILE, --set key.path=value):\n";
  for (const ParameterField& field : parameter_table()) {
    text += "  " + std::string(field.path) + " = " + default_text(field) + "\n      " + described(field) + "; " +
            allowed_values(field) + '\n';
  }
  return text;
}

std::string parameters_markdown() {
  std::string text = "| key | default | allowed | unit | effect |\n|---|---|---|---|---|\n";
  for (const ParameterField& field : parameter_table()) {
    text += "| `" + std::string(field.path) + "` | `" + default_text(field) + "` | " + allowed_values(field) + " | " +
            std::string(field.unit) + " | " + std::string(field.effect) + " |\n";
  }
  return text;
}

}  // namespace deliso

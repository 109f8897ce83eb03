// The JSON schema of experiments, from the tables that the parser uses.
#include "experiments/config/config.h"
#include "experiments/runs/experiment_config.h"
#include "experiments/runs/experiment_keys.h"
#include "surface/base/parameter_table.h"

namespace deliso {
namespace {

Json list_of(const Json& items) { return Json{{"type", "array"}, {"minItems", 1}, {"items", items}}; }

Json either(const Json& a, const Json& b) { return Json{{"anyOf", Json::array({a, b})}}; }

Json text_schema() { return Json{{"type", "string"}, {"minLength", 1}}; }

// An object with key paths of parameters ("stage1.epsilon") for keys: a value for each, or a list of values to sweep.
Json by_path(bool lists) {
  const Json parameters = parameters_schema();
  Json properties = Json::object();
  for (const ParameterField& field : parameter_table()) {
    const std::string group(group_of(field.path));
    const Json& owner = group.empty() ? parameters : parameters["properties"][group];
    Json value = owner["properties"][std::string(key_of(field.path))];
    value.erase("default");
    properties[std::string(field.path)] = lists ? list_of(value) : value;
  }
  return Json{{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
}

// Replaces the schema of a key by `part`, and keeps the key's description.
void refine_key(Json& schema, const char* key, Json part) {
  Json& property = schema["properties"][key];
  part["description"] = property["description"];
  property = std::move(part);
}

}  // namespace

Json experiment_schema() {
  Json base = keys_schema(kBaseKeys);
  refine_key(base, "parameters", either(text_schema(), Json{{"$ref", "#/$defs/parameters"}}));
  refine_key(base, "set", by_path(false));
  Json variant = keys_schema(kVariantKeys);
  refine_key(variant, "set", by_path(false));
  Json command = keys_schema(kCommandKeys);
  refine_key(command, "command", list_of(text_schema()));
  refine_key(command, "exit_codes", list_of(Json{{"type", "integer"}, {"minimum", 0}, {"maximum", kLargestExitCode}}));
  refine_key(variant, "mesher", either(Json{{"type", "string"}, {"enum", kMesherNames}}, command));
  const Json dataset = keys_schema(kDatasetKeys);
  Json reference = keys_schema(kReferenceKeys);
  const Json figures{{"type", "object"}, {"additionalProperties", Json{{"type", Json::array({"number", "string"})}}}};
  refine_key(reference, "rows", Json{{"type", "object"}, {"additionalProperties", figures}});

  Json series = keys_schema(kSeriesKeys);
  refine_key(series, "members", list_of(text_schema()));
  Json plot = keys_schema(kPlotKeys);
  refine_key(plot, "y", list_of(text_schema()));
  refine_key(plot, "log", list_of(Json{{"type", "string"}, {"enum", kAxisNames}}));
  refine_key(plot, "series", list_of(series));

  Json claim = keys_schema(kClaimKeys);
  refine_key(claim, "than", either(text_schema(), Json{{"type", "number"}}));
  Json answer = keys_schema(kAnswerKeys);
  refine_key(answer, "holds", list_of(claim));

  Json schema = keys_schema(kExperimentKeys);
  schema["description"] = "An experiment of `deliso run`";
  refine_key(schema, "notes", list_of(text_schema()));
  refine_key(schema, "answers", list_of(answer));
  refine_key(schema, "datasets", list_of(either(text_schema(), dataset)));
  refine_key(schema, "builtin_datasets", list_of(either(text_schema(), dataset)));
  refine_key(schema, "base", base);
  refine_key(schema, "variants", list_of(variant));
  refine_key(schema, "sweep", by_path(true));
  refine_key(schema, "metrics", list_of(keys_schema(kMetricKeys)));
  refine_key(schema, "plots", list_of(plot));
  refine_key(schema, "reference", either(text_schema(), reference));
  return schema;
}

}  // namespace deliso

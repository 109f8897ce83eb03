#include "experiments/runs/variant_config.h"

#include <algorithm>
#include <set>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "experiments/config/config.h"
#include "experiments/runs/experiment_config.h"
#include "experiments/runs/experiment_keys.h"
#include "experiments/runs/run_record.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

void apply_set(const StrictObject& object, Parameters& parameters, Mistakes& mistakes) {
  if (!object.has("set")) return;
  for (const auto& item : object.at("set").items()) {
    mistakes.gather([&] { set_parameter(item.key(), item.value(), object.place_of("set"), parameters); });
  }
}

// Each variant is the base or an earlier variant, with a few keys changed.
std::vector<Variant> parse_variants(const StrictObject& experiment, const Variant& base, Mistakes& mistakes) {
  if (!experiment.has("variants")) return {base};
  std::vector<Variant> known = {base};
  std::vector<Variant> variants;
  std::set<std::string> names;
  for (std::size_t i = 0; i < experiment.at("variants").size(); ++i) {
    const StrictObject object(experiment.at("variants")[i], experiment.place_of("variants") + "/" + std::to_string(i),
                              kVariantKeys, &mistakes);
    const auto name = object.get<std::string>("name", "");
    Variant variant = base;
    mistakes.gather([&] {
      if (!names.insert(name).second) object.fail("name", "'" + name + "' is the name of two variants");
    });
    mistakes.gather([&] {
      if (object.has("extends")) {
        variant = find_variant(object.get<std::string>("extends", ""), known, object, "extends");
      }
    });
    variant.name = name;
    if (object.has("mesher")) {
      variant.mesher =
          object.get<std::string>("mesher", "") == kMesherNames[1] ? Mesher::kMarchingCubes : Mesher::kDelIso;
    }
    apply_set(object, variant.parameters, mistakes);
    variants.push_back(variant);
    // A variant may have the base's name; variants that extend this name then extend the variant.
    std::erase_if(known, [&name](const Variant& other) { return other.name == name; });
    known.push_back(variant);
  }
  return variants;
}

// Every variant combined with every value of one more key.
std::vector<Variant> swept(const std::vector<Variant>& variants, const std::string& path, const Json& values,
                           const std::string& place, Mistakes& mistakes) {
  check_parameter_path(path, place);
  if (!values.is_array() || values.empty()) {
    throw InputError(place + " must be a list of values that is not empty, found " + short_json(values));
  }
  std::vector<Variant> all;
  for (const Variant& variant : variants) {
    std::set<std::string> seen;
    for (const Json& value : values) {
      const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
      if (!seen.insert(text).second) {
        mistakes.add(InputError(std::string(place).append(" has the value ").append(text).append(" twice")));
        continue;
      }
      Variant& one = all.emplace_back(variant);
      one.name.append(" ").append(path).append("=").append(text);
      mistakes.gather([&] { set_parameter(path, value, place, one.parameters); });
    }
  }
  return all;
}

}  // namespace

// The variant of this name.
const Variant& find_variant(const std::string& name, const std::vector<Variant>& variants, const StrictObject& object,
                            std::string_view key) {
  std::vector<std::string> names;
  for (const Variant& variant : variants) {
    if (variant.name == name) return variant;
    names.push_back(variant.name);
  }
  object.fail(key, "names no variant: '" + name + "', the nearest is '" + nearest_name(name, names) + "'");
}

Variant parse_base(const StrictObject& experiment, const fs::path& folder, Mistakes& mistakes) {
  Variant base;
  if (!experiment.has("base")) return base;
  const StrictObject object(experiment.at("base"), experiment.place_of("base"), kBaseKeys, &mistakes);
  base.name = object.get<std::string>("name", "");
  mistakes.gather([&] {
    if (!object.has("parameters")) return;
    const Json& parameters = object.at("parameters");
    if (parameters.is_string()) {
      base.parameters = read_parameters(folder / parameters.get<std::string>());
    } else {
      apply_parameters(parameters, object.place_of("parameters"), base.parameters);
    }
  });
  apply_set(object, base.parameters, mistakes);
  return base;
}

std::vector<Variant> parse_all_variants(const StrictObject& experiment, const Variant& base, Mistakes& mistakes) {
  std::vector<Variant> variants = parse_variants(experiment, base, mistakes);
  if (!experiment.has("sweep")) return variants;
  for (const auto& item : experiment.at("sweep").items()) {
    const std::string place = experiment.place_of("sweep").append("/").append(item.key());
    mistakes.gather([&] { variants = swept(variants, item.key(), item.value(), place, mistakes); });
  }
  return variants;
}

Json variants_to_json(const Experiment& experiment) {
  Json list = Json::array();
  for (const Variant& variant : experiment.variants) {
    Json& item = list.emplace_back(
        Json{{"name", variant.name}, {"set", parameter_changes(experiment.base.parameters, variant.parameters)}});
    if (variant.mesher != Mesher::kDelIso) item["mesher"] = kMesherNames[static_cast<std::size_t>(variant.mesher)];
  }
  return list;
}

}  // namespace deliso

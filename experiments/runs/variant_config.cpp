#include "experiments/runs/variant_config.h"

#include <algorithm>
#include <set>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "experiments/config/config.h"
#include "experiments/runs/command_mesher.h"
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

// Whether runs of a mesher depend on a parameter. Others than ours get the same field, and marching cubes a
// certificate.
bool reads(Mesher mesher, std::string_view path) {
  if (mesher == Mesher::kDelIso || group_of(path) == "field" || path == "boundary" || path == "spacing") return true;
  return mesher == Mesher::kMarchingCubes && path == "certify";
}

// What a variant sets must be what its runs depend on: the sweep has the last word, and other meshers read little.
void check_set(const StrictObject& object, const StrictObject& experiment, Mesher mesher, Mistakes& mistakes) {
  if (!object.has("set")) return;
  const auto refuse = [&](const std::string& path, const std::string& why) {
    mistakes.add(InputError(object.place_of("set").append("/").append(path).append(" ").append(why)));
  };
  for (const auto& item : object.at("set").items()) {
    if (experiment.has("sweep") && experiment.at("sweep").contains(item.key())) {
      refuse(item.key(), "has no effect: the sweep of the experiment sets it in every variant");
    }
    for (const ParameterField& field : parameter_table()) {
      if (field.path != item.key() || reads(mesher, field.path)) continue;
      refuse(item.key(), "has no effect: the mesher of this variant does not read it");
    }
  }
}

// Gives what a mesher does not read the values of the base.
void forget_unread(const Variant& base, Variant& variant) {
  for (const ParameterField& field : parameter_table()) {
    if (!reads(variant.mesher, field.path)) field.set(variant.parameters, field.get(base.parameters));
  }
}

// A list of texts or integers, each checked by `fits`.
template <class T, class Fits>
std::vector<T> items_at(const StrictObject& object, std::string_view key, std::vector<T> otherwise,
                        const std::string& expected, const Fits& fits) {
  if (!object.has(key)) return otherwise;
  std::vector<T> items;
  for (const Json& item : object.at(key)) {
    if (!fits(item)) {
      throw InputError(object.place_of(key) + "/" + std::to_string(items.size()) + " must be " + expected + ", found " +
                       short_json(item));
    }
    items.push_back(item.get<T>());
  }
  return items;
}

// A path to a program is relative to the folder of the experiment.
MesherCommand parse_command(const StrictObject& object, const fs::path& folder) {
  MesherCommand command;
  command.arguments = items_at<std::string>(object, "command", {}, "a string that is not empty", [](const Json& item) {
    return item.is_string() && !item.get_ref<const std::string&>().empty();
  });
  check_placeholders(command.arguments, object.place_of("command"));
  std::string& program = command.arguments.front();
  if (program.find('/') != std::string::npos) program = fs::absolute(folder / program).lexically_normal().string();
  command.timeout_seconds = object.get("timeout", command.timeout_seconds);
  command.mesh_format = object.get("mesh_format", command.mesh_format);
  if (command.mesh_format.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789") != std::string::npos) {
    object.fail("mesh_format", "is no extension in small letters: '" + command.mesh_format + "'");
  }
  command.exit_codes = items_at<int>(
      object, "exit_codes", command.exit_codes, "an integer from 0 to " + std::to_string(kLargestExitCode),
      [](const Json& item) { return item.is_number_integer() && item >= 0 && item <= kLargestExitCode; });
  return command;
}

void parse_mesher(const StrictObject& object, const fs::path& folder, Variant& variant) {
  if (!object.has("mesher")) return;
  const Json& mesher = object.at("mesher");
  variant.command = {};
  if (mesher.is_object()) {
    variant.mesher = Mesher::kCommand;
    variant.command = parse_command(StrictObject(mesher, object.place_of("mesher"), kCommandKeys), folder);
    return;
  }
  const auto* const name = std::find(kMesherNames.begin(), kMesherNames.end(),
                                     mesher.is_string() ? mesher.get_ref<const std::string&>() : std::string());
  if (name == kMesherNames.end()) {
    object.fail("mesher",
                "must be 'deliso', 'marching_cubes' or an object with a command, found " + short_json(mesher));
  }
  variant.mesher = name == kMesherNames.begin() ? Mesher::kDelIso : Mesher::kMarchingCubes;
}

// Each variant is the base or an earlier variant, with a few keys changed.
std::vector<Variant> parse_variants(const StrictObject& experiment, const Variant& base, const fs::path& folder,
                                    Mistakes& mistakes) {
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
    mistakes.gather([&] { parse_mesher(object, folder, variant); });
    apply_set(object, variant.parameters, mistakes);
    check_set(object, experiment, variant.mesher, mistakes);
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
      const std::string text = value.is_string() ? value.get<std::string>() : json_line(value);
      // 2 and 2.0 are one value, 0 and -0.0 too.
      if (!seen.insert(value.is_number() ? json_line(value.get<double>() + 0.0) : text).second) {
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

// Each key multiplies the variants: what would take all of the memory is refused before any is made.
void check_sweep_size(std::size_t variants, const StrictObject& experiment) {
  constexpr std::size_t kMostVariants = 100'000;
  for (const auto& item : experiment.at("sweep").items()) {
    const std::size_t values = item.value().is_array() ? item.value().size() : 1;
    if (values > 0 && variants > kMostVariants / values) {
      experiment.fail("sweep", "makes more than " + std::to_string(kMostVariants) +
                                   " variants, expected fewer values, or an experiment for each part of them");
    }
    variants *= std::max<std::size_t>(values, 1);
  }
}

// Parameters that contradict each other would end every run of their variant. Other meshers, and runs that find the
// topology alone, do not read them.
void check_consistent(const StrictObject& experiment, const std::vector<Variant>& variants, Mistakes& mistakes) {
  if (experiment.get<std::string>("task", "mesh") == "topology") return;
  const std::string place = experiment.place_of(experiment.has("variants") ? "variants"
                                                : experiment.has("sweep")  ? "sweep"
                                                                           : "base");
  for (const Variant& variant : variants) {
    if (variant.mesher != Mesher::kDelIso) continue;
    try {
      check_parameters(variant.parameters);
    } catch (const InputError& error) {
      mistakes.add(InputError(std::string(place).append(": the parameters of '").append(variant.name) +
                              "' contradict each other: " + error.what()));
    }
  }
}

}  // namespace

// The variant of this name.
const Variant& find_variant(const std::string& name, const std::vector<Variant>& variants, const StrictObject& object,
                            std::string_view key) {
  std::vector<std::string> names;
  for (const Variant& variant : variants) {
    if (variant.name == name) return variant;
    if (!variant.name.empty()) names.push_back(variant.name);  // that of a base that is missing is empty
  }
  object.fail(key,
              "names no variant: '" + name + "', " +
                  (names.empty() ? "and none is known here" : "the nearest is '" + nearest_name(name, names) + "'"));
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

std::vector<Variant> parse_all_variants(const StrictObject& experiment, const Variant& base, const fs::path& folder,
                                        Mistakes& mistakes) {
  std::vector<Variant> variants = parse_variants(experiment, base, folder, mistakes);
  if (experiment.has("sweep")) {
    check_sweep_size(variants.size(), experiment);
    for (const auto& item : experiment.at("sweep").items()) {
      const std::string place = experiment.place_of("sweep").append("/").append(item.key());
      mistakes.gather([&] { variants = swept(variants, item.key(), item.value(), place, mistakes); });
    }
  }
  check_consistent(experiment, variants, mistakes);
  for (Variant& variant : variants) forget_unread(base, variant);
  return variants;
}

Json variants_to_json(const Experiment& experiment) {
  Json list = Json::array();
  for (const Variant& variant : experiment.variants) {
    Json& item = list.emplace_back(
        Json{{"name", variant.name}, {"set", parameter_changes(experiment.base.parameters, variant.parameters)}});
    if (variant.mesher != Mesher::kDelIso) item["mesher"] = mesher_json(variant);
  }
  return list;
}

}  // namespace deliso

#include "experiments/commands/field_options.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/base/counted.h"
#include "delaunay/base/shortest_text.h"
#include "experiments/commands/world.h"
#include "experiments/system/parse_number.h"
#include "volume/filters/isovalue_choice.h"
#include "volume/filters/labels.h"
#include "volume/io/sha256.h"
#include "volume/not_finite.h"

namespace deliso {
namespace {

std::int32_t parse_label(const std::string& text) {
  std::int32_t label = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), label);
  if (error == std::errc() && stop == text.data() + text.size()) return label;
  throw InputError("--label: expected a whole number, or several like 1,2,3, found '" + text + "'");
}

std::optional<NamedIsovalue> name_of_isovalue(const std::string& text) {
  try {
    return parse_isovalue_name(text);
  } catch (const InputError& error) {
    throw InputError(std::string("--isovalue: ") + error.what());
  }
}

// An isovalue beside a label says nothing of its own: only the one that the surface has anyway is taken.
void check_isovalue_of_label(const std::string& isovalue) {
  const bool is_other = name_of_isovalue(isovalue) || parse_number(isovalue, "--isovalue") != kLabelIsovalue;
  if (!is_other) return;
  throw InputError("--isovalue: the surface of a label lies half-way between it and all others, at 0.5; found '" +
                   isovalue + "', leave it out");
}

double isovalue_in(const Volume& volume, const FieldOptions& options, const FieldParameters& parameters,
                   const SampleRegion& region) {
  if (parameters.label) {
    if (!options.isovalue.empty()) check_isovalue_of_label(options.isovalue);
    return kLabelIsovalue;
  }
  if (options.isovalue.empty()) throw InputError("--isovalue is required (or --label N for the surface of a label)");
  const std::optional<NamedIsovalue> name = name_of_isovalue(options.isovalue);
  if (!name) return parse_number(options.isovalue, "--isovalue");
  const Samples& all = volume.as_read ? *volume.as_read : volume.grid.samples();
  const Samples samples = region.is_all() ? all : cropped(all, volume.grid, region);
  return isovalue_of(volume.as_read ? finite_samples(samples) : samples, *name);
}

// The samples with finite ones in place of the others.
ScalarGrid finite_grid(const Volume& volume, const FieldOptions& options, const FieldParameters& parameters,
                       const SampleRegion& region, double isovalue) {
  const ScalarGrid& grid = volume.grid;
  const bool is_above = (options.nan == "inside") != parameters.invert;
  // Of what is read: in the grid NaN has a value by now.
  const auto [lowest, highest] =
      finite_range(region.is_all() ? *volume.as_read : cropped(*volume.as_read, grid, region));
  double low = std::min(lowest, 2 * isovalue - highest), high = std::max(highest, 2 * isovalue - lowest);
  double nan = is_above ? high : low;
  if (parameters.label) {
    low = high = *parameters.label - 1.0;  // infinities have no label
    nan = is_above ? *parameters.label : low;
  }
  ScalarGrid finite(grid.dims(), with_finite_samples(*volume.as_read, nan, low, high), grid.spacing(), grid.origin());
  finite.set_backwards(grid.backwards());
  return finite;
}

// The first eight values.
std::string values_text(const std::vector<double>& values) {
  constexpr std::size_t kShown = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, values.size()); ++i) {
    text += (text.empty() ? "" : ", ") + shortest_text(values[i]);
  }
  return text + (values.size() > kShown ? ", ..." : "");
}

}  // namespace

void add_isovalue_option(Command& command, FieldOptions& options) {
  command
      .add_option("--isovalue", options.isovalue,
                  "The value of the isosurface: a number, otsu, mean, median (in the middle of their gap between two "
                  "sample values), or P%, the share of the range from the lowest to the highest sample")
      .type_name("K")
      .check(refuse_empty_value);
}

void add_field_options(Command& command, FieldOptions& options) {
  command
      .add_option("--smooth", options.smooth,
                  "Smooth the samples first by a Gaussian of this standard deviation: voxels, or like 0.5mm; 0: do not")
      .type_name("SIGMA")
      .check(refuse_empty_value);
  command
      .add_option("--label", options.label,
                  "The surface of the samples with this value, instead of an isovalue (mesh and verify: several, "
                  "like 1,2,3)")
      .type_name("N")
      .check(refuse_empty_value);
  command.add_flag("--invert", options.invert, "Inside is below the isovalue, as for signed distances");
  command.add_option("--nan", options.nan, "What samples that are NaN are: refuse, outside or inside")
      .type_name("SIDE")
      .show_default();
}

std::vector<std::int32_t> parse_labels(const std::string& text) {
  std::vector<std::int32_t> labels;
  if (text.empty()) return labels;
  std::istringstream stream(text + ',');
  for (std::string part; std::getline(stream, part, ',');) {
    const std::int32_t label = parse_label(part);
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
  }
  return labels;
}

void check_field_options(const FieldOptions& options) {
  FieldParameters parameters;
  apply_field_options(options, nullptr, parameters);
  if (options.nan != "refuse" && options.nan != "outside" && options.nan != "inside") {
    throw InputError("--nan: expected refuse, outside or inside, found '" + options.nan + "'");
  }
  if (options.isovalue.empty()) return;
  if (!name_of_isovalue(options.isovalue)) {
    try {
      parse_number(options.isovalue, "--isovalue");
    } catch (const InputError&) {
      throw InputError("--isovalue: expected a finite number, otsu, mean, median or P%, found '" + options.isovalue +
                       "'");
    }
  }
  if (!options.label.empty()) check_isovalue_of_label(options.isovalue);
}

void apply_field_options(const FieldOptions& options, const Volume* volume, FieldParameters& parameters) {
  if (const std::vector<std::int32_t> labels = parse_labels(options.label); !labels.empty()) {
    parameters.label = labels.size() == 1 ? std::optional(labels.front()) : std::nullopt;
  }
  if (options.invert) parameters.invert = true;
  if (options.smooth.empty()) return;
  const double sigma = parse_length(options.smooth, "--smooth", volume);
  if (sigma < 0) throw InputError("--smooth: expected a length >= 0, found '" + options.smooth + "'");
  parameters.smooth = sigma > 0 ? std::optional(sigma) : std::nullopt;
}

ChosenField choose_field(const std::string& path, const Volume& volume, const FieldOptions& options,
                         const FieldParameters& parameters, const SampleRegion& region) {
  if (volume.as_read && options.nan == "refuse") {
    throw InputError(path + ": " + first_not_finite_text(*volume.as_read, volume.grid, volume.first) +
                     ": every sample must be a finite number (" + std::to_string(volume.not_finite.count()) +
                     (volume.not_finite.count() == 1 ? " is" : " are") +
                     " not); --nan outside or --nan inside takes NaN for that side");
  }
  const double isovalue = isovalue_in(volume, options, parameters, region);
  if (!volume.as_read) return {volume.grid, isovalue, parameters};
  return {finite_grid(volume, options, parameters, region, isovalue), isovalue, parameters};
}

FieldOfOptions field_of_options(const std::string& path, const Volume& volume, const FieldOptions& options,
                                bool is_closed) {
  if (parse_labels(options.label).size() > 1) throw InputError("--label: expected one label, found " + options.label);
  FieldParameters parameters;
  apply_field_options(options, &volume, parameters);
  ChosenField chosen = choose_field(path, volume, options, parameters);
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  MeshedField meshed =
      meshed_field(chosen.grid, chosen.isovalue, parameters, is_closed, chosen.grid.spacing(), threads);
  return {std::move(chosen), std::move(meshed)};
}

Json field_json(const FieldOptions& options, const ChosenField& chosen) {
  const FieldParameters& parameters = chosen.parameters;
  const std::string text = field_text(parameters);
  return Json{{"label", parameters.label ? Json(*parameters.label) : Json()},
              {"smooth", parameters.smooth ? Json(*parameters.smooth) : Json()},
              {"invert", parameters.invert},
              {"nan", options.nan},
              {"isovalue_name", name_of_isovalue(options.isovalue) ? Json(options.isovalue) : Json()},
              {"text", text.empty() ? "the volume as it is" : text}};
}

Json one_or_all(Json reports) {
  if (reports.size() == 1) return std::move(reports[0]);
  return Json{{"schema", "deliso-labels-1"}, {"labels", std::move(reports)}};
}

std::string sha256_as_read(const Volume& volume) {
  return sample_sha256(volume.as_read ? *volume.as_read : volume.grid.samples());
}

std::vector<std::string> field_remarks(const Volume& volume, const FieldOptions& options, const ChosenField& chosen) {
  std::vector<std::string> remarks;
  if (!chosen.parameters.label && name_of_isovalue(options.isovalue)) {
    remarks.push_back("isovalue " + options.isovalue + " is " + shortest_text(chosen.isovalue));
  }
  const NotFiniteCounts& counts = volume.not_finite;
  if (counts.nan > 0) {
    remarks.push_back(
        counted(static_cast<std::int64_t>(counts.nan), "sample is NaN, taken as ", "samples are NaN, taken as ") +
        options.nan);
  }
  if (counts.count() > counts.nan) {
    remarks.push_back(
        counted(static_cast<std::int64_t>(counts.count() - counts.nan), "sample is infinite", "samples are infinite"));
  }
  return remarks;
}

std::string kinds_remark(const SampleKinds& kinds, const ChosenField* chosen) {
  const bool has_steps = chosen == nullptr || !chosen->parameters.smooth;
  if (chosen != nullptr && chosen->parameters.label) {
    return has_steps ? "the surface of a label has the steps of the voxels: --smooth 1 meshes the smoothed label" : "";
  }
  if (kinds.kind == SampleKind::kField) return "";
  if (kinds.kind == SampleKind::kLabels) {
    return "the samples are few whole numbers (" + values_text(kinds.values) +
           "), labels rather than values of a field: --label N meshes the surface of the label N" +
           (has_steps ? ", and --smooth 1 takes the steps of the voxels off it" : "");
  }
  const double middle = kinds.values[0] / 2 + kinds.values[1] / 2;
  const bool is_middle = chosen != nullptr && chosen->isovalue == middle;
  if (is_middle && !has_steps) return "";
  return "the samples are a mask of " + shortest_text(kinds.values[0]) + " and " + shortest_text(kinds.values[1]) +
         (has_steps ? ": its surface has the steps of the voxels, --smooth 1 meshes the smoothed field" : "") +
         (is_middle ? "" : "; the isovalue half-way is " + shortest_text(middle) + " (--isovalue otsu)");
}

}  // namespace deliso

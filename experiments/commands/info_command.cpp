// deliso info: the contents of a volume, and suggested isovalues; or those of a mesh.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/commands/command.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/field_options.h"
#include "experiments/commands/mesh_info.h"
#include "experiments/commands/sample_histogram.h"
#include "experiments/commands/world.h"
#include "experiments/runs/record.h"
#include "experiments/system/files.h"
#include "experiments/system/output_names.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/text_table.h"
#include "volume/filters/gaussian.h"
#include "volume/filters/isovalue_choice.h"
#include "volume/filters/labels.h"
#include "volume/not_finite.h"

namespace deliso {
namespace {

struct InfoCommandOptions {
  VolumeOptions volume;
  MeshFormatOptions mesh;
  std::string smooth;
  std::string report;
  bool json = false;
};

// What is looked at: the finite samples, those of the field that is smoothed if so asked, and what they tell.
struct Looked {
  ScalarGrid grid;
  Samples samples;  // as read, the finite ones: isovalues refer to them
  SampleHistogram histogram;
  SampleKinds kinds;
};

Looked look_at(const Volume& volume, const InfoCommandOptions& options) {
  FieldOptions field;
  field.smooth = options.smooth;
  FieldParameters parameters;
  apply_field_options(field, &volume, parameters);
  ScalarGrid grid = volume.grid;
  if (parameters.smooth) {
    const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    grid = smoothed(grid, sigma_in_spacings(*parameters.smooth, grid.spacing()), threads);
  }
  Samples samples = volume.as_read ? finite_samples(*volume.as_read) : volume.grid.samples();
  SampleHistogram histogram = sample_histogram(parameters.smooth ? grid.samples() : samples);
  SampleKinds kinds = kind_of_samples(volume.grid);
  return {std::move(grid), std::move(samples), std::move(histogram), std::move(kinds)};
}

std::string kind_name(SampleKind kind) {
  if (kind == SampleKind::kMask) return "mask";
  return kind == SampleKind::kLabels ? "labels" : "field";
}

Json info_report(const InfoCommandOptions& options, const Volume& volume, const Looked& looked) {
  Json described = volume_json(options.volume.path, looked.grid, sha256_as_read(volume));
  described.update(source_json(volume));
  const NotFiniteCounts& counts = volume.not_finite;
  described["not_finite"] =
      Json{{"nan", counts.nan}, {"plus_infinite", counts.plus_infinite}, {"minus_infinite", counts.minus_infinite}};
  described["kind"] = kind_name(looked.kinds.kind);
  described["values"] = looked.kinds.values.empty() ? Json() : Json(looked.kinds.values);
  Json suggestions = Json::array();
  for (const IsovalueSuggestion& suggestion : suggested_isovalues(looked.samples, looked.histogram)) {
    suggestions.push_back(Json{{"isovalue", suggestion.isovalue},
                               {"reason", suggestion.reason},
                               {"name", suggestion.name.empty() ? Json() : Json(suggestion.name)}});
  }
  Json named = Json::object();
  for (const char* name : {"otsu", "mean", "median", "50%"}) {
    named[name] = isovalue_of(looked.samples, *parse_isovalue_name(name));
  }
  const SampleHistogram& histogram = looked.histogram;
  return Json{{"schema", "deliso-info-1"},
              {"program", program_json()},
              {"volume", described},
              {"smooth", options.smooth.empty() ? Json() : Json(options.smooth)},
              {"histogram", {{"low", histogram.low}, {"high", histogram.high}, {"counts", histogram.counts}}},
              {"suggested_isovalues", suggestions},
              {"named_isovalues", named},
              {"advice", kinds_remark(looked.kinds)}};
}

// One line per row, at most sixteen: where its first bin begins, the number of samples, a bar.
void print_histogram(const SampleHistogram& histogram) {
  constexpr std::size_t kMostRows = 16;
  constexpr double kBarWidth = 40;
  const std::size_t bins = histogram.counts.size();
  const std::size_t rows = std::min(kMostRows, bins);
  std::vector<std::uint64_t> counts(rows);
  for (std::size_t bin = 0; bin < bins; ++bin) counts[bin * rows / bins] += histogram.counts[bin];
  const double largest = static_cast<double>(*std::max_element(counts.begin(), counts.end()));
  TextTable table;
  table.row({"from", "samples", ""});
  for (std::size_t r = 0; r < rows; ++r) {
    // The first bin of the row.
    const std::size_t bin = (r * bins + rows - 1) / rows;
    const double from = histogram.low + static_cast<double>(bin) * histogram.bin_width();
    std::string bar(static_cast<std::size_t>(std::lround(kBarWidth * static_cast<double>(counts[r]) / largest)), '#');
    bar.resize(static_cast<std::size_t>(kBarWidth), ' ');
    table.row({number_text(from), std::to_string(counts[r]), bar});
  }
  table.print(std::cout, true);
}

// "0, 255" with at most sixteen numbers.
std::string list_text(const Json& numbers) {
  constexpr std::size_t kShown = 16;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, numbers.size()); ++i) {
    text += (i > 0 ? ", " : "") + number_text(numbers[i].get<double>());
  }
  return text + (numbers.size() > kShown ? ", ..." : "");
}

std::string triple(double a, double b, double c) {
  return number_text(a) + " " + number_text(b) + " " + number_text(c);
}

// A row of the map from index to world.
std::string numbers_text(const Json& row) {
  std::string text;
  for (const Json& number : row) text += (text.empty() ? "" : " ") + number_text(number.get<double>());
  return text;
}

void print_source(const Json& source, TextTable& table) {
  const auto named = [&](const char* key) {
    return source[key].is_null() ? std::string("unknown") : source[key].get<std::string>();
  };
  const std::string channels = std::to_string(source["channels"].get<std::uint64_t>());
  table.row({"format", named("format")})
      .row({"stored type", named("stored_type")})
      .row({"channels", channels + (channels == "1" ? "" : ", read: " + source["channel"].dump())})
      .row({"space", named("space")})
      .row({"units", named("units")})
      .row({"index to world", numbers_text(source["index_to_world"][0])})
      .row({"", numbers_text(source["index_to_world"][1])})
      .row({"", numbers_text(source["index_to_world"][2])});
}

void print_isovalues(const Json& report) {
  TextTable table;
  table.row({"suggested isovalue", "because it", "by name"});
  for (const Json& suggestion : report["suggested_isovalues"]) {
    const Json& name = suggestion["name"];
    table.row({number_text(suggestion["isovalue"].get<double>()), suggestion["reason"].get<std::string>(),
               name.is_null() ? "" : name.get<std::string>()});
  }
  for (const auto& [name, isovalue] : report["named_isovalues"].items()) {
    if (name != "otsu") table.row({number_text(isovalue.get<double>()), "", name});
  }
  std::cout << '\n';
  table.print(std::cout, true);
}

void print_info(const Json& report, const Looked& looked) {
  const ScalarGrid& grid = looked.grid;
  const Json& volume = report["volume"];
  const Json& counts = volume["not_finite"];
  const std::string not_finite = std::to_string(counts["nan"].get<std::uint64_t>()) + " NaN, " +
                                 std::to_string(counts["minus_infinite"].get<std::uint64_t>()) + " -inf, " +
                                 std::to_string(counts["plus_infinite"].get<std::uint64_t>()) + " +inf";
  TextTable table;
  print_source(volume, table);
  table.row({"dims", triple(grid.dims()[0], grid.dims()[1], grid.dims()[2])})
      .row({"type", grid.type_name()})
      .row({"spacing", triple(grid.spacing().x, grid.spacing().y, grid.spacing().z)})
      .row({"origin", triple(grid.origin().x, grid.origin().y, grid.origin().z)})
      .row({"range", number_text(grid.range().first) + " " + number_text(grid.range().second)});
  if (not_finite != "0 NaN, 0 -inf, 0 +inf") table.row({"not finite", not_finite});
  if (!volume["values"].is_null()) {
    table.row({"kind", volume["kind"].get<std::string>() + ": " + list_text(volume["values"])});
  }
  table.row({"sha256", volume["sha256"].get<std::string>()});
  table.print(std::cout);
  std::cout << '\n';
  print_histogram(looked.histogram);
  if (!report["suggested_isovalues"].empty()) print_isovalues(report);
  const std::string advice = report["advice"].get<std::string>();
  if (!advice.empty()) std::cout << '\n' << advice << '\n';
}

// A mesh has no samples: what tells of them is refused.
void check_no_volume_options(const InfoCommandOptions& options) {
  const VolumeOptions& v = options.volume;
  const std::vector<std::pair<std::string, const std::string*>> all = {
      {"--smooth", &options.smooth}, {"--region", &v.region},   {"--channel", &v.channel},
      {"--array", &v.array},         {"--dims", &v.dims},       {"--type", &v.type},
      {"--endian", &v.endian},       {"--spacing", &v.spacing}, {"--skip", &v.skip}};
  std::string names;
  for (const auto& [name, value] : all) {
    if (!value->empty()) names += (names.empty() ? "" : ", ") + name;
  }
  if (names.empty()) return;
  const bool is_stream = is_standard_stream(v.path);
  throw InputError(names + ": for volumes alone, but " + (is_stream ? "standard input" : v.path) + " is a mesh");
}

ExitCode run_info(const InfoCommandOptions& options) {
  FieldOptions field;
  field.smooth = options.smooth;
  check_field_options(field);
  if (!options.report.empty()) check_writable(options.report, "--report");
  check_distinct({{"VOLUME", options.volume.path}}, {{"--report", options.report}});
  if (!options.mesh.format.empty() && !options.volume.format.empty())
    throw InputError("--format is that of a mesh, --volume-format that of a volume: expected one of them");
  if (options.volume.format.empty() && is_mesh_input(options.volume.path, options.mesh)) {
    check_no_volume_options(options);
    return run_mesh_info(options.volume.path, options.mesh, options.report, options.json);
  }
  const Volume volume = load_volume(options.volume);
  check_apart_from_data(volume.data_files, {{"--report", options.report}});
  const Looked looked = look_at(volume, options);
  print_units_remark(options.volume.path, volume, {options.smooth});
  const Json report = info_report(options, volume, looked);
  if (!options.report.empty()) write_text(json_text(report), options.report);
  if (is_standard_stream(options.report)) return ExitCode::kDone;  // the JSON stands there already
  if (options.json) {
    std::cout << json_text(report);
  } else {
    print_info(report, looked);
  }
  return ExitCode::kDone;
}

}  // namespace

void add_info_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<InfoCommandOptions>();
  Command command = line.add_command("info", "What a volume holds, with suggested isovalues, or what a mesh is");
  add_volume_options(command, options->volume);
  add_mesh_input_option(command, options->mesh);
  command.add_option("--smooth", options->smooth, "The histogram of the field smoothed as by mesh --smooth")
      .type_name("SIGMA")
      .check(refuse_empty_value);
  add_region_option(command, options->volume);
  command.add_flag("--json", options->json, "Print JSON");
  command.add_option("--report", options->report, "Write the JSON to a file")
      .type_name("FILE")
      .check(refuse_empty_name);
  command.examples(
      "deliso info head.nrrd\n"
      "deliso info head.ply --json");
  command.callback(exit_code, [options] { return run_info(*options); });
}

}  // namespace deliso

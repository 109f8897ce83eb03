// deliso info: the contents of a volume, and suggested isovalues; or those of a mesh.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "experiments/commands/command.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/mesh_info.h"
#include "experiments/commands/sample_histogram.h"
#include "experiments/commands/world.h"
#include "experiments/runs/record.h"
#include "experiments/system/files.h"
#include "experiments/system/output_names.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/text_table.h"

namespace deliso {
namespace {

struct InfoCommandOptions {
  VolumeOptions volume;
  MeshFormatOptions mesh;
  std::string report;
  bool json = false;
};

Json info_report(const VolumeOptions& options, const Volume& volume, const SampleHistogram& histogram) {
  Json described = volume_json(options.path, volume.grid);
  described.update(source_json(volume));
  Json suggestions = Json::array();
  for (const IsovalueSuggestion& suggestion : suggested_isovalues(histogram)) {
    suggestions.push_back(Json{{"isovalue", suggestion.isovalue}, {"reason", suggestion.reason}});
  }
  return Json{{"schema", "deliso-info-1"},
              {"program", program_json()},
              {"volume", described},
              {"histogram", {{"low", histogram.low}, {"high", histogram.high}, {"counts", histogram.counts}}},
              {"suggested_isovalues", suggestions}};
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

void print_info(const Json& report, const Volume& volume, const SampleHistogram& histogram) {
  const ScalarGrid& grid = volume.grid;
  TextTable table;
  print_source(report["volume"], table);
  table.row({"dims", triple(grid.dims()[0], grid.dims()[1], grid.dims()[2])})
      .row({"type", grid.type_name()})
      .row({"spacing", triple(grid.spacing().x, grid.spacing().y, grid.spacing().z)})
      .row({"origin", triple(grid.origin().x, grid.origin().y, grid.origin().z)})
      .row({"range", number_text(grid.range().first) + " " + number_text(grid.range().second)})
      .row({"sha256", report["volume"]["sha256"].get<std::string>()});
  table.print(std::cout);
  std::cout << '\n';
  print_histogram(histogram);
  if (report["suggested_isovalues"].empty()) return;
  TextTable suggestions;
  suggestions.row({"suggested isovalue", "because it"});
  for (const Json& suggestion : report["suggested_isovalues"]) {
    suggestions.row({number_text(suggestion["isovalue"].get<double>()), suggestion["reason"].get<std::string>()});
  }
  std::cout << '\n';
  suggestions.print(std::cout, true);
}

ExitCode run_info(const InfoCommandOptions& options) {
  if (!options.report.empty()) check_writable(options.report, "--report");
  check_distinct({{"VOLUME", options.volume.path}}, {{"--report", options.report}});
  if (is_mesh_input(options.volume.path, options.mesh) && options.volume.format.empty())
    return run_mesh_info(options.volume.path, options.mesh, options.report, options.json);
  const Volume volume = load_volume(options.volume);
  const ScalarGrid& grid = volume.grid;
  const SampleHistogram histogram = sample_histogram(grid);
  const Json report = info_report(options.volume, volume, histogram);
  if (!options.report.empty()) write_text(json_text(report), options.report);
  if (options.json) {
    std::cout << json_text(report);
  } else if (!is_standard_stream(options.report)) {
    print_info(report, volume, histogram);
  }
  return ExitCode::kDone;
}

}  // namespace

void add_info_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<InfoCommandOptions>();
  Command command = line.add_command("info", "What a volume holds, with suggested isovalues, or what a mesh is");
  add_volume_options(command, options->volume);
  add_mesh_input_option(command, options->mesh);
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

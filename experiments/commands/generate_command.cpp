// deliso generate: writes a built-in volume.
#include <iostream>
#include <limits>
#include <memory>
#include <string>

#include "delaunay/base/check.h"
#include "experiments/commands/command.h"
#include "experiments/commands/commands.h"
#include "experiments/system/files.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/stop_signal.h"
#include "experiments/system/text_table.h"
#include "volume/fields/analytic_fields.h"
#include "volume/fields/field_slices.h"
#include "volume/io/volume_file.h"
#include "volume/isovalue_range.h"

namespace deliso {
namespace {

struct GenerateCommandOptions {
  std::string name;
  std::string output;
  std::string size;
  std::string seed = "1";
  std::string encoding = "gzip";
  bool list = false;
};

void print_list() {
  TextTable table;
  table.row({"name", "size", "isovalue", "type"});
  for (const AnalyticField& field : analytic_fields()) {
    table.row({field.name, std::to_string(field.default_size), number_text(field.isovalue), field.type_name});
  }
  table.print(std::cout, true);
  std::cout << '\n';
  for (const AnalyticField& field : analytic_fields()) std::cout << field.name << ": " << field.description << '\n';
}

// The suggested isovalue; says so when a coarse volume has no point of the isosurface.
std::string suggested_isovalue(const AnalyticField& field, std::int32_t size, std::uint64_t seed) {
  constexpr std::int32_t kCoarse = 16;
  const bool has_points = size > kCoarse || has_isosurface(generate_field(field.name, size, seed), field.isovalue);
  return number_text(field.isovalue) + (has_points ? "" : " (no point of it at this size)");
}

ExitCode run_generate(const GenerateCommandOptions& options) {
  if (options.list) {
    if (!options.name.empty() || !options.output.empty()) {
      throw InputError("generate: --list writes no volume, expected it without NAME and -o, or these without --list");
    }
    print_list();
    return ExitCode::kDone;
  }
  if (options.name.empty()) throw InputError("generate: NAME is required (--list names all)");
  if (options.output.empty()) throw InputError("generate: -o VOLUME is required");
  const AnalyticField& field = find_analytic_field(options.name);
  const auto size = options.size.empty()
                        ? field.default_size
                        : static_cast<std::int32_t>(parse_count(options.size, "--size", 2, kLargestFieldSize));
  const std::uint64_t seed = parse_count(options.seed, "--seed", 0, std::numeric_limits<std::uint64_t>::max());
  const bool is_stream = is_standard_stream(options.output);
  if (!is_stream) check_replaceable(options.output, "-o");
  const bool is_raw = options.encoding == "raw";
  if (!is_raw && options.encoding != "gzip") {
    throw InputError("--encoding is \"" + options.encoding + "\", expected \"gzip\" or \"raw\"");
  }
  FieldSlices slices(field, size, seed);
  StopHold hold;
  const auto next = [&] {
    hold.check();
    return slices.next();
  };
  const auto write = [&](const std::string& path) {
    write_volume({{size, size, size}, slices.type()}, next, path, is_raw ? NrrdEncoding::kRaw : NrrdEncoding::kGzip);
  };
  if (is_stream) {
    write_to_standard_output(write, ".nrrd");
  } else {
    write(options.output);
  }
  hold.finish();
  const std::string side = std::to_string(size);
  TextTable()
      .row({"volume", options.output})
      .row({"dims", side + " " + side + " " + side})
      .row({"type", field.type_name})
      .row({"suggested isovalue", suggested_isovalue(field, size, seed)})
      .print(is_stream ? std::cerr : std::cout);
  return ExitCode::kDone;
}

}  // namespace

void add_generate_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<GenerateCommandOptions>();
  Command command = line.add_command("generate", "Write a built-in volume");
  command.add_option("NAME", options->name, "Which one").type_name("");
  command.add_option("-o,--output", options->output, "The volume: .nrrd or .raw; - is standard output (NRRD)")
      .type_name("VOLUME");
  command.add_option("--size", options->size, "Samples along each axis (default: the field's own)")
      .type_name("N")
      .check(refuse_empty_value);
  command.add_option("--seed", options->seed, "Seed of the fields that are random").type_name("N").show_default();
  command.add_option("--encoding", options->encoding, "Of .nrrd: gzip, or raw, which need not be read to be used")
      .type_name("gzip|raw")
      .show_default();
  command.add_flag("--list", options->list, "List the built-in volumes");
  command.examples(
      "deliso generate torus --size 64 -o torus.nrrd\n"
      "deliso generate torus -o - | deliso mesh - --isovalue 0.7 -o torus.ply\n"
      "deliso generate --list");
  command.callback(exit_code, [options] { return run_generate(*options); });
}

}  // namespace deliso

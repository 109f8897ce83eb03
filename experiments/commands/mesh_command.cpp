// deliso mesh: a volume and an isovalue in, a certified Delaunay mesh out.
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/commands/command.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/field_options.h"
#include "experiments/commands/label_files.h"
#include "experiments/commands/mesh_fields.h"
#include "experiments/commands/mesh_output.h"
#include "experiments/commands/mesh_summary.h"
#include "experiments/commands/size_options.h"
#include "experiments/commands/stated_options.h"
#include "experiments/commands/world.h"
#include "experiments/config/config.h"
#include "experiments/runs/record.h"
#include "experiments/system/files.h"
#include "experiments/system/output_names.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/progress_bar.h"
#include "experiments/system/stop_signal.h"
#include "surface/deliso.h"
#include "surface/library/mesh_notes.h"
#include "surface/library/rounded_output.h"
#include "surface/library/run_report.h"
#include "surface/mesh/mesh_frame.h"
#include "volume/filters/labels.h"

namespace deliso {
namespace {

struct MeshCommandOptions {
  VolumeOptions volume;
  WorldOptions world;
  FieldOptions field;
  SizeOptions sizes;
  std::string output;
  MeshFormatOptions format;
  std::string config;
  std::vector<std::string> assignments;
  std::string seed = "1";
  std::string report;
  std::string stage1_output;
  std::string threads = "1";
  bool closed = false;
  bool quiet = false;
  bool ascii = false;
};

// Lengths in units of the world are converted with the volume; without one, only their form is checked.
Parameters resolved_parameters(const MeshCommandOptions& options, const Volume* volume) {
  Parameters parameters;
  if (!options.config.empty()) parameters = read_parameters(options.config);
  for (const std::string& assignment : options.assignments)
    set_parameter(with_length_in_voxels(assignment, volume), parameters);
  if (options.closed) parameters.boundary = Boundary::kClosed;
  apply_field_options(options.field, volume, parameters.field);
  apply_size_options(options.sizes, volume, parameters);
  check_agreement({options.assignments, options.field, options.sizes, options.closed}, volume, parameters);
  return parameters;
}

std::vector<NamedFile> named_outputs(const MeshCommandOptions& options, std::optional<std::int32_t> label) {
  return {{"-o", name_for(options.output, label)},
          {"--stage1-out", name_for(options.stage1_output, label)},
          {"--report", name_for(options.report, label)}};
}

// Finds everything that could prevent the results from being written before the work starts.
void check_outputs(const MeshCommandOptions& options, const std::vector<std::int32_t>& labels) {
  check_label_names(options.output, "-o", labels, output_format(options.output, "-o", options.format));
  std::optional<MeshFormat> stage1_format;
  if (!options.stage1_output.empty()) stage1_format = output_format(options.stage1_output, "--stage1-out", {});
  check_label_names(options.stage1_output, "--stage1-out", labels, stage1_format);
  check_label_names(options.report, "--report", labels, std::nullopt);
  for (const std::optional<std::int32_t> label : runs_of(labels)) {
    const std::string output = name_for(options.output, label), stage1 = name_for(options.stage1_output, label),
                      report = name_for(options.report, label);
    check_mesh_output(output, "-o", options.format);
    if (!stage1.empty()) check_mesh_output(stage1, "--stage1-out", {"", options.format.gmsh_version});
    if (!report.empty()) check_writable(report, "--report");
    check_one_standard_output(named_outputs(options, label));
    check_distinct({{"VOLUME", options.volume.path}, {"--config", options.config}}, named_outputs(options, label));
  }
}

Json report_of(const MeshCommandOptions& options, const Meshed& meshed, const Volume& volume, const std::string& sha256,
               const World& world) {
  const MeshRun run{options.volume.path, volume.grid, meshed.chosen.isovalue, meshed.meshing, sha256, &meshed.quality};
  Json report = mesh_report(run, meshed.result);
  report["surface"] = surface_json(transformed(meshed.result.mesh, world.from_grid), meshed.meshing.threads);
  report["volume"].update(source_json(volume));
  report["world"] = world_json(world);
  report["field"] = field_json(options.field, meshed.chosen);
  report["certificate"]["field"] = report["field"]["text"];
  return report;
}

bool holds_fields(MeshFormat format) { return format == MeshFormat::kLegacyVtk || format == MeshFormat::kVtp; }

// What goes into the mesh's file beside it.
MeshFileOptions file_options(const MeshCommandOptions& options, const Meshed& meshed, const std::string& sha256,
                             const World& world) {
  const Parameters& parameters = meshed.meshing.parameters;
  MeshFileOptions file;
  file.format = output_format(options.output, "-o", options.format);
  file.ascii = options.ascii;
  file.gmsh_version = gmsh_version(options.format);
  file.metres = metres_in_unit(world.units);
  std::vector<std::string> notes = kept_notes(parameters, meshed.result);
  append_field_notes(options.field, parameters, notes);
  file.comments = mesh_comments(options.volume.path, sha256, meshed.result.isovalue_used, world, notes);
  if (holds_fields(*file.format)) {
    const SampleRegion region = region_of(parameters.region);
    const ScalarGrid& grid = meshed.chosen.grid;
    file.attributes = mesh_fields(meshed.result, region.is_all() ? grid : cropped(grid, region), meshed.chosen.isovalue,
                                  parameters, world.from_grid, meshed.meshing.threads);
  }
  return file;
}

// The meshes and reports of all labels, those of one name in one file.
void write_outputs(const MeshCommandOptions& options, const std::vector<Meshed>& all, const Volume& volume,
                   const std::string& sha256, const World& world) {
  // First the reports are made in memory, or written where they cannot be taken back: if this fails, no mesh may be
  // left behind.
  std::map<std::string, Json> reports;
  MeshFiles meshes;
  for (const Meshed& meshed : all) {
    const MeshingResult& result = meshed.result;
    if (!options.report.empty()) {
      reports[name_for(options.report, meshed.label)].push_back(report_of(options, meshed, volume, sha256, world));
    }
    MeshFileOptions file = file_options(options, meshed, sha256, world);
    meshes.add(name_for(options.output, meshed.label), transformed(result.mesh, world.from_grid), meshed.label, file);
    if (options.stage1_output.empty() || !result.stage1_mesh) continue;
    file.attributes = {};
    file.format = output_format(options.stage1_output, "--stage1-out", {});
    meshes.add(name_for(options.stage1_output, meshed.label), transformed(*result.stage1_mesh, world.from_grid),
               meshed.label, file);
  }
  for (auto& [name, list] : reports) {
    list = one_or_all(std::move(list));
    if (is_special(name)) write_text(json_text(list), name);
  }
  for (const std::string& remark : meshes.write()) {
    if (!options.quiet) std::cerr << "deliso: " << remark << '\n';
  }
  for (const auto& [name, report] : reports) {
    if (!is_special(name)) write_text(json_text(report), name);
  }
}

// What a reader of stderr must know of the volume.
void print_volume_remarks(const MeshCommandOptions& options, const Volume& volume, const World& world,
                          const ChosenField& chosen) {
  if (world.is_sheared) std::cerr << "deliso: " << shear_remark(world) << '\n';
  for (const std::string& remark : field_remarks(volume, options.field, chosen)) {
    std::cerr << "deliso: " << remark << '\n';
  }
  std::vector<std::string> lengths = options.assignments;
  const SizeOptions& s = options.sizes;
  lengths.insert(lengths.end(), {options.field.smooth, s.max_error, s.max_edge, s.min_component});
  print_units_remark(options.volume.path, volume, lengths);
  const std::string remark = kinds_remark(kind_of_samples(chosen.grid), &chosen);
  if (!remark.empty()) std::cerr << "deliso: " << remark << '\n';
}

ExitCode exit_code_of(const MeshingOptions& options, const MeshingResult& result) {
  if (result.stopped_early()) return ExitCode::kStopped;
  const bool proven = is_proven(result.certificate);
  return proven || !options.parameters.certify ? ExitCode::kDone : ExitCode::kNotProven;
}

// Meshes one surface, with a progress bar on a terminal.
Meshed mesh_one(const MeshCommandOptions& options, const Volume& volume, const World& world, MeshingOptions meshing,
                std::optional<std::int32_t> label) {
  if (label) meshing.parameters.field.label = label;
  ChosenField chosen = choose_field(options.volume.path, volume, options.field, meshing.parameters.field,
                                    region_of(meshing.parameters.region));
  const MeshOutput output{world.from_grid, volume.grid.spacing(), output_format(options.output, "-o", options.format),
                          metres_in_unit(world.units), options.output};
  MeshingResult result = [&] {
    ProgressBar bar(std::cerr, stderr_is_terminal() && !options.quiet);
    MeshingOptions watched = meshing;
    watched.progress = [&bar](const Progress& progress) { bar.show(progress); };
    watched.rounding = rounding_of(output, volume.grid.box());
    return mesh_isosurface(chosen.grid, chosen.isovalue, watched);
  }();
  if (meshing.parameters.certify) judge_rounding(result.mesh, output, result.promised_distance, result.certificate);
  const MeshQuality quality = measure_quality(result.mesh, meshing.threads);
  move_positions(world.from_grid, result);
  return {meshing.parameters.field.label, std::move(chosen), std::move(meshing), std::move(result), quality};
}

ExitCode run_mesh(const MeshCommandOptions& options) {
  // Every option is checked before the volume is read, and the volume before the work starts.
  check_field_options(options.field);
  MeshingOptions meshing;
  meshing.parameters = resolved_parameters(options, nullptr);
  check_space(options.world.space);
  meshing.seed = parse_count(options.seed, "--seed", 0, std::numeric_limits<std::uint64_t>::max());
  meshing.threads = parse_threads(options.threads);
  const MeshFormat format = output_format(options.output, "-o", options.format);
  meshing.keep_stage1_mesh = !options.stage1_output.empty() || holds_fields(format);
  std::vector<std::int32_t> labels = parse_labels(options.field.label);
  if (labels.empty() && meshing.parameters.field.label) labels.push_back(*meshing.parameters.field.label);
  check_outputs(options, labels);
  meshing.stop = &catch_stop_signals();
  const Volume volume = load_volume(options.volume);
  for (const auto label : runs_of(labels)) check_apart_from_data(volume.data_files, named_outputs(options, label));
  const World world = world_of(volume, options.world);
  meshing.parameters = resolved_parameters(options, &volume);
  const std::string sha256 = sha256_as_read(volume);
  // A label that is missing is found before the others are meshed. Where samples are not finite, --nan may give it
  // some.
  const SampleRegion region = region_of(meshing.parameters.region);
  if (labels.size() > 1 && !volume.as_read)
    check_labels(region.is_all() ? volume.grid : cropped(volume.grid, region), labels);

  std::vector<Meshed> all;
  for (const std::optional<std::int32_t> label : runs_of(labels)) {
    all.push_back(mesh_one(options, volume, world, meshing, label));
    if (all.back().result.stopped_early()) break;
  }
  write_outputs(options, all, volume, sha256, world);
  // Where a result goes to standard output, nothing else does.
  const bool is_taken = is_standard_stream(options.output) || is_standard_stream(options.report);
  std::ostream& out = is_taken ? std::cerr : std::cout;
  ExitCode worst = ExitCode::kDone;
  for (const Meshed& meshed : all) {
    worst = std::max(worst, exit_code_of(meshed.meshing, meshed.result));
    if (!(is_taken && options.quiet)) {
      if (&meshed != &all.front()) out << '\n';
      print_summary(meshed, out);
    }
    if (options.quiet) continue;
    if (&meshed == &all.front()) print_volume_remarks(options, volume, world, meshed.chosen);
    print_remarks(meshed);
  }
  return worst;
}

}  // namespace

void add_mesh_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<MeshCommandOptions>();
  Command command = line.add_command("mesh", "Mesh an isosurface and certify the mesh");
  add_volume_options(command, options->volume);
  add_isovalue_option(command, options->field);
  add_field_options(command, options->field);
  command
      .add_option("-o,--output", options->output,
                  "The mesh: " + std::string(kMeshExtensions) +
                      "; - is standard output; {label} in the name stands for the label, without it several share one "
                      ".ply, .vtk, .vtp or .mesh with a label per triangle")
      .type_name("MESH")
      .required();
  command.add_option("--config", options->config, "Parameters in a JSON file")
      .type_name("FILE")
      .check(refuse_empty_name);
  command.add_option("--set", options->assignments, "One parameter, key.path=value (repeatable; after --config)")
      .type_name("KEY=VALUE")
      .repeatable();
  command.add_flag("--closed", options->closed, "Close the surface along the faces of the box (boundary = closed)");
  command.add_option("--seed", options->seed, "Seed of the random choices").type_name("N").show_default();
  command.add_option("--report", options->report, "Write a JSON report of the run")
      .type_name("FILE")
      .check(refuse_empty_name);
  command.add_option("--stage1-out", options->stage1_output, "Write the mesh as it is after stage 1 (Recover)")
      .type_name("MESH")
      .check(refuse_empty_name);
  command.add_option("--threads", options->threads, "Threads to use, or auto: as many as the machine has")
      .type_name("N")
      .show_default();
  add_size_options(command, options->sizes);
  add_world_options(command, options->world);
  add_mesh_output_options(command, options->format);
  command.add_flag("--quiet", options->quiet, "No progress, no remarks and no summary on stderr");
  command.add_flag("--ascii", options->ascii, "Write PLY, STL, VTK and VTP as text");
  command.add_help("--help-parameters", "The parameters of --config and --set, with their defaults", parameters_help);
  command.examples(
      "deliso mesh head.nrrd --isovalue 50 -o head.ply\n"
      "deliso mesh head.nii.gz --isovalue 50 --set boundary=closed -o head.smesh && tetgen -pYqAT1e-14 head.smesh\n"
      "deliso mesh engine_256x256x256_uint8.raw --isovalue 100 --set promise.max_distance=0.5 --threads 2 -o e.vtp\n"
      "deliso mesh - --isovalue 50 -o - < head.nrrd | deliso info -");
  command.callback(exit_code, [options] { return run_mesh(*options); });
}

}  // namespace deliso

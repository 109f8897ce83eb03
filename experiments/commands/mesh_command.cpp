// deliso mesh: a volume and an isovalue in, a certified Delaunay mesh out.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "experiments/commands/command.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/mesh_fields.h"
#include "experiments/commands/mesh_output.h"
#include "experiments/commands/size_options.h"
#include "experiments/commands/world.h"
#include "experiments/config/config.h"
#include "experiments/runs/record.h"
#include "experiments/system/files.h"
#include "experiments/system/output_names.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/progress_bar.h"
#include "experiments/system/rounded_output.h"
#include "experiments/system/stop_signal.h"
#include "experiments/system/text_table.h"
#include "surface/deliso.h"
#include "surface/mesh/mesh_frame.h"
#include "surface/mesh/mesh_quality.h"
#include "volume/io/sha256.h"

namespace deliso {
namespace {

struct MeshCommandOptions {
  VolumeOptions volume;
  WorldOptions world;
  SizeOptions sizes;
  std::string isovalue;
  std::string output;
  MeshFormatOptions format;
  std::string config;
  std::vector<std::string> assignments;
  std::string seed = "1";
  std::string report;
  std::string stage1_output;
  std::string threads = "1";
  bool quiet = false;
  bool ascii = false;
};

// Lengths in units of the world are converted with the volume; without one, only their form is checked.
Parameters resolved_parameters(const MeshCommandOptions& options, const Volume* volume) {
  Parameters parameters;
  if (!options.config.empty()) parameters = read_parameters(options.config);
  for (const std::string& assignment : options.assignments)
    set_parameter(with_length_in_voxels(assignment, volume), parameters);
  apply_size_options(options.sizes, volume, parameters);
  return parameters;
}

// Finds everything that could prevent the results from being written before the work starts.
void check_outputs(const MeshCommandOptions& options) {
  check_mesh_output(options.output, "-o", options.format);
  if (!options.stage1_output.empty())
    check_mesh_output(options.stage1_output, "--stage1-out", {"", options.format.gmsh_version});
  if (!options.report.empty()) check_writable(options.report, "--report");
  check_one_standard_output(
      {{"-o", options.output}, {"--stage1-out", options.stage1_output}, {"--report", options.report}});
  check_distinct({{"VOLUME", options.volume.path}, {"--config", options.config}},
                 {{"-o", options.output}, {"--stage1-out", options.stage1_output}, {"--report", options.report}});
}

Json report_of(const MeshRun& run, const Volume& volume, const World& world, const MeshingResult& result) {
  Json report = mesh_report(run, result);
  report["surface"] = surface_json(transformed(result.mesh, world.from_grid), run.options.threads);
  report["volume"].update(source_json(volume));
  report["world"] = world_json(world);
  return report;
}

bool holds_fields(MeshFormat format) { return format == MeshFormat::kLegacyVtk || format == MeshFormat::kVtp; }

// What goes into the mesh's file beside it.
MeshFileOptions file_options(const MeshCommandOptions& options, const MeshRun& run, const World& world,
                             const MeshingResult& result) {
  const Parameters& parameters = run.options.parameters;
  MeshFileOptions file;
  file.format = output_format(options.output, "-o", options.format);
  file.ascii = options.ascii;
  file.gmsh_version = gmsh_version(options.format);
  file.metres = metres_in_unit(world.units);
  file.comments = mesh_comments(options.volume.path, run.volume_sha256, result.isovalue_used,
                                result.promised_distance, world, kept_comments(parameters, result));
  if (holds_fields(*file.format))
    file.attributes = mesh_fields(result, run.grid, parameters, world.from_grid, run.options.threads);
  return file;
}

void write_outputs(const MeshCommandOptions& options, const MeshRun& run, const Volume& volume, const World& world,
                   MeshingResult& result) {
  // First the report is made in memory, or written where it cannot be taken back: if this fails, no mesh may be left
  // behind.
  const std::string report = options.report.empty() ? "" : json_text(report_of(run, volume, world, result));
  const bool is_file = !is_special(options.report);
  if (!is_file) write_text(report, options.report);
  MeshFileOptions file = file_options(options, run, world, result);
  write_mesh_output(transformed(result.mesh, world.from_grid), options.output, file);
  if (!options.stage1_output.empty() && result.stage1_mesh) {
    file.attributes = {};
    file.format = output_format(options.stage1_output, "--stage1-out", {});
    write_mesh_output(transformed(*result.stage1_mesh, world.from_grid), options.stage1_output, file);
  }
  if (is_file && !options.report.empty()) write_text(report, options.report);
}

void print_summary(const MeshingResult& result, const MeshingOptions& options, std::ostream& stream) {
  const TopologySum topology = sum_of(mesh_topology(result));
  TextTable table;
  table.row({"vertices", std::to_string(result.mesh.points.size())})
      .row({"triangles", std::to_string(result.mesh.triangles.size())})
      .row({"components", std::to_string(topology.components)})
      .row({"euler characteristic", std::to_string(topology.euler_characteristic)})
      .row({"boundary loops", std::to_string(topology.boundary_loops)})
      .row({"verdict", verdict_name(result.certificate.verdict)})
      .row({"min angle (degrees)", number_text(measure_quality(result.mesh, options.threads).min_angle_degrees)})
      .row({"seconds", number_text(result.total_seconds)});
  table.print(stream);
  if (result.certificate.verdict == Verdict::kNotChecked || result.stopped_early()) return;
  stream << '\n'
         << (is_proven(result.certificate) ? "proven" : "not proven")
         << " (a proven mesh is manifold, oriented and homeomorphic to the isosurface component by component, no "
         << "triangles cross, its vertices lie on the isosurface, and distances both ways are at most "
         << number_text(result.promised_distance) << " voxel)\n";
}

// The triangles that could not be brought to the angle asked for, and where the worst of them is.
void remark_shape(const ShapeStats& shape, const Parameters& parameters) {
  if (shape.bad_after == 0) return;
  const double wanted = shape_options(parameters).min_angle * 180 / std::numbers::pi;
  const BadTriangle& worst = shape.worst.front();
  std::cerr << "deliso: " << shape.bad_after << (shape.bad_after == 1 ? " triangle has" : " triangles have")
            << " an angle below " << number_text(wanted) << " degrees, at creases and necks of the isosurface; the "
            << "worst, of " << number_text(worst.degrees()) << " degrees, at " << number_text(worst.centroid.x) << ' '
            << number_text(worst.centroid.y) << ' ' << number_text(worst.centroid.z) << '\n';
}

// What a reader of stderr must know beyond the table.
void print_remarks(const MeshRun& run, const World& world, const MeshingResult& result) {
  if (world.is_sheared) std::cerr << "deliso: " << shear_remark(world) << '\n';
  remark_isovalue(run.grid, run.isovalue, result.isovalue_used);
  remark_shape(result.shape, run.options.parameters);
  for (const std::string& remark : size_remarks(run.options.parameters, result)) {
    std::cerr << "deliso: " << remark << '\n';
  }
  for (const std::string& goal : unmet_goals(run, result)) std::cerr << "deliso: " << goal << '\n';
  constexpr std::size_t kShown = 10;
  const std::vector<std::string>& differences = result.certificate.differences;
  for (std::size_t i = 0; i < std::min(kShown, differences.size()); ++i) {
    std::cerr << "deliso: " << differences[i] << '\n';
  }
  for (const std::string& broken : result.certificate.broken) std::cerr << "deliso: not proven: " << broken << '\n';
  if (differences.size() > kShown) {
    std::cerr << "deliso: " << differences.size() - kShown << " more differences stand in the report\n";
  }
}

ExitCode exit_code_of(const MeshingOptions& options, const MeshingResult& result) {
  if (result.stopped_early()) return ExitCode::kStopped;
  const bool proven = is_proven(result.certificate);
  return proven || !options.parameters.certify ? ExitCode::kDone : ExitCode::kNotProven;
}

ExitCode run_mesh(const MeshCommandOptions& options) {
  // Every option is checked before the volume is read, and the volume before the work starts.
  const double isovalue = parse_number(options.isovalue, "--isovalue");
  MeshingOptions meshing;
  meshing.parameters = resolved_parameters(options, nullptr);
  check_space(options.world.space);
  meshing.seed = parse_count(options.seed, "--seed", 0, std::numeric_limits<std::uint64_t>::max());
  meshing.threads = parse_threads(options.threads);
  check_outputs(options);
  const MeshFormat format = output_format(options.output, "-o", options.format);
  meshing.keep_stage1_mesh = !options.stage1_output.empty() || holds_fields(format);
  meshing.stop = &catch_stop_signals();
  const Volume volume = load_volume(options.volume);
  const ScalarGrid& grid = volume.grid;
  const World world = world_of(volume, options.world);
  meshing.parameters = resolved_parameters(options, &volume);

  // Mesh, with a progress bar on a terminal.
  const MeshRun run{options.volume.path, grid, isovalue, meshing, sample_sha256(grid)};
  MeshingResult result = [&] {
    ProgressBar bar(std::cerr, stderr_is_terminal() && !options.quiet);
    MeshingOptions watched = meshing;
    if (!options.quiet) {
      watched.before_refine = [&parameters = meshing.parameters](double expected, double crossings) {
        const std::string remark = many_vertices_remark(parameters, expected, crossings);
        if (!remark.empty()) std::cerr << "deliso: " << remark << '\n';
      };
    }
    watched.progress = [&bar](const Progress& progress) { bar.show(progress); };
    return mesh_isosurface(grid, isovalue, watched);
  }();
  if (meshing.parameters.certify) {
    const Vec3& s = grid.spacing();
    judge_rounding(result.mesh, world.from_grid, std::min({s.x, s.y, s.z}), options.output, format,
                   metres_in_unit(world.units), result.certificate);
  }

  write_outputs(options, run, volume, world, result);
  // Where a result goes to standard output, nothing else does.
  const bool is_taken = is_standard_stream(options.output) || is_standard_stream(options.report);
  print_summary(result, meshing, is_taken ? std::cerr : std::cout);
  if (!options.quiet) print_remarks(run, world, result);
  return exit_code_of(meshing, result);
}

}  // namespace

void add_mesh_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<MeshCommandOptions>();
  Command command = line.add_command("mesh", "Mesh an isosurface and certify the mesh");
  add_volume_options(command, options->volume);
  command.add_option("--isovalue", options->isovalue, "The value whose isosurface is meshed").type_name("K").required();
  command
      .add_option("-o,--output", options->output,
                  "The mesh: " + std::string(kMeshExtensions) + "; - is standard output")
      .type_name("MESH")
      .required();
  command.add_option("--config", options->config, "Parameters in a JSON file")
      .type_name("FILE")
      .check(refuse_empty_name);
  command.add_option("--set", options->assignments, "One parameter, key.path=value (repeatable; after --config)")
      .type_name("KEY=VALUE")
      .repeatable();
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
  command.add_flag("--quiet", options->quiet, "No progress and no remarks on stderr");
  command.add_flag("--ascii", options->ascii, "Write PLY, STL, VTK and VTP as text");
  command.add_help("--help-parameters", "The parameters of --config and --set, with their defaults", parameters_help);
  command.examples(
      "deliso mesh head.nrrd --isovalue 50 -o head.ply\n"
      "deliso mesh head.nii.gz --isovalue 50 --set boundary=closed -o head.smesh && tetgen -pqA head.smesh\n"
      "deliso mesh engine_256x256x256_uint8.raw --isovalue 100 --set promise.max_distance=0.5 --threads 2 -o e.vtp\n"
      "deliso mesh - --isovalue 50 -o - < head.nrrd | deliso info -");
  command.callback(exit_code, [options] { return run_mesh(*options); });
}

}  // namespace deliso

// deliso verify: checks any mesh as an image of an isosurface, ours or another tool's.
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/counted.h"
#include "delaunay/base/shortest_text.h"
#include "experiments/commands/command.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/field_options.h"
#include "experiments/commands/label_files.h"
#include "experiments/commands/mesh_output.h"
#include "experiments/commands/size_options.h"
#include "experiments/commands/verify_report.h"
#include "experiments/commands/world.h"
#include "experiments/runs/record.h"
#include "experiments/system/files.h"
#include "experiments/system/output_names.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/progress_bar.h"
#include "experiments/system/text_table.h"
#include "surface/library/verification_report.h"
#include "surface/mesh/mesh_frame.h"
#include "surface/verification/verification.h"

namespace deliso {
namespace {

struct VerifyCommandOptions {
  std::string mesh;
  MeshFormatOptions format;
  VolumeOptions volume;
  WorldOptions world{.space = ""};
  FieldOptions field;
  std::string report;
  std::string dropped;       // empty: what the mesh file says, or else none
  std::string max_distance;  // empty: what the mesh file promises, or else the default
  bool closed = false;
  bool ignore_spacing = false;
};

// One mesh, or the triangles of one label, beside its field.
struct Judged {
  ChosenField chosen;
  MeshedField field;
  Verification verification;
};

Json verify_report(const VerifyCommandOptions& options, const Volume& volume, const World& world,
                   const Promise& promise, const Judged& judged) {
  const Verification& v = judged.verification;
  Json volume_part = volume_json(options.volume.path, volume.grid, sha256_as_read(volume));
  volume_part.update(source_json(volume));
  return Json{{"schema", "deliso-verification-1"},
              {"program", program_json()},
              {"mesh", options.mesh},
              {"volume", volume_part},
              {"world", world_json(world)},
              {"field", field_json(options.field, judged.chosen)},
              {"closed", options.closed},
              {"spacing", options.ignore_spacing ? "ignore" : "use"},
              {"isovalue", judged.chosen.isovalue},
              {"isovalue_used", v.isovalue_used},
              {"vertices", v.vertices},
              {"triangles", v.triangles},
              {"promise", {{"max_distance", promise.max_distance}, {"dropped_components", promise.dropped_components}}},
              {"proven", v.proven},
              {"failures", v.failures},
              {"checks", checks_json(v)},
              {"quality", quality_json(v.quality)},
              {"total_seconds", v.seconds}};
}

// Converts the mesh and its volume to units of samples: sample (i, j, k) lies at (i, j, k).
void forget_spacing(TriangleMesh& mesh, ScalarGrid& grid) {
  const Vec3& s = grid.spacing();
  for (Vec3& p : mesh.points) p = scaled(p - grid.origin(), {1 / s.x, 1 / s.y, 1 / s.z});
  grid = ScalarGrid(grid.dims(), grid.samples());
}

// Everything is measured in the grid's own coordinates: the map to the world is undone, but for rounding.
Judged judge(const VerifyCommandOptions& options, TriangleMesh mesh, const Volume& volume, const World& world,
             const FieldParameters& parameters, const Promise& promise) {
  ChosenField chosen = choose_field(options.volume.path, volume, options.field, parameters);
  const std::vector<Vec3> written = mesh.points;
  if (!(world.from_grid == Affine())) mesh = transformed(std::move(mesh), world.from_grid.inverse());
  ScalarGrid grid = chosen.grid;
  if (options.ignore_spacing) forget_spacing(mesh, grid);
  if (parameters.invert) {
    for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  }
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  MeshedField field = meshed_field(grid, chosen.isovalue, parameters, options.closed, grid.spacing(), threads);
  Verification verification = [&] {
    ProgressBar bar(std::cerr, stderr_is_terminal());
    return verify_mesh(
        mesh, field.grid, field.isovalue, promise,
        [&bar](double share, std::string_view step) { bar.show(share, step); }, written);
  }();
  if (!options.ignore_spacing) move_places(verification, world.from_grid);
  return {std::move(chosen), std::move(field), std::move(verification)};
}

// What the verdict is of: its bound, and what the mesh may lack. A mesh file may name a large bound, and much left out.
std::string scope_text(const VerifyCommandOptions& options, const Promise& promise) {
  const std::string of_file = ", as the mesh file says";
  std::string text = "distances both ways, where they are measured, are at most " + short_text(promise.max_distance) +
                     (promise.max_distance == 1 ? " voxel" : " voxels");
  if (options.max_distance.empty() && promise.max_distance != PromiseParameters().max_distance) text += of_file;
  if (promise.dropped_components > 0) {
    text += "; " + counted(promise.dropped_components, "component", "components") + " left out" +
            (options.dropped.empty() ? of_file : "");
  }
  if (!options.volume.region.empty()) text += "; of the region " + options.volume.region;
  return text;
}

void print_judged(const Json& report, const Volume& volume, const VerifyCommandOptions& options, const Promise& promise,
                  const Judged& judged) {
  const Verification& v = judged.verification;
  // Where the report goes to standard output, nothing else does.
  std::ostream& out = is_standard_stream(options.report) ? std::cerr : std::cout;
  print_checks(report, out);
  for (const std::string& remark : field_remarks(volume, options.field, judged.chosen)) {
    std::cerr << "deliso: " << remark << '\n';
  }
  remark_isovalue(&judged.field.grid, judged.chosen.isovalue, v.isovalue_used);
  if (const std::int64_t count = v.manifold.unreferenced_vertices; count > 0) {
    std::cerr << "deliso: "
              << counted(count, "vertex belongs to no triangle: it is", "vertices belong to no triangle: they are")
              << " no part of the surface, wherever " << (count == 1 ? "it lies" : "they lie")
              << ", and not held against the mesh\n";
  }
  const std::string field = field_text(judged.chosen.parameters);
  out << '\n'
      << (v.proven ? "proven" : "not proven") << (field.empty() ? "" : ": " + field) << " ("
      << scope_text(options, promise) << ")\n";
  for (const std::string& failure : v.failures) out << "  " << failure << '\n';
  constexpr std::size_t kMostDifferences = 10;
  const std::vector<std::string>& differences = v.topology.differences;
  for (std::size_t i = 0; i < std::min(kMostDifferences, differences.size()); ++i) {
    out << "  " << differences[i] << '\n';
  }
}

std::int64_t parse_dropped(const std::string& text) {
  return static_cast<std::int64_t>(parse_count(text, "--dropped", 0, std::uint64_t{1} << 53));
}

ExitCode run_verify(VerifyCommandOptions options) {
  check_field_options(options.field);
  const bool is_given = !options.max_distance.empty();
  if (is_given && parse_length(options.max_distance, "--max-distance", nullptr) <= 0) {
    throw InputError("--max-distance: expected a number > 0, found '" + options.max_distance + "'");
  }
  if (!options.dropped.empty()) parse_dropped(options.dropped);
  if (!options.report.empty()) check_writable(options.report, "--report");
  check_distinct({{"MESH", options.mesh}, {"VOLUME", options.volume.path}}, {{"--report", options.report}});
  check_space(options.world.space);
  check_one_standard_input({{"MESH", options.mesh}, {"VOLUME", options.volume.path}});
  MeshFile file = read_mesh_input(options.mesh, options.format);
  keep_noted_labels(file);
  const TriangleMesh& mesh = file.mesh;
  // What is not given is taken from the mesh's file.
  if (take_field_notes(file.comments, options.field)) options.closed = true;
  check_field_options(options.field);
  const KeptInFile kept = kept_in_file(file.comments);
  if (options.volume.region.empty()) options.volume.region = kept.region;
  if (kept.ignores_spacing) options.ignore_spacing = true;
  const Volume volume = load_volume(options.volume);
  check_apart_from_data(volume.data_files, {{"--report", options.report}});
  take_world_notes(file.comments, volume, options.world);
  const World world = world_of(volume, options.world);
  // Of several labels in a file each has its own.
  const auto promise_of = [&](std::optional<std::int32_t> label) {
    const std::vector<std::string> comments = comments_for(file.comments, label);
    return Promise{.max_distance = is_given ? parse_length(options.max_distance, "--max-distance", &volume)
                                            : promised_distance(comments).value_or(PromiseParameters().max_distance),
                   .dropped_components =
                       options.dropped.empty() ? kept_in_file(comments).dropped : parse_dropped(options.dropped)};
  };

  FieldParameters parameters;
  apply_field_options(options.field, &volume, parameters);
  const Labels labels = runs_of(parse_labels(options.field.label));
  if (labels.size() > 1 && mesh.labels.empty()) {
    throw InputError("--label: the triangles of " + options.mesh + " have no labels, expected one of " +
                     options.field.label);
  }
  Json reports = Json::array();
  bool is_proven = true;
  for (const std::optional<std::int32_t> label : labels) {
    parameters.label = label;
    const Promise promise = promise_of(label);
    const Judged judged = judge(options, part_with_label(mesh, label), volume, world, parameters, promise);
    reports.push_back(verify_report(options, volume, world, promise, judged));
    print_judged(reports.back(), volume, options, promise, judged);
    is_proven = is_proven && judged.verification.proven;
  }
  if (world.is_sheared) std::cerr << "deliso: " << shear_remark(world) << '\n';
  print_units_remark(options.volume.path, volume, {options.max_distance, options.field.smooth});
  if (!options.report.empty()) write_text(json_text(one_or_all(std::move(reports))), options.report);
  return is_proven ? ExitCode::kDone : ExitCode::kNotProven;
}

}  // namespace

void add_verify_command(CommandLine& line, ExitCode& exit_code) {
  const auto options = std::make_shared<VerifyCommandOptions>();
  Command command = line.add_command("verify", "Check any mesh against an isosurface");
  command.add_option("MESH", options->mesh, "The mesh: " + std::string(kReadMeshExtensions) + "; - is standard input")
      .type_name("")
      .required()
      .check(refuse_empty_name);
  add_mesh_input_option(command, options->format);
  add_volume_options(command, options->volume);
  add_region_option(command, options->volume);
  add_isovalue_option(command, options->field);
  add_field_options(command, options->field);
  command.add_option("--report", options->report, "Write every figure as JSON")
      .type_name("FILE")
      .check(refuse_empty_name);
  command
      .add_option(
          "--max-distance", options->max_distance,
          "How far mesh and isosurface may be off each other: voxels, or like 0.5mm (default: what the mesh file "
          "promises, or 1)")
      .type_name("D")
      .check(refuse_empty_value);
  command
      .add_option(
          "--dropped", options->dropped,
          "So many components of the isosurface were left out on purpose (default: what the mesh file says, or 0)")
      .type_name("N")
      .check(refuse_empty_value);
  add_world_options(command, options->world);
  command.add_flag("--closed", options->closed, "Close the surface along the faces of the box (boundary = closed)");
  command.add_flag(
      "--ignore-spacing", options->ignore_spacing,
      "Measure in samples, as if the volume's spacing were 1 (spacing = ignore), as where the mesh file says so");
  command.examples(
      "deliso verify head.ply head.nrrd --isovalue 50\n"
      "deliso verify other.obj head.nrrd --isovalue 50 --max-distance 0.5mm --report r.json");
  command.callback(exit_code, [options] { return run_verify(*options); });
}

}  // namespace deliso

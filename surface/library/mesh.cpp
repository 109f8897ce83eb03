// deliso::mesh: the caller's samples in, a mesh and what is known of it out.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/shortest_text.h"
#include "surface/certificate/certificate.h"
#include "surface/deliso.h"
#include "surface/library/call.h"
#include "surface/library/json_tree.h"
#include "surface/library/mesh_notes.h"
#include "surface/library/placed_grid.h"
#include "surface/library/rounded_output.h"
#include "surface/library/run_report.h"
#include "surface/mesh/mesh_frame.h"
#include "surface/mesh/mesh_quality.h"

namespace deliso {
namespace {

// What is given back and told in the world's coordinates.
void move_to_world(MeshingResult& result, const Affine& map) {
  result.mesh = transformed(std::move(result.mesh), map);
  if (result.stage1_mesh) result.stage1_mesh = transformed(std::move(*result.stage1_mesh), map);
  move_positions(map, result);
}

std::vector<std::pair<std::string, double>> seconds_by_stage(const MeshingResult& result) {
  return {{"index", result.index.seconds + result.topology.seconds},
          {"initial", result.initial.seconds},
          {"recover", result.recover.seconds},
          {"repair", result.repair.seconds},
          {"poles", result.poles.seconds},
          {"build", result.build.seconds},
          {"refine", result.refine.seconds},
          {"shape", result.shape.seconds},
          {"decimate", result.decimation.seconds},
          {"certify", result.certify_stage.seconds}};
}

JsonTree volume_tree(const VolumeView& volume, const PlacedGrid& placed, bool is_copied) {
  return JsonTree{{"dims", volume.dims},
                  {"type", placed.grid.type_name()},
                  {"range", std::array{placed.grid.range().first, placed.grid.range().second}},
                  {"index_to_world", volume.affine},
                  {"copied_samples", is_copied}};
}

// What `deliso verify` has to know of the mesh, where it reads a file of it.
std::vector<std::string> comments_of(const Parameters& parameters, const MeshingResult& result) {
  std::vector<std::string> lines = {"DelIso " + version() + ", isovalue " + shortest_text(result.isovalue_used)};
  for (std::string& line : kept_notes(parameters, result)) lines.push_back(std::move(line));
  for (std::string& line : field_notes(parameters)) lines.push_back(std::move(line));
  if (const auto& label = parameters.field.label) lines.push_back(note_line(kLabelNote, std::to_string(*label)));
  return lines;
}

// Whether the mesher works on samples that are made of the caller's.
bool has_new_field(const Parameters& parameters) {
  return parameters.field.label || parameters.field.smooth || parameters.boundary == Boundary::kClosed;
}

MeshReport report_of(const MeshingOptions& options, const MeshingResult& result, const MeshQuality& quality) {
  const TopologySum topology = sum_of(mesh_topology(result));
  MeshReport report;
  report.proven = is_proven(result.certificate);
  report.stopped = result.stopped_early();
  report.verdict = verdict_name(result.certificate.verdict);
  report.stopped_in = result.stopped_in;
  report.not_kept = result.certificate.broken;
  report.differences = result.certificate.differences;
  report.unmet = unmet_goals(options, result);
  report.isovalue_used = result.isovalue_used;
  report.components = topology.components;
  report.euler_characteristic = topology.euler_characteristic;
  report.boundary_loops = topology.boundary_loops;
  report.dropped_components = result.dropped_components;
  report.promised_distance = result.promised_distance;
  report.min_angle_degrees = quality.min_angle_degrees;
  report.max_angle_degrees = quality.max_angle_degrees;
  report.seconds = result.total_seconds;
  report.stage_seconds = seconds_by_stage(result);
  return report;
}

MeshResult mesh_watched(const VolumeView& volume, double isovalue, const MeshOptions& options, Watcher& watcher) {
  MeshingOptions meshing;
  meshing.parameters = engine_parameters(options.parameters);
  meshing.seed = options.seed;
  meshing.threads = thread_count(options.threads);
  meshing.progress = [&watcher](const Progress& progress) { watcher.show(progress); };
  meshing.stop = watcher.stop();
  meshing.stop_cause = "the caller";
  meshing.keep_stage1_mesh = options.keep_stage1;
  const PlacedGrid placed = placed_grid(volume, region_of(meshing.parameters.region));
  MeshingOptions of_region = meshing;
  of_region.parameters.region = {};  // it is all of the grid
  const double value = isovalue_of_field(meshing.parameters, isovalue);
  const MeshOutput output{placed.to_world, placed.grid.spacing(), MeshFormat::kPly, std::nullopt, "the mesh"};
  of_region.rounding = rounding_of(output, placed.grid.box());
  MeshingResult result = mesh_isosurface(placed.grid, value, of_region);
  if (meshing.parameters.certify && !placed.is_exact())
    judge_rounding(result.mesh, output, result.promised_distance, result.certificate);
  const MeshQuality quality = measure_quality(result.mesh, meshing.threads);  // before a shear
  move_to_world(result, placed.to_world);
  MeshResult given;
  given.report = report_of(meshing, result, quality);
  given.report.copied_samples = placed.is_copied || has_new_field(meshing.parameters);
  given.mesh = public_mesh(result.mesh);
  given.mesh.comments = comments_of(meshing.parameters, result);
  if (result.stage1_mesh) given.stage1 = public_mesh(*result.stage1_mesh);
  JsonTree json{{"schema", "deliso-report-1"},
                {"program", JsonTree{{"version", version()}}},
                {"volume", volume_tree(volume, placed, given.report.copied_samples)}};
  json.update(run_report(value, meshing, result, quality));
  json["comments"] = given.mesh.comments;
  given.report.json = json.text();
  return given;
}

}  // namespace

MeshResult mesh(const VolumeView& volume, double isovalue, const MeshOptions& options) {
  Watcher watcher(options.progress, options.stop);
  MeshResult result = call_guarded([&] { return mesh_watched(volume, isovalue, options, watcher); });
  watcher.rethrow();
  return result;
}

}  // namespace deliso

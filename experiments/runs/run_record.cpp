#include "experiments/runs/run_record.h"

#include <algorithm>

#include "delaunay/base/check.h"
#include "delaunay/base/nearest_name.h"
#include "delaunay/base/stopwatch.h"
#include "experiments/config/config.h"
#include "experiments/runs/command_mesher.h"
#include "experiments/runs/experiment_keys.h"
#include "experiments/runs/judged_mesh.h"
#include "experiments/runs/record.h"
#include "experiments/system/program_info.h"
#include "surface/deliso.h"
#include "surface/intersection/exact_tests.h"
#include "surface/verification/verification.h"
#include "volume/marching_cubes/marching_cubes.h"
#include "volume/regular_isovalue.h"
#include "volume/topology/exact_topology.h"

namespace deliso {
namespace {

constexpr const char* kRecordSchema = "deliso-record-1";

// One entry for each kind of component.
std::vector<TopologyCount> counted(const std::vector<ComponentTopology>& components) {
  return certify(TriangleMesh{}, components).isosurface;
}

Json topology_report(const RunInput& input, double isovalue, std::uint64_t seed) {
  const Stopwatch stopwatch;
  const double used = regular_isovalue(input.grid, isovalue);
  const std::vector<TopologyCount> counts = counted(exact_topology(input.grid, used).components);
  const double seconds = stopwatch.seconds();
  const TopologySum sum = sum_of(counts);
  return Json{{"program", program_json()},
              {"volume", volume_json(input.path, input.grid)},
              {"isovalue", isovalue},
              {"isovalue_used", used},
              {"seed", seed},
              {"components", sum.components},
              {"euler_characteristic", sum.euler_characteristic},
              {"boundary_loops", sum.boundary_loops},
              {"isosurface", topology_json(counts)},
              {"total_seconds", seconds},
              {"peak_memory_bytes", peak_memory_bytes()}};
}

// The field whose isosurface is meshed.
MeshedField meshed_field_of(const RunInput& input, double isovalue, const Parameters& parameters) {
  return meshed_field(input.grid, isovalue, parameters.field, parameters.boundary == Boundary::kClosed,
                      spacing_to_use(parameters, input.grid.spacing()), input.threads);
}

// The part of the mesher's report that also applies to marching cubes.
// The seed changes nothing; it tells the repeats apart.
Json marching_cubes_report(const RunInput& input, double isovalue, const Parameters& parameters, std::uint64_t seed,
                           TriangleMesh& mesh) {
  const Stopwatch stopwatch;
  const MeshedField field = meshed_field_of(input, isovalue, parameters);
  const double used = regular_isovalue(field.grid, field.isovalue);
  MarchingCubesMesh cubes = marching_cubes(field.grid, used, &kExactTests);
  mesh = {std::move(cubes.points), std::move(cubes.triangles)};
  Certificate certificate;
  if (parameters.certify) certificate = certify(mesh, exact_topology(field.grid, used));
  const double seconds = stopwatch.seconds();
  const TopologySum sum = sum_of(certify(mesh, std::vector<ComponentTopology>()).mesh);
  return Json{{"mesher", "marching_cubes"},
              {"program", program_json()},
              {"volume", volume_json(input.path, input.grid)},
              {"isovalue", isovalue},
              {"isovalue_used", used},
              {"parameters", parameters_to_json(parameters)},
              {"seed", seed},
              {"vertices", mesh.points.size()},
              {"triangles", mesh.triangles.size()},
              {"components", sum.components},
              {"euler_characteristic", sum.euler_characteristic},
              {"boundary_loops", sum.boundary_loops},
              {"total_seconds", seconds},
              {"peak_memory_bytes", peak_memory_bytes()},
              {"certificate", certificate_json(certificate)},
              {"quality", quality_json(measure_quality(mesh))}};
}

// The part of the mesher's report that also applies to another program; all of it is judged by the verification.
Json command_report(const RunInput& input, double isovalue, const Variant& variant, std::uint64_t seed,
                    const CommandOutcome& outcome, const JudgedMesh& judged) {
  const TopologySum sum = sum_of(judged.check.topology.mesh);
  const Json command = command_json(outcome);
  return Json{{"mesher", mesher_json(variant)},
              {"program", program_json()},
              {"volume", volume_json(input.path, input.grid)},
              {"isovalue", isovalue},
              {"isovalue_used", judged.check.isovalue_used},
              {"parameters", parameters_to_json(variant.parameters)},
              {"seed", seed},
              {"threads", input.threads},
              {"vertices", judged.check.vertices},
              {"triangles", judged.check.triangles},
              {"components", sum.components},
              {"euler_characteristic", sum.euler_characteristic},
              {"boundary_loops", sum.boundary_loops},
              {"total_seconds", command["cold_seconds"].is_null() ? command["wall_seconds"] : command["cold_seconds"]},
              {"peak_memory_bytes", command["peak_memory_bytes"]},
              {"command", command},
              {"certificate", certificate_json(judged.check.topology)},
              {"quality", quality_json(judged.check.quality)}};
}

// The record has a schema of its own, so the report's is left out.
void append_report(const Json& report, Json& record) {
  for (const auto& [key, value] : report.items()) {
    if (key != "schema") record[key] = value;
  }
}

Json header(const std::string& experiment, const std::string& dataset, const std::string& variant, std::int32_t repeat,
            const std::string& status) {
  return Json{{"schema", kRecordSchema}, {"experiment", experiment}, {"dataset", dataset},
              {"variant", variant},      {"repeat", repeat},         {"status", status}};
}

Json make_empty_record(Task task, bool distances) {
  const ScalarGrid grid({2, 2, 2}, std::vector<float>{0, 1, 1, 1, 1, 1, 1, 1});
  const RunInput input{"", grid, 1, nullptr, {}, nullptr};
  Json record = header("", "", "", 1, kStatusDone);
  if (task == Task::kTopology) {
    append_report(topology_report(input, 0.5, 1), record);
    return record;
  }
  const MeshingOptions options;
  append_report(mesh_report({"", grid, 0.5, options}, MeshingResult{}), record);
  record["command"] = command_json(CommandOutcome{});
  if (!distances) return record;
  record["distances"] = distances_json(JudgedMesh{});
  record["verification"] = verification_json(JudgedMesh{});
  return record;
}

}  // namespace

Json mesher_json(const Variant& variant) {
  if (variant.mesher != Mesher::kCommand) return kMesherNames[static_cast<std::size_t>(variant.mesher)];
  return Json{{"command", variant.command.arguments},
              {"timeout", variant.command.timeout_seconds},
              {"mesh_format", variant.command.mesh_format},
              {"exit_codes", variant.command.exit_codes}};
}

Json run_header(const Experiment& experiment, const PlannedRun& run, const std::string& status) {
  return header(experiment.name, experiment.datasets[run.dataset].name, experiment.variants[run.variant].name,
                run.repeat, status);
}

std::string run_key(const Json& record) {
  return json_line(Json::array({record.at("dataset"), record.at("variant"), record.at("repeat")}));
}

std::string run_key(const Experiment& experiment, const PlannedRun& run) {
  return run_key(run_header(experiment, run, kStatusDone));
}

std::string foreign_part(const Experiment& experiment, const Json& record) {
  const std::string owner = " of the experiment " + experiment.name;
  const Json& name = record.at("experiment");
  if (name != experiment.name) return "it is of the experiment " + json_line(name) + ", not" + owner;
  const auto part = [&](const std::string& key, const std::string& what, const auto& list) {
    const auto value = record.at(key).template get<std::string>();
    std::vector<std::string> known;
    known.reserve(list.size());
    for (const auto& item : list) known.push_back(item.name);
    if (std::find(known.begin(), known.end(), value) != known.end()) return std::string();
    return "its " + what + " '" + value + "' is none" + owner + nearest_name_hint(value, known);
  };
  if (std::string text = part("dataset", "data set", experiment.datasets); !text.empty()) return text;
  if (std::string text = part("variant", "variant", experiment.variants); !text.empty()) return text;
  const Json& repeat = record.at("repeat");
  if (repeat >= 1 && repeat <= experiment.repeats) return "";
  return "its repeat " + repeat.dump() + " is none" + owner + ", whose repeats are 1 to " +
         std::to_string(experiment.repeats);
}

std::optional<Json> run_and_record(const Experiment& experiment, const PlannedRun& run, const RunInput& input) {
  Json record = run_header(experiment, run, kStatusDone);
  reset_peak_memory();  // so that the peak is that of this run
  const double isovalue = experiment.datasets[run.dataset].isovalue;
  const std::uint64_t seed = seed_of(experiment, run.repeat);
  if (experiment.task == Task::kTopology) {
    append_report(topology_report(input, isovalue, seed), record);
    return record;
  }
  const Variant& variant = experiment.variants[run.variant];
  std::optional<CommandOutcome> outcome;
  TriangleMesh mesh;
  if (variant.mesher == Mesher::kCommand) {
    DELISO_CHECK(input.launcher != nullptr, "a run of another program has a launcher");
    outcome =
        run_command_mesher(variant.command, {input.grid, isovalue, seed, input.threads, input.stop}, *input.launcher);
    if (outcome->is_stopped) return std::nullopt;
    mesh = std::move(outcome->mesh);
  } else if (variant.mesher == Mesher::kMarchingCubes) {
    append_report(marching_cubes_report(input, isovalue, variant.parameters, seed, mesh), record);
  } else {
    // Mesh as `deliso mesh` does.
    MeshingOptions options;
    options.parameters = variant.parameters;
    options.seed = seed;
    options.threads = input.threads;
    options.stop = input.stop;
    options.progress = input.progress;
    MeshingResult result = mesh_isosurface(input.grid, isovalue, options);
    if (input.stop != nullptr && input.stop->load()) return std::nullopt;
    append_report(mesh_report({input.path, input.grid, isovalue, options}, result), record);
    mesh = std::move(result.mesh);
  }
  if (!experiment.distances && !outcome) return record;
  const MeshedField field = meshed_field_of(input, isovalue, variant.parameters);
  const JudgedMesh judged = judge_mesh(mesh, field.grid, field.isovalue);
  if (outcome) append_report(command_report(input, isovalue, variant, seed, *outcome, judged), record);
  record["distances"] = distances_json(judged);
  record["verification"] = verification_json(judged);
  return record;
}

const Json& empty_record(Task task, bool distances) {
  // Made once: a report reads the name of the processor.
  static const Json kTopology = make_empty_record(Task::kTopology, false);
  static const Json kMesh = make_empty_record(Task::kMesh, false);
  static const Json kMeshWithDistances = make_empty_record(Task::kMesh, true);
  if (task == Task::kTopology) return kTopology;
  return distances ? kMeshWithDistances : kMesh;
}

}  // namespace deliso

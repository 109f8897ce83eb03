#include "experiments/lesson/lesson_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "experiments/config/config.h"
#include "experiments/lesson/columns.h"
#include "experiments/lesson/followed_mesh.h"
#include "experiments/lesson/lesson_cells.h"
#include "experiments/lesson/lesson_rays.h"
#include "experiments/lesson/trace/trace_writer.h"
#include "experiments/runs/record.h"
#include "surface/certificate/certificate.h"
#include "volume/filters/meshed_field.h"
#include "volume/marching_cubes/marching_cubes.h"
#include "volume/region.h"

namespace deliso {
namespace {

constexpr int kDigits = 6;
constexpr double kPerUnit = 1e5;                       // coordinates of meshes have five digits behind the point
constexpr std::size_t kMostSamples = 40'000;           // of the grid; a larger one is shown without its samples
constexpr std::size_t kMostSurfaceTriangles = 12'000;  // of the approximation; a larger one is left out

double rounded(double value) {
  if (!std::isfinite(value) || value == 0) return value;
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", kDigits, value);
  return std::strtod(text, nullptr);
}

double rounded_coordinate(double value) { return std::nearbyint(value * kPerUnit) / kPerUnit; }

void round_numbers(Json& json, bool are_coordinates = false) {
  if (json.is_number_float()) {
    json = are_coordinates ? rounded_coordinate(json.get<double>()) : rounded(json.get<double>());
  } else if (json.is_object()) {
    for (const auto& item : json.items()) round_numbers(item.value(), item.key() == "p" || item.key() == "points");
  } else if (json.is_array()) {
    for (Json& part : json) round_numbers(part, are_coordinates);
  }
}

// Circumcenters of flat tetrahedra, and poles with them, move far with the last digits of the corners, so that points
// of stage 1 keep all of theirs.
void round_event(Json& event) {
  const Json kind = event.at("e");
  const char* const key = kind == "initial" ? "points" : kind == "insert" ? "p" : nullptr;
  const Json exact = key == nullptr ? Json() : event.at(key);
  round_numbers(event);
  if (key != nullptr) event[key] = exact;
}

Json rounded_array_of(const Vec3& p) {
  return Json::array({rounded_coordinate(p.x), rounded_coordinate(p.y), rounded_coordinate(p.z)});
}

// What the page draws of the field: samples less the isovalue, for slices; and marching cubes' surface, for the eye.
Json volume_of(const ScalarGrid& grid, double isovalue, const Vec3& step) {
  Json volume = {{"dims", grid.dims()}, {"step", {step.x, step.y, step.z}}};
  Json samples = Json::array(), points = Json::array();
  const auto [nx, ny, nz] = grid.dims();
  if (std::size_t(nx) * std::size_t(ny) * std::size_t(nz) > kMostSamples) return volume;
  for (std::int32_t k = 0; k < nz; ++k) {
    for (std::int32_t j = 0; j < ny; ++j) {
      for (std::int32_t i = 0; i < nx; ++i) samples.push_back(rounded(grid.at(i, j, k) - isovalue));
    }
  }
  volume["samples"] = list_of_values(samples);
  const MarchingCubesMesh surface = marching_cubes(grid, isovalue);
  if (surface.triangles.size() > kMostSurfaceTriangles) return volume;
  const Vec3 &spacing = grid.spacing(), per_step{1 / spacing.x, 1 / spacing.y, 1 / spacing.z};
  for (const Vec3& p : surface.points) {
    points.push_back(rounded_array_of(scaled(scaled(p - grid.origin(), per_step), step)));
  }
  volume["points"] = list_of_values(points);
  volume["triangles"] = list_of_values(surface.triangles);
  return volume;
}

Json counts_of(const std::vector<TopologyCount>& counts) {
  Json all = Json::array();
  for (const TopologyCount& entry : counts) {
    all.push_back({{"chi", entry.topology.euler_characteristic},
                   {"loops", entry.topology.boundary_loops},
                   {"count", entry.count}});
  }
  return all;
}

Json end_of(const MeshingResult& result) {
  return {{"e", "end"},
          {"verdict", verdict_name(result.certificate.verdict)},
          {"proven", is_proven(result.certificate)},
          {"vertices", result.mesh.points.size()},
          {"triangles", result.mesh.triangles.size()},
          {"mesh", counts_of(result.certificate.mesh)},
          {"isosurface", counts_of(result.certificate.isosurface)},
          {"repair_rounds", result.repair.rounds}};
}

bool is_of_stage_2(const Json& event) {
  const std::string& kind = event.at("e").get_ref<const std::string&>();
  return kind == "refine" || kind == "keep" || kind == "restart" || kind == "refined" || kind == "shape";
}

// The triangles of E in the numbers of its rim, which has all their corners; the first of them is the triangle in
// question.
void number_by_rim(Json& event) {
  if (event.at("e") != "refine") return;
  const Json rim = event.at("rim");  // a copy: keys that go move those behind them
  if (event.at("t") == event.at("gone").at(0)) event.erase("t");
  for (Json& triangle : event["gone"]) {
    for (Json& corner : triangle) corner = std::find(rim.begin(), rim.end(), corner) - rim.begin();
  }
}

// What mesh_isosurface() makes of the grid before it meshes it: the page draws the run in it.
ScalarGrid grid_to_mesh(const ScalarGrid& grid, double isovalue, const MeshingOptions& options) {
  const Parameters& parameters = options.parameters;
  const SampleRegion region = region_of(parameters.region);
  const ScalarGrid part = region.is_all() ? grid : cropped(grid, region);
  return meshed_field(part, isovalue, parameters.field, parameters.boundary == Boundary::kClosed,
                      spacing_to_use(parameters, part.spacing()), options.threads)
      .grid;
}

}  // namespace

LessonRun run_observed(std::string name, const ScalarGrid& grid, double isovalue, MeshingOptions options) {
  LessonRun run;
  run.name = std::move(name);
  TraceWriter writer([&](const TraceEvent& event) { run.events.push_back(event); });
  options.observer = &writer;
  run.result = mesh_isosurface(grid, isovalue, options);
  run.events.push_back(end_of(run.result));
  run.limits = {{"epsilon", options.parameters.stage1.epsilon},
                {"rho", options.parameters.stage1.rho},
                {"pole_height", parameters_to_json(options.parameters).at("stage2").at("pole_height")}};
  const ScalarGrid meshed = grid_to_mesh(grid, isovalue, options);
  const Vec3 spacing = spacing_to_use(options.parameters, meshed.spacing());
  run.rays = lesson_rays(meshed, run.result.isovalue_used, spacing, options.seed);
  run.cells = lesson_cells(meshed, run.result.isovalue_used);
  run.volume = volume_of(meshed, run.result.isovalue_used, spacing / std::min({spacing.x, spacing.y, spacing.z}));
  return run;
}

Json lesson_data(const LessonRun& run, LessonPart part, std::size_t most_events) {
  Json events = Json::array(), rays = part == LessonPart::kWhole ? run.rays : Json::array();
  round_numbers(rays);
  std::size_t of_stage_2 = 0, left_out = 0;
  FollowedMesh mesh;
  for (Json event : run.events) {
    const std::string& kind = event.at("e").get_ref<const std::string&>();
    if (part == LessonPart::kStage2 && (kind == "initial" || kind == "insert" || kind == "refuse")) continue;
    // What follows a cut cannot be replayed. The last two events are the outcome; stage 1 is short enough.
    if (is_of_stage_2(event) && of_stage_2++ >= most_events) {
      ++left_out;
      continue;
    }
    round_event(event);
    Json shown = event.at("e") == "shape" ? mesh.changes(event) : event;
    if (event.at("e") != "compare") mesh.follow(event);
    number_by_rim(shown);
    events.push_back(std::move(shown));
  }
  return {{"name", run.name},    {"volume", run.volume}, {"limits", run.limits},
          {"rays", rays},        {"cells", run.cells},   {"events", list_of_objects(events)},
          {"left_out", left_out}};
}

}  // namespace deliso

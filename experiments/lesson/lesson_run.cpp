#include "experiments/lesson/lesson_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "experiments/lesson/lesson_cells.h"
#include "experiments/lesson/lesson_rays.h"
#include "experiments/lesson/trace/trace_writer.h"
#include "experiments/runs/record.h"
#include "surface/certificate/certificate.h"
#include "volume/marching_cubes/marching_cubes.h"

namespace deliso {
namespace {

constexpr int kDigits = 6;
constexpr std::size_t kMostSamples = 40'000;           // of the grid; a larger one is shown without its samples
constexpr std::size_t kMostSurfaceTriangles = 12'000;  // of the approximation; a larger one is left out

double rounded(double value) {
  if (!std::isfinite(value) || value == 0) return value;
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", kDigits, value);
  return std::strtod(text, nullptr);
}

void round_numbers(Json& json) {
  if (json.is_number_float()) {
    json = rounded(json.get<double>());
  } else if (json.is_structured()) {
    for (Json& part : json) round_numbers(part);
  }
}

Json rounded_array_of(const Vec3& p) { return Json::array({rounded(p.x), rounded(p.y), rounded(p.z)}); }

// What the page draws of the field: samples less the isovalue, for slices; and marching cubes' surface, for the eye.
Json volume_of(const ScalarGrid& grid, double isovalue, const Vec3& step) {
  Json volume = {{"dims", grid.dims()}, {"step", rounded_array_of(step)}, {"samples", Json::array()}};
  const auto [nx, ny, nz] = grid.dims();
  if (std::size_t(nx) * std::size_t(ny) * std::size_t(nz) > kMostSamples) return volume;
  for (std::int32_t k = 0; k < nz; ++k) {
    for (std::int32_t j = 0; j < ny; ++j) {
      for (std::int32_t i = 0; i < nx; ++i) volume["samples"].push_back(rounded(grid.at(i, j, k) - isovalue));
    }
  }
  const MarchingCubesMesh surface = marching_cubes(grid, isovalue);
  if (surface.triangles.size() > kMostSurfaceTriangles) return volume;
  volume["points"] = Json::array();
  const Vec3 &spacing = grid.spacing(), per_step{1 / spacing.x, 1 / spacing.y, 1 / spacing.z};
  for (const Vec3& p : surface.points) {
    volume["points"].push_back(rounded_array_of(scaled(scaled(p - grid.origin(), per_step), step)));
  }
  volume["triangles"] = surface.triangles;
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

}  // namespace

LessonRun run_observed(std::string name, const ScalarGrid& grid, double isovalue, MeshingOptions options) {
  LessonRun run;
  run.name = std::move(name);
  TraceWriter writer([&](const TraceEvent& event) { run.events.push_back(event); });
  options.observer = &writer;
  run.result = mesh_isosurface(grid, isovalue, options);
  run.events.push_back(end_of(run.result));
  run.limits = {{"epsilon", options.parameters.stage1.epsilon}, {"rho", options.parameters.stage1.rho}};
  const Vec3 spacing = spacing_to_use(options.parameters, grid.spacing());
  run.rays = lesson_rays(grid, run.result.isovalue_used, spacing, options.seed);
  run.cells = lesson_cells(grid, run.result.isovalue_used);
  run.volume = volume_of(grid, run.result.isovalue_used, spacing / std::min({spacing.x, spacing.y, spacing.z}));
  return run;
}

Json lesson_data(const LessonRun& run, LessonPart part, std::size_t most_bytes) {
  Json events = Json::array(), rays = part == LessonPart::kWhole ? run.rays : Json::array();
  round_numbers(rays);
  std::size_t bytes = run.volume.dump().size() + rays.dump().size() + run.cells.dump().size(), left_out = 0;
  bool is_cut = false;
  for (Json event : run.events) {
    const std::string& kind = event.at("e").get_ref<const std::string&>();
    if (part == LessonPart::kStage2 && (kind == "initial" || kind == "insert" || kind == "refuse")) continue;
    round_numbers(event);
    const std::size_t its = event.dump().size() + 1;
    // What follows a cut cannot be replayed. The last two events are the outcome; stage 1 is short enough.
    is_cut = is_cut || (is_of_stage_2(event) && bytes + its > most_bytes);
    if (is_cut && event.at("e") != "certify" && event.at("e") != "end") {
      ++left_out;
      continue;
    }
    bytes += its;
    events.push_back(std::move(event));
  }
  return {{"name", run.name},   {"volume", run.volume},        {"limits", run.limits}, {"rays", rays},
          {"cells", run.cells}, {"events", std::move(events)}, {"left_out", left_out}};
}

}  // namespace deliso

#include "experiments/runs/record.h"

#include "experiments/config/config.h"
#include "experiments/system/program_info.h"
#include "volume/io/sha256.h"

namespace deliso {
namespace {

Json vector_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

Json quotient(double numerator, std::int64_t denominator) {
  return denominator > 0 ? Json(numerator / static_cast<double>(denominator)) : Json(nullptr);
}

Json stage_json(const StageStats& stage) { return Json{{"seconds", stage.seconds}}; }

// The fields common to the two stages that insert points.
template <class Stats>
Json insertion_stage_json(const Stats& stage) {
  return Json{{"seconds", stage.seconds},
              {"insertions", stage.insertions},
              {"seconds_per_insertion", quotient(stage.seconds, stage.insertions)},
              {"searches", stage.search.searches},
              {"solves", stage.search.solves},
              {"searches_hit", stage.search.searches_hit},
              {"solves_hit", stage.search.solves_hit},
              {"boundary_splits", stage.boundary_splits}};
}

Json recover_json(const RecoverStats& recover) {
  Json json = insertion_stage_json(recover);
  json["multi_intersect"] = recover.multi_intersect;
  json["extract_manifold"] = recover.extract_manifold;
  json["approximate_geometry"] = recover.approximate_geometry;
  json["uncovered"] = recover.uncovered;
  json["refused_by_size_bound"] = recover.refused_by_size_bound;
  json["hits_against_signs"] = recover.hits_against_signs;
  json["share_restricted"] = recover.seconds > 0 ? Json(recover.restricted_seconds / recover.seconds) : Json(nullptr);
  return json;
}

Json refine_json(const RefineStats& refine) {
  Json json = insertion_stage_json(refine);
  Json& refused = json["refused"] = Json::object();
  for (std::size_t cause = 0; cause < kRefusalNames.size(); ++cause) {
    refused[std::string(kRefusalNames[cause])] = refine.refused[cause];
  }
  json["stopped_at_r_min"] = refine.stopped_at_r_min;
  json["restarts"] = refine.restarts;
  json["halvings"] = refine.halvings;
  json["coverage_targets"] = refine.coverage_targets;
  return json;
}

// Positions in the world.
Json shape_json(const MeshingResult& result) {
  const ShapeStats& shape = result.shape;
  Json json{{"seconds", shape.seconds}, {"bad_before", shape.bad_before}, {"bad_after", shape.bad_after}};
  for (std::size_t kind = 0; kind < kShapeStepNames.size(); ++kind) {
    json[std::string(kShapeStepNames[kind])] = shape.steps[kind];
  }
  Json& worst = json["worst"] = Json::array();
  for (const BadTriangle& bad : shape.worst) {
    worst.push_back(Json{{"min_angle_degrees", bad.degrees()}, {"position", vector_json(bad.centroid)}});
  }
  return json;
}

Json repair_json(const RepairStats& repair) {
  return Json{{"seconds", repair.seconds},
              {"rounds", repair.rounds},
              {"cells_refined", repair.cells_refined},
              {"components_before", repair.components_before},
              {"components_mixed", repair.components_mixed},
              {"components_stray", repair.components_stray},
              {"components_polygonized", repair.components_polygonized},
              {"foreign_vertices_removed", repair.foreign_vertices_removed},
              {"inverted_umbrellas_removed", repair.inverted_umbrellas_removed},
              {"vertices_before", repair.vertices_before},
              {"vertices_after", repair.vertices_after}};
}

Json decimation_json(const DecimationStats& decimation) {
  return Json{{"seconds", decimation.seconds},
              {"vertices_before", decimation.vertices_before},
              {"vertices_after", decimation.vertices_after},
              {"largest_error_voxels", decimation.largest_error}};
}

// Components left out on purpose. Positions in the world, measures in voxels.
Json dropped_json(const std::vector<DroppedPiece>& dropped) {
  Json list = Json::array();
  for (const auto& [piece, cause] : dropped) {
    list.push_back(Json{{"cause", cause == DropCause::kCavity  ? "cavity"
                                  : cause == DropCause::kSmall ? "small"
                                                               : "not_largest"},
                        {"vertices", piece.vertices},
                        {"area", piece.area},
                        {"volume", piece.volume ? Json(*piece.volume) : Json()},
                        {"position", vector_json(piece.at)}});
  }
  return list;
}

// Finding the exact topology is part of certifying (the seeds use it too), so its time is counted there.
Json certify_json(const MeshingResult& result) {
  return Json{{"seconds", result.certify_stage.seconds + result.topology.seconds},
              {"exact_topology_seconds", result.topology.seconds}};
}

Json build_json(const BuildStats& build) {
  return Json{{"seconds", build.seconds}, {"bounds_a_solid", build.bounds_a_solid}};
}

Json initial_json(const MeshingResult& result) {
  return Json{{"seconds", result.initial.seconds},
              {"searches", result.initial_search.searches},
              {"solves", result.initial_search.solves}};
}

// In the order of the pipeline.
Json stages_json(const MeshingResult& result) {
  return Json{{"index", stage_json(result.index)},
              {"initial", initial_json(result)},
              {"recover", recover_json(result.recover)},
              {"repair", repair_json(result.repair)},
              {"poles", stage_json(result.poles)},
              {"build", build_json(result.build)},
              {"refine", refine_json(result.refine)},
              {"shape", shape_json(result)},
              {"decimate", decimation_json(result.decimation)},
              {"certify", certify_json(result)}};
}

// The stage's name in the paper and in the report.
std::string stage_text(std::string_view stage) {
  if (stage == "recover") return "stage 1 (recover)";
  return stage == "refine" ? "stage 2 (refine)" : "the stage '" + std::string(stage) + "'";
}

}  // namespace

Json program_json() {
  const ProgramInfo info = program_info();
  return Json{{"version", info.version},
              {"commit", info.commit},
              {"compiler", info.compiler},
              {"flags", info.flags},
              {"cpu", info.cpu}};
}

Json volume_json(const std::filesystem::path& path, const ScalarGrid& grid, const std::string& sha256) {
  return Json{{"path", path.string()},
              {"dims", grid.dims()},
              {"samples", std::int64_t{grid.dims()[0]} * grid.dims()[1] * grid.dims()[2]},
              {"spacing", vector_json(grid.spacing())},
              {"origin", vector_json(grid.origin())},
              {"type", grid.type_name()},
              {"range", Json::array({grid.range().first, grid.range().second})},
              {"sha256", sha256.empty() ? sample_sha256(grid) : sha256}};
}

Json topology_json(const std::vector<TopologyCount>& counts) {
  Json list = Json::array();
  for (const TopologyCount& entry : counts) {
    list.push_back(Json{{"euler_characteristic", entry.topology.euler_characteristic},
                        {"boundary_loops", entry.topology.boundary_loops},
                        {"count", entry.count}});
  }
  return list;
}

Json certificate_json(const Certificate& certificate) {
  const bool is_checked = certificate.verdict != Verdict::kNotChecked;
  return Json{{"verdict", verdict_name(certificate.verdict)},
              {"manifold", is_checked ? Json(certificate.manifold) : Json()},
              {"oriented", is_checked ? Json(certificate.oriented) : Json()},
              {"mesh", topology_json(certificate.mesh)},
              {"isosurface", topology_json(certificate.isosurface)},
              {"differences", certificate.differences},
              {"proven", is_checked ? Json(is_proven(certificate)) : Json()},
              {"broken", certificate.broken}};
}

Json quality_json(const MeshQuality& quality) {
  return Json{{"min_angle_degrees", quality.min_angle_degrees},
              {"mean_min_angle_degrees", quality.mean_min_angle_degrees},
              {"max_angle_degrees", quality.max_angle_degrees},
              {"radius_edge_max", quality.radius_edge_max},
              {"radius_edge_p99", quality.radius_edge_p99},
              {"fraction_min_angle_below_30", quality.fraction_min_angle_below_30},
              {"min_angle_histogram", quality.min_angle_histogram}};
}

std::string verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kHomeomorphic:
      return "homeomorphic";
    case Verdict::kDifferent:
      return "different";
    case Verdict::kSingularIsovalue:
      return "singular_isovalue";
    case Verdict::kNotChecked:
      return "not_checked";
  }
  return "not_checked";
}

TopologySum sum_of(const std::vector<TopologyCount>& counts) {
  TopologySum sum;
  for (const TopologyCount& entry : counts) {
    sum.components += entry.count;
    sum.euler_characteristic += entry.count * entry.topology.euler_characteristic;
    sum.boundary_loops += entry.count * entry.topology.boundary_loops;
  }
  return sum;
}

std::vector<TopologyCount> mesh_topology(const MeshingResult& result) {
  if (!result.certificate.mesh.empty()) return result.certificate.mesh;
  return certify(result.mesh, std::vector<ComponentTopology>()).mesh;
}

std::vector<std::string> unmet_goals(const MeshRun& run, const MeshingResult& result) {
  if (!result.stopped_early()) return {};
  // Which limit stopped the run: a signal is known, and so are the values of the budgets.
  const BudgetParameters& budget = run.options.parameters.budget;
  std::string cause = "the budget";
  if (run.options.stop != nullptr && run.options.stop->load()) {
    cause = "a signal";
  } else if (budget.max_vertices && static_cast<std::int64_t>(result.mesh.points.size()) >= *budget.max_vertices) {
    cause = "budget.max_vertices = " + std::to_string(*budget.max_vertices);
  } else if (budget.seconds) {
    cause = "budget.seconds = " + Json(*budget.seconds).dump();
  }
  std::vector<std::string> goals = {stage_text(result.stopped_in) + " was stopped by " + cause +
                                    " while triangles that violate a criterion were still waiting"};
  if (run.options.parameters.certify && result.certificate.verdict != Verdict::kHomeomorphic) {
    goals.push_back("the mesh is not proven homeomorphic to the isosurface");
  }
  return goals;
}

Json mesh_report(const MeshRun& run, const MeshingResult& result) {
  const TopologySum topology = sum_of(mesh_topology(result));
  return Json{{"schema", kReportSchema},
              {"program", program_json()},
              {"volume", volume_json(run.volume_path, run.grid, run.volume_sha256)},
              {"isovalue", run.isovalue},
              {"isovalue_used", result.isovalue_used},
              {"parameters", parameters_to_json(run.options.parameters)},
              {"seed", run.options.seed},
              {"threads", run.options.threads},
              {"r_min_voxels", result.r_min_voxels},
              {"stopped_early", result.stopped_early()},
              {"stopped_in", result.stopped_early() ? Json(result.stopped_in) : Json()},
              {"unmet", unmet_goals(run, result)},
              {"vertices", result.mesh.points.size()},
              {"triangles", result.mesh.triangles.size()},
              {"components", topology.components},
              {"euler_characteristic", topology.euler_characteristic},
              {"boundary_loops", topology.boundary_loops},
              {"promised_distance_voxels", result.promised_distance},
              {"longest_edge_voxels", result.longest_edge},
              {"dropped", dropped_json(result.dropped)},
              {"total_seconds", result.total_seconds},
              {"peak_memory_bytes", peak_memory_bytes()},
              {"stages", stages_json(result)},
              {"certificate", certificate_json(result.certificate)},
              {"quality", quality_json(measure_quality(result.mesh, run.options.threads))}};
}

}  // namespace deliso

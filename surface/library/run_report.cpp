#include "surface/library/run_report.h"

#include <type_traits>
#include <utility>
#include <variant>

#include "surface/base/parameter_table.h"
#include "surface/mesh/mesh_quality.h"

namespace deliso {
namespace {

JsonTree quotient(double numerator, std::int64_t denominator) {
  return denominator > 0 ? JsonTree(numerator / static_cast<double>(denominator)) : JsonTree();
}

JsonTree stage_json(const StageStats& stage) { return JsonTree{{"seconds", stage.seconds}}; }

// The fields common to the two stages that insert points.
template <class Stats>
JsonTree insertion_stage_json(const Stats& stage) {
  return JsonTree{{"seconds", stage.seconds},
                  {"insertions", stage.insertions},
                  {"seconds_per_insertion", quotient(stage.seconds, stage.insertions)},
                  {"searches", stage.search.searches},
                  {"solves", stage.search.solves},
                  {"searches_hit", stage.search.searches_hit},
                  {"solves_hit", stage.search.solves_hit},
                  {"boundary_splits", stage.boundary_splits}};
}

JsonTree recover_json(const RecoverStats& recover) {
  JsonTree json = insertion_stage_json(recover);
  json["multi_intersect"] = recover.multi_intersect;
  json["extract_manifold"] = recover.extract_manifold;
  json["approximate_geometry"] = recover.approximate_geometry;
  json["uncovered"] = recover.uncovered;
  json["refused_by_size_bound"] = recover.refused_by_size_bound;
  json["hits_against_signs"] = recover.hits_against_signs;
  json["share_restricted"] = recover.seconds > 0 ? JsonTree(recover.restricted_seconds / recover.seconds) : JsonTree();
  return json;
}

JsonTree refine_json(const RefineStats& refine) {
  JsonTree json = insertion_stage_json(refine);
  JsonTree& refused = json["refused"];
  for (std::size_t cause = 0; cause < kRefusalNames.size(); ++cause) {
    refused[kRefusalNames[cause]] = refine.refused[cause];
  }
  json["stopped_at_r_min"] = refine.stopped_at_r_min;
  json["restarts"] = refine.restarts;
  json["halvings"] = refine.halvings;
  json["flips"] = refine.flips;
  json["moves"] = refine.moves;
  json["coverage_targets"] = refine.coverage_targets;
  return json;
}

// Positions in the world.
JsonTree shape_json(const MeshingResult& result) {
  const ShapeStats& shape = result.shape;
  JsonTree json{{"seconds", shape.seconds}, {"bad_before", shape.bad_before}, {"bad_after", shape.bad_after}};
  for (std::size_t kind = 0; kind < kShapeStepNames.size(); ++kind) {
    json[kShapeStepNames[kind]] = shape.steps[kind];
  }
  JsonTree& worst = json["worst"] = JsonTree::array();
  for (const BadTriangle& bad : shape.worst) {
    worst.push_back(JsonTree{{"min_angle_degrees", bad.degrees()}, {"position", bad.centroid}});
  }
  return json;
}

JsonTree repair_json(const RepairStats& repair) {
  return JsonTree{{"seconds", repair.seconds},
                  {"rounds", repair.rounds},
                  {"cells_refined", repair.cells_refined},
                  {"components_before", repair.components_before},
                  {"components_mixed", repair.components_mixed},
                  {"components_displaced", repair.components_displaced},
                  {"components_stray", repair.components_stray},
                  {"components_given_up", repair.components_given_up},
                  {"components_polygonized", repair.components_polygonized},
                  {"foreign_vertices_removed", repair.foreign_vertices_removed},
                  {"inverted_umbrellas_removed", repair.inverted_umbrellas_removed},
                  {"vertices_before", repair.vertices_before},
                  {"vertices_after", repair.vertices_after}};
}

JsonTree decimation_json(const DecimationStats& decimation) {
  return JsonTree{{"seconds", decimation.seconds},
                  {"vertices_before", decimation.vertices_before},
                  {"vertices_after", decimation.vertices_after},
                  {"largest_error_voxels", decimation.largest_error}};
}

// Components left out on purpose. Positions in the world, measures in voxels.
JsonTree dropped_json(const std::vector<DroppedPiece>& dropped) {
  JsonTree list = JsonTree::array();
  for (const auto& [piece, cause] : dropped) {
    list.push_back(JsonTree{{"cause", cause == DropCause::kCavity  ? "cavity"
                                      : cause == DropCause::kSmall ? "small"
                                                                   : "not_largest"},
                            {"vertices", piece.vertices},
                            {"area", piece.area},
                            {"volume", piece.volume},
                            {"position", piece.at}});
  }
  return list;
}

// Finding the exact topology is part of certifying (the seeds use it too), so its time is counted there.
JsonTree certify_json(const MeshingResult& result) {
  return JsonTree{{"seconds", result.certify_stage.seconds + result.topology.seconds},
                  {"exact_topology_seconds", result.topology.seconds}};
}

JsonTree build_json(const BuildStats& build) {
  return JsonTree{{"seconds", build.seconds}, {"bounds_a_solid", build.bounds_a_solid}};
}

JsonTree initial_json(const MeshingResult& result) {
  return JsonTree{{"seconds", result.initial.seconds},
                  {"searches", result.initial_search.searches},
                  {"solves", result.initial_search.solves}};
}

// In the order of the pipeline.
JsonTree stages_json(const MeshingResult& result) {
  return JsonTree{{"index", stage_json(result.index)},
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

}  // namespace

JsonTree topology_tree(const std::vector<TopologyCount>& counts) {
  JsonTree list = JsonTree::array();
  for (const TopologyCount& entry : counts) {
    list.push_back(JsonTree{{"euler_characteristic", entry.topology.euler_characteristic},
                            {"boundary_loops", entry.topology.boundary_loops},
                            {"count", entry.count}});
  }
  return list;
}

JsonTree certificate_tree(const Certificate& certificate) {
  const bool is_checked = certificate.verdict != Verdict::kNotChecked;
  return JsonTree{{"verdict", verdict_name(certificate.verdict)},
                  {"manifold", is_checked ? JsonTree(certificate.manifold) : JsonTree()},
                  {"oriented", is_checked ? JsonTree(certificate.oriented) : JsonTree()},
                  {"mesh", topology_tree(certificate.mesh)},
                  {"isosurface", topology_tree(certificate.isosurface)},
                  {"differences", certificate.differences},
                  {"proven", is_checked ? JsonTree(is_proven(certificate)) : JsonTree()},
                  {"broken", certificate.broken}};
}

JsonTree quality_tree(const MeshQuality& quality) {
  return JsonTree{{"min_angle_degrees", quality.min_angle_degrees},
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

JsonTree parameters_tree(const Parameters& parameters) {
  JsonTree tree;
  for (const ParameterField& field : parameter_table()) {
    JsonTree& object = group_of(field.path).empty() ? tree : tree[group_of(field.path)];
    object[key_of(field.path)] = std::visit(
        [](const auto& held) -> JsonTree {
          if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>) {
            return {};
          } else {
            return held;
          }
        },
        field.get(parameters));
  }
  return tree;
}

void move_positions(const Affine& to_world, MeshingResult& result) {
  for (BadTriangle& bad : result.shape.worst) bad.centroid = to_world(bad.centroid);
  for (DroppedPiece& dropped : result.dropped) dropped.piece.at = to_world(dropped.piece.at);
}

JsonTree run_report(double isovalue, const MeshingOptions& options, const MeshingResult& result,
                    const MeshQuality& quality) {
  const TopologySum topology = sum_of(mesh_topology(result));
  return JsonTree{
      {"isovalue", isovalue},
      {"isovalue_used", result.isovalue_used},
      {"parameters", parameters_tree(options.parameters)},
      {"seed", options.seed},
      {"threads", options.threads},
      {"r_min_voxels", result.r_min_voxels},
      {"stopped_early", result.stopped_early()},
      {"stopped_in", result.stopped_early() ? JsonTree(result.stopped_in) : JsonTree()},
      {"unmet", unmet_goals(options, result)},
      {"vertices", result.mesh.points.size()},
      {"triangles", result.mesh.triangles.size()},
      {"components", topology.components},
      {"euler_characteristic", topology.euler_characteristic},
      {"boundary_loops", topology.boundary_loops},
      {"promised_distance_voxels", result.stopped_early() ? JsonTree() : JsonTree(result.promised_distance)},
      {"longest_edge_voxels", result.longest_edge},
      {"dropped", dropped_json(result.dropped)},
      {"dropped_components", result.dropped_components},
      {"total_seconds", result.total_seconds},
      {"stages", stages_json(result)},
      {"certificate", certificate_tree(result.certificate)},
      {"quality", quality_tree(quality)}};
}

}  // namespace deliso

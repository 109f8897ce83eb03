#include "surface/deliso.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/memory.h"
#include "delaunay/base/shortest_text.h"
#include "delaunay/base/stopwatch.h"
#include "surface/base/stage_stats.h"
#include "surface/certificate/final_certificate.h"
#include "surface/extract/build_triangle_mesh.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/recover/coverage.h"
#include "surface/recover/initial_triangulation.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "surface/restricted/poles.h"
#include "surface/restricted/restricted_delaunay.h"
#include "surface/restricted/signs_from_facets.h"
#include "volume/isovalue_range.h"

namespace deliso {

namespace {

// Rounds of looking for parts of the surface that the mesh of stage 1 misses.
constexpr int kCoverageRounds = 4;

// Runs one stage and adds its wall-clock time to `stage`.
template <class Body>
auto timed(StageStats& stage, Body body) {
  const Stopwatch watch;
  struct AddAtEnd {
    StageStats& stage;
    const Stopwatch& watch;
    ~AddAtEnd() { stage.seconds += watch.seconds(); }
  } const add_at_end{stage, watch};
  return body();
}

void check_isovalue(const ScalarGrid& grid, double isovalue) {
  if (!std::isfinite(isovalue)) {
    throw InputError("isovalue " + shortest_text(isovalue) + " is not a finite number");
  }
  if (!has_isosurface(grid, isovalue)) {
    throw InputError("isovalue " + shortest_text(isovalue) +
                     " gives a surface with no point: " + isovalue_range_text(grid, isovalue));
  }
}

// Lengths of the parameters in mesh-space units.
struct Lengths {
  double r_min_stage1;
  double r_min_stage2;
  double size_bound;
};

Lengths lengths_of(const Parameters& parameters, const Box3& box) {
  const double b = box.smallest_side();
  return {parameters.stage1.r_min * b, parameters.stage2.r_min * b,
          std::max(parameters.stage1.r_min * b, parameters.stage1.size_bound_voxels)};
}

RecoverOptions stage1_options(const Parameters& parameters, const Lengths& lengths, int threads) {
  RecoverOptions options;
  options.threads = threads;
  options.geometry = {
      .epsilon = parameters.stage1.epsilon, .rho = parameters.stage1.rho, .r_min = lengths.r_min_stage1};
  options.size_bound = lengths.size_bound;
  options.order = parameters.queue_order;
  return options;
}

RecoverOptions full3d_options(const Parameters& parameters, const Lengths& lengths) {
  RecoverOptions options;
  options.geometry = {.epsilon = parameters.stage2.epsilon1,
                      .rho = parameters.stage2.rho,
                      .r_min = lengths.r_min_stage2,
                      .epsilon2 = parameters.stage2.epsilon2,
                      .criterion2 = parameters.stage2.criterion2,
                      .new_pole = parameters.stage2.new_pole};
  if (parameters.stage2.max_distance) options.geometry.max_distance = *parameters.stage2.max_distance;
  options.size_bound = lengths.r_min_stage2;
  options.order = parameters.queue_order;
  return options;
}

RefineOptions stage2_options(const Parameters& parameters, const Lengths& lengths,
                             std::span<const Vec3> coverage_targets, int threads) {
  RefineOptions options;
  options.coverage_targets = coverage_targets;
  options.threads = threads;
  options.epsilon1 = parameters.stage2.epsilon1;
  options.epsilon2 = parameters.stage2.epsilon2;
  options.rho = parameters.stage2.rho;
  options.r_min = lengths.r_min_stage2;
  if (parameters.stage2.max_distance) options.max_distance = *parameters.stage2.max_distance;
  options.order = parameters.queue_order;
  options.restart_at_crossings = repairs(parameters);
  options.criterion2 = parameters.stage2.criterion2;
  options.new_pole = parameters.stage2.new_pole;
  options.store_hits = parameters.stage2.store_hits;
  options.keep_neighbours = false;
  return options;
}

// Recover; and, when the exact topology is known, with samples of fingers of the surface that hide within a Voronoi
// cell. Returns coverage targets for stage 2, if it asks for them: the crossings that the first mesh of stage 1 is
// not close to.
std::vector<Vec3> recover_all(RestrictedDelaunay& restricted, const ScalarGrid& grid,
                              const IsosurfaceTopology* topology, const MeshingOptions& options, const Lengths& lengths,
                              Controls& controls, RecoverStats& stats) {
  const RecoverOptions stage1 = stage1_options(options.parameters, lengths, options.threads);
  recover(restricted, stage1, controls, stats);
  if (topology == nullptr || !options.parameters.stage1.coverage || controls.stopped()) return {};
  // Only where triangles that they make cross are looked for.
  const bool wants_targets = options.parameters.algorithm == Algorithm::kTwoStage && repairs(options.parameters);
  std::vector<Vec3> coverage_targets;
  std::vector<std::uint32_t> suspects = all_crossings(grid, *topology, options.threads);
  for (int i = 0; i < kCoverageRounds; ++i) {
    const std::vector<Vec3> points = uncovered_points(restricted, grid, *topology, suspects, options.threads,
                                                      i == 0 && wants_targets ? &coverage_targets : nullptr);
    if (recover_with(restricted, points, stage1, controls, stats) == 0 || controls.poll()) break;
  }
  coverage_targets.shrink_to_fit();
  return coverage_targets;
}

void take_counters(const RestrictedDelaunay& restricted, RecoverStats& stats) {
  stats.search += restricted.counters();
  stats.restricted_seconds = restricted.restricted_seconds();
  stats.hits_against_signs = restricted.hits_against_signs();
}

// Without one sign per tetrahedron: gives the tetrahedra the signs that the restricted facets ask for, if there are
// any.
bool take_sides_of_facets(RestrictedDelaunay& restricted) {
  const std::optional<TetSigns> above = signs_from_facets(restricted);
  if (above) restricted.set_signs(*above);
  return above.has_value();
}

// The surface mesh that stage 2 starts from, with pole heights.
SurfaceMesh surface_from(std::unique_ptr<RestrictedDelaunay> restricted, std::unique_ptr<ExactSurfaceCache> facts,
                         const MeshingOptions& options, Controls& controls, MeshingResult& result) {
  const Parameters& parameters = options.parameters;
  if (repairs(parameters)) {
    return timed(result.repair, [&] {
      // Dual edges and hits are of no use any more.
      auto signs_alone = std::make_unique<SignedDelaunay>(std::move(*restricted));
      restricted.reset();
      release_free_memory();
      return repair(*facts, std::move(signs_alone), parameters.repair.max_rounds, options.threads, controls,
                    result.repair);
    });
  }
  if (!parameters.stage1.one_sign_per_tetrahedron) {
    result.build.bounds_a_solid = timed(result.build, [&] { return take_sides_of_facets(*restricted); });
    if (!result.build.bounds_a_solid) return timed(result.build, [&] { return facets_alone(*restricted); });
  }
  const std::vector<double> heights =
      timed(result.poles, [&] { return compute_poles(*restricted, parameters.stage2.pole_height); });
  return timed(result.build, [&] {
    BuiltMesh built = build_triangle_mesh(*restricted);
    separate_pinches(built.mesh, built.groups, built.vertex_of, restricted->isosurface().box());
    for (const VertexId v : built.vertex_of) built.mesh.pole_heights.push_back(heights[v.index()]);
    return std::move(built.mesh);
  });
}

// The whole refinement with the tetrahedra kept: the paper's 3D column.
void refine_in_3d(RestrictedDelaunay& restricted, const Parameters& parameters, const Lengths& lengths,
                  Controls& controls, MeshingResult& result) {
  std::vector<double> pole_heights =
      timed(result.poles, [&] { return compute_poles(restricted, parameters.stage2.pole_height); });
  timed(result.recover,
        [&] { recover(restricted, full3d_options(parameters, lengths), controls, result.recover, &pole_heights); });
}

// Where the pieces of the mesh lie that stage 2 starts from: it takes none elsewhere, and the crossings that tell of it
// are too many to be kept until it has ended.
AssignmentFaults faults_of(const SurfaceMesh& mesh, const ScalarGrid& grid, const Isosurface& isosurface,
                           const IsosurfaceTopology& topology, const MeshingOptions& options, MeshingResult& result) {
  if (!options.parameters.certify || !result.build.bounds_a_solid) return {};
  return timed(result.certify_stage, [&] {
    return assignment_faults(mesh, grid, isosurface.isovalue(), isosurface.step(), topology, options.threads);
  });
}

// Stage 1 and repair alone look up crossings.
void drop_crossings(IsosurfaceTopology& topology) {
  UnwrittenArray<EdgeCrossing>().swap(topology.crossings);
  topology.index = {};
  release_free_memory();
}

bool needs_topology(const Parameters& parameters) {
  return parameters.certify || parameters.initial.seeding == Seeding::kComponents;
}

// DelIso(O, isovalue) of the paper: InitTriangulation, Recover, Refine.
void run_pipeline(const ScalarGrid& grid, double isovalue, const MeshingOptions& options, MeshingResult& result) {
  const Parameters& parameters = options.parameters;
  check_parameters(parameters);
  Controls controls(parameters.budget, options.stop, options.progress);

  // The exact topology first: it says what a regular isovalue is.
  controls.enter("index");
  RegularTopology regular = timed(result.topology, [&] {
    return needs_topology(parameters) ? regular_topology(grid, isovalue, options.threads)
                                      : RegularTopology{regular_isovalue(grid, isovalue), {}};
  });
  const IsosurfaceTopology& topology = regular.topology;
  result.isovalue_used = regular.isovalue;
  const auto isosurface = timed(result.index, [&] {
    return std::make_unique<Isosurface>(grid, result.isovalue_used, parameters.search,
                                        spacing_to_use(parameters, grid.spacing()), options.threads);
  });
  const Lengths lengths = lengths_of(parameters, isosurface->box());
  result.r_min_voxels = lengths.r_min_stage2;
  // What repair will want to know is found beside stage 1.
  auto facts =
      std::make_unique<ExactSurfaceCache>(grid, *isosurface, topology, repairs(parameters) ? options.threads : 1);

  controls.enter("initial");
  auto restricted = timed(result.initial, [&] {
    return initial_triangulation(grid, *isosurface, topology, parameters, options.seed, options.threads, controls,
                                 result.initial_search);
  });

  controls.enter("recover");
  const std::vector<Vec3> coverage_targets = timed(result.recover, [&] {
    return recover_all(*restricted, grid, needs_topology(parameters) ? &topology : nullptr, options, lengths, controls,
                       result.recover);
  });
  if (parameters.algorithm == Algorithm::kFull3d) refine_in_3d(*restricted, parameters, lengths, controls, result);
  take_counters(*restricted, result.recover);

  // The tetrahedra and the facts go as soon as the surface mesh stands; of the topology the components stay.
  controls.enter("repair");
  SurfaceMesh surface = surface_from(std::move(restricted), std::move(facts), options, controls, result);
  const AssignmentFaults faults = faults_of(surface, grid, *isosurface, topology, options, result);
  drop_crossings(regular.topology);
  if (options.keep_stage1_mesh) result.stage1_mesh = to_world(surface, grid, isosurface->step());
  controls.enter("refine");
  if (parameters.algorithm == Algorithm::kTwoStage && result.build.bounds_a_solid) {
    timed(result.refine, [&] {
      refine(surface, *isosurface, stage2_options(parameters, lengths, coverage_targets, options.threads), controls,
             result.refine);
    });
  }
  result.stopped_in = controls.stopped_in();
  controls.report("certify", surface.points.size(), 0);
  timed(result.certify_stage, [&] {
    result.mesh = to_world(std::move(surface), grid, isosurface->step());
    if (!parameters.certify) return;
    result.certificate = final_certificate(result.mesh, topology, faults, result.build.bounds_a_solid, options.threads);
    if (!repairs(parameters) || controls.stopped()) return;  // or else triangles do not cross in mesh space
    refute_crossing(result.mesh, grid, isosurface->step(), options.threads, result.certificate);
  });
}

}  // namespace

MeshingResult mesh_isosurface(const ScalarGrid& grid, double isovalue, const MeshingOptions& options) {
  const Stopwatch watch;
  check_samples(grid);
  check_isovalue(grid, isovalue);
  MeshingResult result;
  if (options.parameters.boundary == Boundary::kClosed) {
    const ScalarGrid closed = timed(result.index, [&] { return padded(grid, grid.range().first); });
    run_pipeline(closed, isovalue, options, result);
  } else {
    run_pipeline(grid, isovalue, options, result);
  }
  result.total_seconds = watch.seconds();
  return result;
}

}  // namespace deliso

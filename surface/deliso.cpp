#include "surface/deliso.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/memory.h"
#include "delaunay/base/rng.h"
#include "delaunay/base/shortest_text.h"
#include "delaunay/base/stopwatch.h"
#include "surface/boundary_curves.h"
#include "surface/build_triangle_mesh.h"
#include "surface/component_seeds.h"
#include "surface/coverage.h"
#include "surface/poles.h"
#include "surface/repair.h"
#include "surface/restricted_delaunay.h"
#include "surface/sides_of_facets.h"
#include "surface/surface_facts.h"
#include "surface/surface_mesh.h"
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

RefineOptions stage2_options(const Parameters& parameters, const Lengths& lengths, std::span<const Vec3> landmarks,
                             int threads) {
  RefineOptions options;
  options.landmarks = landmarks;
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

// InitTriangulation: seeds, random points and boundary curves.
std::vector<Vec3> initial_points(const ScalarGrid& grid, const Isosurface& isosurface, const MeshingOptions& options,
                                 const IsosurfaceTopology& topology, SearchCounters& counters) {
  const InitialParameters& initial = options.parameters.initial;
  Rng rng(options.seed);
  std::vector<Vec3> points = random_ray_points(isosurface, initial.random_points, rng, counters);
  const std::vector<Vec3> curves = boundary_curve_points(grid, isosurface);
  points.insert(points.end(), curves.begin(), curves.end());
  if (initial.seeding == Seeding::kComponents) {
    const std::vector<Vec3> seeds = component_seeds(grid, isosurface, topology, options.threads);
    points.insert(points.end(), seeds.begin(), seeds.end());
  }
  if (!points.empty()) return points;
  if (initial.seeding == Seeding::kComponents) throw InputError("the isosurface has no point to start from");
  throw InputError("no point of the isosurface to start from: initial.random_points is " +
                   std::to_string(initial.random_points) + ", with initial.seeding \"random\" it should be about 20");
}

// Recover; and, when the exact topology is known, with samples of fingers of the surface that hide within a Voronoi
// cell. Returns landmarks for stage 2, if it asks for them: the crossings that the first mesh of stage 1 is
// not close to.
std::vector<Vec3> recover_all(RestrictedDelaunay& restricted, const ScalarGrid& grid,
                              const IsosurfaceTopology* topology, const MeshingOptions& options, const Lengths& lengths,
                              Controls& controls, RecoverStats& stats) {
  const RecoverOptions stage1 = stage1_options(options.parameters, lengths, options.threads);
  recover(restricted, stage1, controls, stats);
  if (topology == nullptr || !options.parameters.stage1.coverage || controls.stopped()) return {};
  // Only where triangles that they make cross are looked for.
  const bool wants_landmarks = options.parameters.algorithm == Algorithm::kTwoStage && repairs(options.parameters);
  std::vector<Vec3> landmarks;
  std::vector<std::uint32_t> suspects = all_crossings(grid, *topology, options.threads);
  for (int i = 0; i < kCoverageRounds; ++i) {
    const std::vector<Vec3> points = uncovered_points(restricted, grid, *topology, suspects, options.threads,
                                                      i == 0 && wants_landmarks ? &landmarks : nullptr);
    if (recover_with(restricted, points, stage1, controls, stats) == 0 || controls.poll()) break;
  }
  landmarks.shrink_to_fit();
  return landmarks;
}

void take_counters(const RestrictedDelaunay& restricted, RecoverStats& stats) {
  stats.search += restricted.counters();
  stats.restricted_seconds = restricted.restricted_seconds();
  stats.hits_against_signs = restricted.hits_against_signs();
}

// Without one sign per tetrahedron: gives the tetrahedra the signs that the restricted facets ask for, if there are
// any.
bool take_sides_of_facets(RestrictedDelaunay& restricted) {
  const std::optional<TetSigns> above = sides_of_facets(restricted);
  if (above) restricted.set_signs(*above);
  return above.has_value();
}

// The surface mesh that stage 2 starts from, with pole heights.
SurfaceMesh surface_from(std::unique_ptr<RestrictedDelaunay> restricted, std::unique_ptr<SurfaceFacts> facts,
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
    separate_copies(built.mesh, built.groups, built.vertex_of, restricted->isosurface().box());
    for (const VertexId v : built.vertex_of) built.mesh.pole_heights.push_back(heights[v.index()]);
    return std::move(built.mesh);
  });
}

// Facets that bound nothing are no isosurface, whatever their counts.
void refute_facets(Certificate& certificate) {
  if (certificate.verdict == Verdict::kHomeomorphic) certificate.verdict = Verdict::kDifferent;
  certificate.differences.insert(
      certificate.differences.begin(),
      "The restricted facets bound no set of tetrahedra: they are given as they are, without stage 2.");
}

// The whole refinement with the tetrahedra kept: the paper's 3D column.
void refine_in_3d(RestrictedDelaunay& restricted, const Parameters& parameters, const Lengths& lengths,
                  Controls& controls, MeshingResult& result) {
  std::vector<double> pole_heights =
      timed(result.poles, [&] { return compute_poles(restricted, parameters.stage2.pole_height); });
  timed(result.recover,
        [&] { recover(restricted, full3d_options(parameters, lengths), controls, result.recover, &pole_heights); });
}

// Stage 1 and repair alone look up crossings.
void drop_crossings(IsosurfaceTopology& topology) {
  UnwrittenArray<EdgeCrossing>().swap(topology.crossings);
  topology.index = {};
  release_free_memory();
}

// DelIso(O, isovalue) of the paper: InitTriangulation, Recover, Refine.
void run_pipeline(const ScalarGrid& grid, double isovalue, const MeshingOptions& options, MeshingResult& result) {
  const Parameters& parameters = options.parameters;
  check_parameters(parameters);
  const Vec3 spacing = spacing_to_use(parameters, grid.spacing());
  Controls controls(parameters.budget, options.stop, options.progress);

  // The exact topology first: it says what a regular isovalue is.
  controls.report("index", 0, 0);
  const bool needs_topology = parameters.certify || parameters.initial.seeding == Seeding::kComponents;
  RegularTopology regular = timed(result.topology, [&] {
    return needs_topology ? regular_topology(grid, isovalue, options.threads)
                          : RegularTopology{regular_isovalue(grid, isovalue), {}};
  });
  const IsosurfaceTopology& topology = regular.topology;
  result.isovalue_used = regular.isovalue;
  const auto isosurface = timed(result.index, [&] {
    return std::make_unique<Isosurface>(grid, result.isovalue_used, parameters.search, spacing, options.threads);
  });
  const Lengths lengths = lengths_of(parameters, isosurface->box());
  result.r_min_voxels = lengths.r_min_stage2;

  // What repair will want to know is found beside stage 1.
  auto facts = std::make_unique<SurfaceFacts>(grid, *isosurface, topology, repairs(parameters) ? options.threads : 1);

  controls.report("initial", 0, 0);
  auto restricted = timed(result.initial, [&] {
    const std::vector<Vec3> points = initial_points(grid, *isosurface, options, topology, result.initial_search);
    const FacetRule rule = parameters.stage1.one_sign_per_tetrahedron ? FacetRule::kSigns : FacetRule::kHits;
    return std::make_unique<RestrictedDelaunay>(*isosurface, points, rule, options.threads);
  });

  const std::vector<Vec3> landmarks = timed(result.recover, [&] {
    return recover_all(*restricted, grid, needs_topology ? &topology : nullptr, options, lengths, controls,
                       result.recover);
  });
  if (parameters.algorithm == Algorithm::kFull3d) refine_in_3d(*restricted, parameters, lengths, controls, result);
  take_counters(*restricted, result.recover);

  // The tetrahedra and the facts go as soon as the surface mesh stands; of the topology the components stay.
  SurfaceMesh surface = surface_from(std::move(restricted), std::move(facts), options, controls, result);
  drop_crossings(regular.topology);
  if (options.keep_stage1_mesh) result.stage1_mesh = to_world(surface, grid, isosurface->step());
  if (parameters.algorithm == Algorithm::kTwoStage && result.build.bounds_a_solid) {
    timed(result.refine, [&] {
      refine(surface, *isosurface, stage2_options(parameters, lengths, landmarks, options.threads), controls,
             result.refine);
    });
  }
  result.stopped_early = controls.stopped();

  controls.report("certify", surface.points.size(), 0);
  timed(result.certify_stage, [&] {
    result.mesh = to_world(std::move(surface), grid, isosurface->step());
    if (parameters.certify) result.certificate = certify(result.mesh, topology, options.threads);
    if (!result.build.bounds_a_solid) refute_facets(result.certificate);
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

#include "surface/deliso.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/base/memory.h"
#include "delaunay/base/stopwatch.h"
#include "surface/base/sizes.h"
#include "surface/extract/recovered_surface.h"
#include "surface/pipeline.h"
#include "surface/recover/coverage.h"
#include "surface/recover/init_triangulation.h"
#include "surface/recover/recover.h"
#include "surface/refine/refine.h"
#include "surface/repair/repair.h"
#include "surface/restricted/poles.h"
#include "volume/filters/meshed_field.h"
#include "volume/region.h"
#include "volume/regular_isovalue.h"

namespace deliso {

namespace {

// Triangles that face the other side.
void reverse(TriangleMesh& mesh) {
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
}

// What r_min is a fraction of the smallest side of. A constant number of voxels, unlike the paper's box of the volume,
// does not change with empty slices around the surface; it is the side of the paper's ENGINE and ANEURISM.
Box3 r_min_box(const Isosurface& isosurface, RMinOf of) {
  constexpr double kVoxels = 256;
  return of == RMinOf::kBox ? isosurface.box() : Box3{{0, 0, 0}, {kVoxels, kVoxels, kVoxels}};
}

double share_near_samples(const IsosurfaceTopology& topology) {
  constexpr double kNear = 0.01;
  const auto near = std::count_if(topology.crossings.begin(), topology.crossings.end(),
                                  [](const EdgeCrossing& c) { return c.t < kNear || c.t > 1 - kNear; });
  return static_cast<double>(near) / std::max<double>(1, static_cast<double>(topology.crossings.size()));
}

bool needs_topology(const Parameters& parameters) {
  return parameters.certify || parameters.initial.seeding == Seeding::kComponents;
}

}  // namespace

Pipeline::Pipeline(const ScalarGrid& grid, const MeshingOptions& options, MeshingResult& result)
    : grid_(grid),
      options_(options),
      parameters_(options.parameters),
      controls_(parameters_.budget, options.stop, options.progress),
      result_(result),
      rounding_(std::min(kMostForRounding * promised_distance(parameters_), options.rounding)),
      promise_{.max_distance = kept_distance(), .within_cells = is_measured_within_cells(parameters_)} {
  promise_.max_residual -= std::min(options.rounding, kMostForRounding * promise_.max_residual);
  controls_.set_observer(options.observer);
  note_promised();
}

// DelIso(O, isovalue) of the paper, Figure 4.
void Pipeline::run(double isovalue) {
  check_parameters(parameters_);
  find_exact_surface(isovalue);

  SurfaceMesh mesh = refine(stage1({}));

  controls_.poll();  // checks may have ended early, with nothing found
  result_.stopped_in = controls_.stopped_in();
  controls_.report("certify", mesh.points.size(), 0);
  timed(result_.certify_stage, [&] { certify(std::move(mesh)); });
}

// The exact topology comes first: it says what a regular isovalue is.
void Pipeline::find_exact_surface(double isovalue) {
  controls_.enter("index");
  RegularTopology regular = timed(result_.topology, [&] {
    return needs_topology(parameters_) ? regular_topology(grid_, isovalue, options_.threads)
                                       : RegularTopology{regular_isovalue(grid_, isovalue), {}};
  });
  topology_ = std::move(regular.topology);
  result_.isovalue_used = regular.isovalue;
  result_.share_near_samples = share_near_samples(topology_);
  isosurface_ = timed(result_.index, [&] {
    return std::make_unique<Isosurface>(grid_, result_.isovalue_used, parameters_.search,
                                        spacing_to_use(parameters_, grid_.spacing()), options_.threads);
  });
  surface_.emplace(ExactSurface{*isosurface_, topology_, options_.threads, {}, &controls_});
  r_min_box_ = r_min_box(*isosurface_, parameters_.r_min_of);
}

SurfaceMesh Pipeline::stage1(std::span<const Vec3> samples) {
  // With threads to spare, what repair will ask is found beside stage 1.
  if (repairs(parameters_)) cache_ = std::make_unique<ExactSurfaceCache>(*surface_);
  controls_.enter("initial");
  DelS del_s0 = timed(result_.initial, [&] {
    return init_triangulation(*surface_, parameters_, options_.seed, controls_, result_.initial_search);
  });
  del_s0->set_observer(controls_.observer());
  if (controls_.observer() != nullptr) controls_.observer()->triangulated(*del_s0);
  controls_.enter("recover");
  return mended_mesh(recover_topology(std::move(del_s0), samples), samples);
}

// Recover(Del S0), Figure 5; then with samples of parts that the mesh misses, or to the thresholds of stage 2.
Pipeline::DelS Pipeline::recover_topology(DelS del_s, std::span<const Vec3> samples) {
  constexpr double kClosest = 0.25;  // that samples come to each other, of the distance promised
  const RecoverOptions options = recover_options(parameters_, r_min_box_, options_.threads);
  timed(result_.recover, [&] {
    recover(*del_s, options, controls_, result_.recover);
    if (!needs_topology(parameters_) || !parameters_.stage1.coverage) return;
    // Targets are asked for only where the triangles that they make cross are looked for.
    const bool wants_targets = parameters_.algorithm == Algorithm::kTwoStage && repairs(parameters_);
    coverage_targets_ = recover_missed_parts(*del_s, *surface_, options, wants_targets, controls_, result_.recover);
    if (samples.empty()) return;
    RecoverOptions dense = options;
    dense.size_bound = std::min(options.size_bound, kClosest * promise_.max_distance);
    recover_with(*del_s, samples, dense, controls_, result_.recover);
  });
  if (parameters_.algorithm == Algorithm::kFull3d) {
    std::vector<double> pole_heights =
        timed(result_.poles, [&] { return compute_poles(*del_s, parameters_.stage2.pole_height); });
    timed(result_.recover,
          [&] { recover(*del_s, full3d_options(parameters_, r_min_box_), controls_, result_.recover, &pole_heights); });
  }
  take_counters(*del_s, result_.recover);
  return del_s;
}

// The tetrahedra go before RefineGeom.
SurfaceMesh Pipeline::mended_mesh(DelS del_s1, std::span<const Vec3> samples) {
  controls_.enter("repair");
  auto recovered = timed(result_.repair, [&] { return mended(std::move(del_s1), samples); });
  timed(result_.poles, [&] { recovered->compute_poles(); });
  SurfaceMesh mesh = timed(result_.build, [&] { return recovered->build_triangle_mesh(); });
  timed(result_.repair, [&] { recovered->mend(mesh); });
  take_inner_seconds(*recovered);
  result_.build.bounds_a_solid = recovered->bounds_a_solid();
  recovered.reset();
  cache_.reset();
  if (options_.keep_stage1_mesh && !result_.stage1_mesh) result_.stage1_mesh = to_world(mesh, *isosurface_);
  return mesh;
}

// Refine(Del S1), Figure 9.
SurfaceMesh Pipeline::refine(SurfaceMesh mesh) {
  controls_.enter("refine");
  RefineOptions options = refine_options(parameters_, r_min_box_, coverage_targets_, options_.threads);
  options.observer = options_.observer;
  result_.r_min_voxels = options.r_min;
  if (parameters_.algorithm == Algorithm::kTwoStage && result_.build.bounds_a_solid) {
    timed(result_.refine, [&] { refine_geometry(mesh, *isosurface_, options, controls_, result_.refine); });
  }
  options.smoothing_passes = 0;  // what comes after is for distances and sizes
  if (result_.build.bounds_a_solid) finish(mesh, options);
  return mesh;
}

// Poles and meshes that repair has found for further rounds count as what they are.
void Pipeline::take_inner_seconds(const RecoveredSurface& recovered) {
  result_.poles.seconds += recovered.inner_poles_seconds();
  result_.build.seconds += recovered.inner_build_seconds();
  result_.repair.seconds -= recovered.inner_poles_seconds() + recovered.inner_build_seconds();
}

// With new samples and signs where the mesh to be would differ from the exact topology.
std::unique_ptr<RecoveredSurface> Pipeline::mended(DelS del_s1, std::span<const Vec3> samples) {
  if (!repairs(parameters_)) return std::make_unique<UnrepairedSurface>(std::move(del_s1), parameters_);
  // Dual edges and hits are of no use any more.
  auto signs_alone = std::make_unique<SignedDelaunay>(std::move(*del_s1));
  del_s1.reset();
  release_free_memory();
  // Where an error is stated, the samples of a lattice come in useful; marching cubes would have to be brought nearer.
  RoundsOptions options{.fixed = samples, .may_give_up = !is_sized(parameters_), .max_distance = promise_.max_distance};
  if (is_sized(parameters_) || !samples.empty()) {
    options.nearness = {.max_distance = promise_.max_distance, .samples = samples, .parts = cube_parts_};
  }
  auto repair = std::make_unique<Repair>(*cache_, std::move(signs_alone), parameters_.repair.max_rounds, options,
                                         controls_, result_.repair);
  repair->mend_topology();
  return repair;
}

MeshingResult mesh_isosurface(const ScalarGrid& grid, double isovalue, const MeshingOptions& options) {
  const Stopwatch watch;
  const Parameters& parameters = options.parameters;
  MeshingResult result;
  const SampleRegion region = region_of(parameters.region);
  std::optional<ScalarGrid> part;
  if (!region.is_all()) part.emplace(timed(result.index, [&] { return cropped(grid, region); }));
  const ScalarGrid& volume = part ? *part : grid;
  const MeshedField field = timed(result.index, [&] {
    return meshed_field(volume, isovalue, parameters.field, parameters.boundary == Boundary::kClosed,
                        spacing_to_use(parameters, volume.spacing()), options.threads);
  });
  Pipeline(field.grid, options, result).run(field.isovalue);
  if (parameters.field.invert) {
    reverse(result.mesh);
    if (result.stage1_mesh) reverse(*result.stage1_mesh);
  }
  result.total_seconds = watch.seconds();
  return result;
}

}  // namespace deliso

#include "surface/deliso.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/memory.h"
#include "delaunay/base/stopwatch.h"
#include "surface/base/exact_surface.h"
#include "surface/certificate/final_certificate.h"
#include "surface/certificate/geometry_check.h"
#include "surface/extract/recovered_surface.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/recover/coverage.h"
#include "surface/recover/init_triangulation.h"
#include "surface/recover/recover.h"
#include "surface/refine/refine.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "surface/repair/finish/last_resort.h"
#include "surface/repair/repair.h"
#include "surface/restricted/poles.h"
#include "surface/restricted/restricted_delaunay.h"
#include "surface/shape/shape.h"
#include "volume/filters/meshed_field.h"

namespace deliso {

namespace {

// Triangles that face the other side.
void reverse(TriangleMesh& mesh) {
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
}

bool needs_topology(const Parameters& parameters) {
  return parameters.certify || parameters.initial.seeding == Seeding::kComponents;
}

// One run. What the paper does not have stands between its lines: the exact topology, which a certificate needs, first;
// coverage after Recover; repair around ComputePoles and BuildTriMesh; the certificate at the end.
class Pipeline {
 public:
  Pipeline(const ScalarGrid& grid, const MeshingOptions& options, MeshingResult& result)
      : grid_(grid),
        options_(options),
        parameters_(options.parameters),
        controls_(parameters_.budget, options.stop, options.progress),
        result_(result),
        promise_{.max_distance = parameters_.promise.max_distance} {}

  void run(double isovalue);

 private:
  using DelS = std::unique_ptr<RestrictedDelaunay>;  // Del S restricted to the isosurface

  void find_exact_surface(double isovalue);
  DelS recover_topology(DelS del_s0);
  SurfaceMesh refine(DelS del_s1);
  std::unique_ptr<RecoveredSurface> mended(DelS del_s1);
  void take_inner_seconds(const RecoveredSurface& recovered);
  void find_faults(const SurfaceMesh& mesh);
  void improve(SurfaceMesh& mesh, int most_rounds);
  void refine_by_distance(SurfaceMesh& mesh, RefineOptions options);
  void drop_crossings();
  void find_last_faults(SurfaceMesh& mesh);
  void certify(SurfaceMesh mesh);

  const ScalarGrid& grid_;
  const MeshingOptions& options_;
  const Parameters& parameters_;
  Controls controls_;
  MeshingResult& result_;

  IsosurfaceTopology topology_;  // empty where nothing needs it
  std::unique_ptr<Isosurface> isosurface_;
  std::optional<ExactSurface> surface_;       // the two
  std::unique_ptr<ExactSurfaceCache> cache_;  // what repair compares with; none where nothing is repaired
  std::vector<Vec3> coverage_targets_;        // for RefineGeom
  AssignmentFaults faults_;                   // of the mesh that RefineGeom starts from
  Promise promise_;
  MeshFaults last_;  // of the mesh that RefineGeom has made
};

// DelIso(O, isovalue) of the paper, Figure 4.
void Pipeline::run(double isovalue) {
  check_parameters(parameters_);
  find_exact_surface(isovalue);

  controls_.enter("initial");
  DelS del_s0 = timed(result_.initial, [&] {
    return init_triangulation(*surface_, parameters_, options_.seed, controls_, result_.initial_search);
  });
  del_s0->set_observer(options_.observer);
  if (options_.observer != nullptr) options_.observer->triangulated(*del_s0);
  controls_.enter("recover");
  DelS del_s1 = recover_topology(std::move(del_s0));
  SurfaceMesh mesh = refine(std::move(del_s1));

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
  isosurface_ = timed(result_.index, [&] {
    return std::make_unique<Isosurface>(grid_, result_.isovalue_used, parameters_.search,
                                        spacing_to_use(parameters_, grid_.spacing()), options_.threads);
  });
  surface_.emplace(ExactSurface{*isosurface_, topology_, options_.threads});
  // With threads to spare, what repair will ask is found beside stage 1.
  if (repairs(parameters_)) cache_ = std::make_unique<ExactSurfaceCache>(*surface_);
}

// Recover(Del S0), Figure 5; then with samples of parts that the mesh misses, or to the thresholds of stage 2.
Pipeline::DelS Pipeline::recover_topology(DelS del_s) {
  const RecoverOptions options = recover_options(parameters_, isosurface_->box(), options_.threads);
  timed(result_.recover, [&] {
    recover(*del_s, options, controls_, result_.recover);
    if (!needs_topology(parameters_) || !parameters_.stage1.coverage) return;
    // Targets are asked for only where the triangles that they make cross are looked for.
    const bool wants_targets = parameters_.algorithm == Algorithm::kTwoStage && repairs(parameters_);
    coverage_targets_ = recover_missed_parts(*del_s, *surface_, options, wants_targets, controls_, result_.recover);
  });
  if (parameters_.algorithm == Algorithm::kFull3d) {
    std::vector<double> pole_heights =
        timed(result_.poles, [&] { return compute_poles(*del_s, parameters_.stage2.pole_height); });
    timed(result_.recover, [&] {
      recover(*del_s, full3d_options(parameters_, isosurface_->box()), controls_, result_.recover, &pole_heights);
    });
  }
  take_counters(*del_s, result_.recover);
  return del_s;
}

// Refine(Del S1), Figure 9. The tetrahedra, and the crossings of the exact topology, go before RefineGeom.
SurfaceMesh Pipeline::refine(DelS del_s1) {
  controls_.enter("repair");
  auto recovered = timed(result_.repair, [&] { return mended(std::move(del_s1)); });
  timed(result_.poles, [&] { recovered->compute_poles(); });
  SurfaceMesh mesh = timed(result_.build, [&] { return recovered->build_triangle_mesh(); });
  timed(result_.repair, [&] { recovered->mend(mesh); });
  take_inner_seconds(*recovered);
  result_.build.bounds_a_solid = recovered->bounds_a_solid();
  recovered.reset();
  cache_.reset();
  find_faults(mesh);
  if (options_.keep_stage1_mesh) result_.stage1_mesh = to_world(mesh, *isosurface_);

  controls_.enter("refine");
  RefineOptions options = refine_options(parameters_, isosurface_->box(), coverage_targets_, options_.threads);
  options.observer = options_.observer;
  result_.r_min_voxels = options.r_min;
  if (parameters_.algorithm == Algorithm::kTwoStage && result_.build.bounds_a_solid) {
    timed(result_.refine, [&] { refine_geometry(mesh, *isosurface_, options, controls_, result_.refine); });
  }
  if (result_.build.bounds_a_solid) improve(mesh, parameters_.shape.rounds);
  if (parameters_.certify && result_.build.bounds_a_solid) refine_by_distance(mesh, options);
  drop_crossings();
  if (parameters_.certify && result_.build.bounds_a_solid && !controls_.stopped()) find_last_faults(mesh);
  return mesh;
}

// What the criteria leave badly shaped, where insertions are refused and at or below r_min; not in the paper.
void Pipeline::improve(SurfaceMesh& mesh, int most_rounds) {
  if (!improves_shape(parameters_) || controls_.stopped()) return;
  controls_.enter("shape");
  timed(result_.shape, [&] {
    ShapeOptions options = shape_options(parameters_);
    options.rounds = std::min(options.rounds, most_rounds);
    improve_shape(mesh, *surface_, options, controls_, result_.shape);
    if (options_.observer != nullptr) options_.observer->reshaped(mesh);
  });
}

// Where the paper's criteria leave the mesh farther from the isosurface than promised, refinement goes on by distance;
// not without repair, as in the paper. What is promised is known afterwards.
void Pipeline::refine_by_distance(SurfaceMesh& mesh, RefineOptions options) {
  constexpr int kMostRounds = 6, kCautiousRounds = 2;  // of shape: what it has cut off would be cut off again
  constexpr double kFraction = 0.75;  // of the distance promised: h is measured at one point of each triangle
  options.epsilon2 = std::numeric_limits<double>::infinity();
  options.max_distance = std::min(options.max_distance, kFraction * promise_.max_distance);
  std::int64_t off_before = 0;
  for (int round = 0;; ++round) {
    last_.geometry = timed(result_.certify_stage, [&] { return check_geometry(mesh, *surface_, promise_); });
    const bool may_refine = repairs(parameters_) && parameters_.algorithm == Algorithm::kTwoStage;
    const std::int64_t off = last_.geometry.mesh_off + std::ssize(last_.geometry.missed_crossings);
    const bool helps = round == 0 || off <= off_before / 2;  // else finer cubes are to replace what is off
    if (off == 0 || !may_refine || !helps || round == kMostRounds || controls_.poll()) return;
    off_before = off;
    const std::int64_t before = result_.refine.insertions;
    timed(result_.refine, [&] {
      set_side_adjacency(mesh);
      mesh.pole_heights.assign(mesh.points.size(), isosurface_->box().diagonal());
      options.coverage_targets = last_.geometry.missed_crossings;
      refine_geometry(mesh, *isosurface_, options, controls_, result_.refine);
    });
    if (round == 0) improve(mesh, kCautiousRounds);
    if (result_.refine.insertions == before) return;
  }
}

// What is wrong with the mesh in the end. Repair and RefineGeom have seen to crossing triangles in mesh space.
// Components with faults come from finer cubes; for these the crossings are found once more.
void Pipeline::find_last_faults(SurfaceMesh& mesh) {
  timed(result_.certify_stage, [&] {
    if (!repairs(parameters_) || result_.refine.meeting_pairs > 0 || !is_exact_in_world(*isosurface_)) {
      last_.crossing = crossing_in_world(mesh, *isosurface_, options_.threads);
    }
  });
  if (!repairs(parameters_) || last_.count() == 0) return;
  timed(result_.repair, [&] {
    topology_ = exact_topology(grid_, result_.isovalue_used, options_.threads);
    result_.repair.components_polygonized += replace_faulty_components(mesh, *surface_, promise_, last_, controls_);
  });
  drop_crossings();
}

// Poles and meshes that repair has found for further rounds count as what they are.
void Pipeline::take_inner_seconds(const RecoveredSurface& recovered) {
  result_.poles.seconds += recovered.inner_poles_seconds();
  result_.build.seconds += recovered.inner_build_seconds();
  result_.repair.seconds -= recovered.inner_poles_seconds() + recovered.inner_build_seconds();
}

// With new samples and signs where the mesh to be would differ from the exact topology.
std::unique_ptr<RecoveredSurface> Pipeline::mended(DelS del_s1) {
  if (!repairs(parameters_)) return std::make_unique<UnrepairedSurface>(std::move(del_s1), parameters_);
  // Dual edges and hits are of no use any more.
  auto signs_alone = std::make_unique<SignedDelaunay>(std::move(*del_s1));
  del_s1.reset();
  release_free_memory();
  auto repair = std::make_unique<Repair>(*cache_, std::move(signs_alone), parameters_.repair.max_rounds, controls_,
                                         result_.repair);
  repair->mend_topology();
  return repair;
}

// Where the pieces lie that RefineGeom starts from. It takes none elsewhere, and the crossings that tell of it are too
// many to be kept until it has ended.
void Pipeline::find_faults(const SurfaceMesh& mesh) {
  if (!parameters_.certify || !result_.build.bounds_a_solid) return;
  faults_ = timed(result_.certify_stage, [&] { return assignment_faults(mesh, *surface_); });
}

void Pipeline::drop_crossings() {
  UnwrittenArray<EdgeCrossing>().swap(topology_.crossings);
  topology_.index = {};
  release_free_memory();
}

void Pipeline::certify(SurfaceMesh mesh) {
  result_.mesh = to_world(std::move(mesh), *isosurface_);
  SurfaceMesh centroids;
  for (const BadTriangle& bad : result_.shape.worst) centroids.points.push_back(bad.centroid);
  const std::vector<Vec3> in_world = to_world(std::move(centroids), *isosurface_).points;
  for (std::size_t i = 0; i < in_world.size(); ++i) result_.shape.worst[i].centroid = in_world[i];
  if (!parameters_.certify) return;
  result_.certificate =
      final_certificate(result_.mesh, topology_, faults_, result_.build.bounds_a_solid, options_.threads);
  if (controls_.stopped() || !result_.build.bounds_a_solid) return;
  PromiseFigures figures;
  figures.triangles = static_cast<std::int64_t>(result_.mesh.triangles.size());
  figures.is_manifold = result_.certificate.manifold;
  figures.misoriented_edges = result_.certificate.oriented ? 0 : 1;
  figures.reversed_components = last_.geometry.reversed_components;
  figures.off_box_edges = static_cast<std::int64_t>(last_.geometry.off_box_edges.size());
  figures.topology = result_.certificate.verdict;
  figures.crossing_pairs = last_.crossing.crossing_pairs;
  figures.vertices_off = last_.geometry.vertices_off;
  figures.mesh_off = last_.geometry.mesh_off;
  figures.isosurface_off = static_cast<std::int64_t>(last_.geometry.missed_crossings.size());
  result_.certificate.broken = broken_promises(figures, promise_);
}

}  // namespace

MeshingResult mesh_isosurface(const ScalarGrid& grid, double isovalue, const MeshingOptions& options) {
  const Stopwatch watch;
  const Parameters& parameters = options.parameters;
  MeshingResult result;
  const MeshedField field = timed(result.index, [&] {
    return meshed_field(grid, isovalue, parameters.field, parameters.boundary == Boundary::kClosed,
                        spacing_to_use(parameters, grid.spacing()), options.threads);
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

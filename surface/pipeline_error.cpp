// A run in which an error is stated: until the mesh is as near to the isosurface as that, both ways.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "surface/base/sizes.h"
#include "surface/certificate/geometry_check.h"
#include "surface/mesh/known_triangles.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/pipeline.h"
#include "surface/refine/refine.h"
#include "surface/shape/shape.h"
#include "surface/shape/shape_options.h"
#include "surface/sizes/error_steps.h"
#include "surface/sizes/error_targets.h"
#include "surface/sizes/samples_near_faults.h"

namespace deliso {

namespace {

// Those of some far triangles that steps have not been tried for yet, which they then have; all of them where there are
// none: most stay as they are, whatever changes near them.
std::vector<std::uint32_t> not_tried(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& triangles,
                                     KnownTriangles& tried) {
  std::vector<std::uint32_t> others;
  for (const std::uint32_t t : triangles) {
    if (tried.add(mesh, t)) others.push_back(t);
  }
  return others.empty() ? triangles : others;
}

std::int64_t places_off(const GeometryCheck& check) { return check.mesh_off + std::ssize(check.missed_points); }

bool is_same(const SurfaceMesh& a, const SurfaceMesh& b) {
  return a.points == b.points && a.triangles == b.triangles && a.pole_heights == b.pole_heights;
}

}  // namespace

// The height of stage 2 is measured at one point of each triangle. Where the mesh is too far at others, its triangles
// get smaller, and what it misses is inserted; where that is refused, other steps are tried. Whether that was enough.
bool Pipeline::refine_to_error(SurfaceMesh& mesh, RefineOptions options) {
  constexpr int kMostRounds = 12;
  constexpr double kReach = 0.9;       // of the distance promised: what is farther off is inserted
  constexpr double kLeastShare = 0.1;  // of it: smaller triangles are near it anyway
  constexpr double kProgress = 0.7;
  Promise nearer = promise_;
  nearer.max_distance *= kReach;
  options.target_reach = nearer.max_distance;
  options.r_min = std::min(options.r_min, kLeastShare * promise_.max_distance);
  options.criterion2 = Criterion2::kCircumradius;
  options.epsilon2 = 1;
  RepeatedCheck check(*surface_, nearer);
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kMostRounds && !controls_.poll(); ++round) {
    last_.geometry = timed(result_.certify_stage, [&] { return check(mesh); });
    const auto off = static_cast<double>(last_.geometry.mesh_off + std::ssize(last_.geometry.missed_points));
    if (off == 0) return true;
    if (off > kProgress * before) break;
    before = off;
    timed(result_.refine, [&] {
      const std::vector<Vec3> targets = error_targets(mesh, *surface_, last_.geometry, nearer.max_distance);
      set_side_adjacency(mesh);
      ask_for_smaller_triangles(mesh, *surface_, last_.geometry);
      options.coverage_targets = targets;
      refine_geometry(mesh, *isosurface_, options, controls_, result_.refine);
    });
  }
  if (controls_.poll()) return false;
  constexpr double kFreedom = 16;
  take_steps_nearer(mesh, check, kFreedom);
  last_.geometry = timed(result_.certify_stage, [&] {
    check(mesh);
    return check.again_within(promise_, mesh);
  });
  return last_.geometry.is_near();
}

// What refinement does not reach: steps of the shape stage, as long as anything is farther off than it checks for.
// Spikes are removed once other steps do not help: they may be all that covers a tip.
void Pipeline::take_steps_nearer(SurfaceMesh& mesh, RepeatedCheck& check, double freedom) {
  constexpr int kStepRounds = 24;
  constexpr int kMostIdle = 2;  // where spikes were, more may be off at first
  // What is left is mended by finer cubes; where an error is stated, by all stages again, which any round is better
  // than.
  const double progress = is_sized(parameters_) ? 1 : 0.9;
  // A step may leave a triangle as far as where no error is stated: what counts is how much is far after some of them.
  ShapeOptions options_of_steps = shape_options(parameters_);
  options_of_steps.max_height = std::max(options_of_steps.max_height, ShapeOptions{}.max_height);
  std::int64_t least_off = std::numeric_limits<std::int64_t>::max();
  bool removes_spikes = false;
  int idle = 0;  // rounds since that was less enough
  KnownTriangles tried;
  for (int round = 0; round < kStepRounds && !controls_.poll(); ++round) {
    const GeometryCheck before = timed(result_.certify_stage, [&] { return check.distances(mesh); });
    const std::int64_t off = before.mesh_off + std::ssize(before.missed_points);
    const bool is_less = off < least_off && static_cast<double>(off) <= progress * static_cast<double>(least_off);
    idle = is_less ? 0 : idle + 1;
    if (off == 0) return;
    if (idle > kMostIdle) break;
    if (!removes_spikes && idle > 0) {
      removes_spikes = true;
      tried = {};
    }
    if (idle == 0) least_off = off;
    timed(result_.shape, [&] {
      // What other steps do not bring near may take a point off it.
      const std::vector<Vec3> targets =
          idle > 0 ? error_targets(mesh, *surface_, before, check.promise().max_distance) : before.missed_points;
      insert_missed(mesh, *surface_, targets, freedom, options_of_steps, controls_, result_.shape);
    });
    const GeometryCheck now = timed(result_.certify_stage, [&] { return check.distances(mesh); });
    timed(result_.shape, [&] {
      bring_near(mesh, *surface_, not_tried(mesh, now.far_triangles, tried),
                 {check.promise().max_distance, removes_spikes}, options_of_steps, controls_, result_.shape);
    });
  }
  replace_far_triangles(mesh, check);
}

// What these steps do not bring near: triangles that are too far count as the worst for the shape stage, which splits
// what is around them, too. A sliver along a thin edge of a mask, as far off as it is long, is such a one; refinement
// and stage 1 again take all of the mesh for it.
void Pipeline::replace_far_triangles(SurfaceMesh& mesh, RepeatedCheck& check) {
  constexpr int kMostRounds = 4;
  constexpr std::size_t kFew = 1000;
  if (controls_.stopped()) return;
  const auto distances = [&](const SurfaceMesh& of) {
    return timed(result_.certify_stage, [&] { return check.distances(of); });
  };
  ShapeOptions options = shape_options(parameters_);
  options.max_sample = check.promise().max_distance;
  GeometryCheck far = distances(mesh);
  for (int round = 0; round < kMostRounds && !controls_.poll(); ++round) {
    if (far.far_triangles.empty() || far.far_triangles.size() > kFew) return;
    SurfaceMesh next = mesh;
    const ShapeStats shape_before = result_.shape;
    timed(result_.shape,
          [&] { replace_wrong_triangles(next, far.far_triangles, *surface_, options, controls_, result_.shape); });
    GeometryCheck now = distances(next);
    if (places_off(now) >= places_off(far)) {
      take_back_shape(shape_before);
      return;
    }
    mesh = std::move(next);
    far = std::move(now);
  }
}

// A few triangles may be too far where nothing can be inserted, as along the faces of the box. Finer cubes would take
// the place of all of their component; steps of the shape stage take that of these triangles alone.
void Pipeline::bring_near_by_steps(SurfaceMesh& mesh, RepeatedCheck& check) {
  if (last_.geometry.is_near() || !repairs(parameters_) || !improves_shape(parameters_) || controls_.stopped()) return;
  take_steps_nearer(mesh, check, kFreeSteps);
  last_.geometry = timed(result_.certify_stage, [&] { return check(mesh); });
  improve_while_near(mesh, check);
}

// Better angles for what has been brought near, if all stays near. Precondition: the mesh is the one checked last.
void Pipeline::improve_while_near(SurfaceMesh& mesh, RepeatedCheck& check) {
  if (!last_.geometry.is_near() || !improves_shape(parameters_) || controls_.stopped()) return;
  SurfaceMesh before = mesh;
  const ShapeStats shape_before = result_.shape;
  improve(mesh, parameters_.shape.rounds);
  last_.geometry = timed(result_.certify_stage, [&] { return check(mesh); });
  if (last_.geometry.is_near()) return;
  mesh = std::move(before);
  take_back_shape(shape_before);
  last_.geometry = timed(result_.certify_stage, [&] { return check(mesh); });
}

// Triangles may lie across a fold or between sheets that nearly meet, where no insertion of stage 2 and no step brings
// them near. Components that have such triangles come from marching cubes, with some cells divided: that is near at
// once.
void Pipeline::take_nearer_cubes(SurfaceMesh& mesh) {
  if (!repairs(parameters_) || parameters_.algorithm != Algorithm::kTwoStage) return;
  Observer* const observer = controls_.observer();
  controls_.set_observer(nullptr);  // what it would learn may be taken back
  CellsNearFaults cells(*isosurface_);
  std::int64_t& polygonized = result_.repair.components_polygonized;
  for (const std::int32_t parts : {2, 4}) {
    if (last_.geometry.is_near() || controls_.stopped()) break;
    const MeshFaults last_before = last_;
    SurfaceMesh next = mesh;
    const std::vector<Vec3> samples = cells.samples(1);
    std::vector<bool> is_marked;
    const std::int64_t replaced = timed(result_.repair, [&] {
      return replace_by_nearer_cubes(next, *surface_, last_,
                                     {.max_distance = promise_.max_distance, .samples = samples, .parts = parts},
                                     is_marked);
    });
    if (replaced == 0) break;
    bring_again_near(next);
    cells.add(next, last_.geometry);
    const bool is_nearer = !controls_.stopped() && places_off(last_.geometry) < places_off(last_before.geometry);
    if (is_nearer) {
      mesh = std::move(next);
      polygonized = std::max(polygonized, replaced);
    } else {
      last_ = last_before;
    }
  }
  controls_.set_observer(observer);
}

// Stage 2 and what follows it, for a mesh that stage 1 or marching cubes have made anew.
void Pipeline::bring_again_near(SurfaceMesh& mesh) {
  controls_.enter("refine");
  RefineOptions options = refine_options(parameters_, r_min_box_, coverage_targets_, options_.threads);
  timed(result_.refine, [&] { refine_geometry(mesh, *isosurface_, options, controls_, result_.refine); });
  options.smoothing_passes = 0;
  if (parameters_.size.max_edge) limit_edges(mesh, options);
  improve(mesh, parameters_.shape.rounds);
  refine_to_error(mesh, options);
}

// Triangles may lie across a fold or between sheets that nearly meet, and tips may be out of reach: what stage 1 makes
// of few samples is right, but no insertion of stage 2 and no step brings it near. Stage 1 runs again with more and
// more samples there; decimation takes out what is not needed. With other samples other places may be too far: those of
// all times get samples, and their spacing is halved each second time, and where no place is new.
void Pipeline::begin_again(SurfaceMesh& mesh) {
  constexpr int kMostTimes = 6;
  constexpr int kMostIdle = 2;                     // marching cubes make the same places of any samples
  constexpr double kSpacing = 2, kLargest = 0.25;  // of samples at first, in distances promised, and in voxels
  constexpr std::size_t kMostSamples = 1'000'000;
  if (!repairs(parameters_) || parameters_.algorithm != Algorithm::kTwoStage) return;
  Observer* const observer = controls_.observer();
  controls_.set_observer(nullptr);  // it learns of the mesh alone
  double spacing = std::min(kSpacing * promise_.max_distance, kLargest);
  CellsNearFaults cells(*isosurface_);
  cells.add(mesh, last_.geometry);
  std::size_t cells_before = 0;
  int idle = 0;  // times in a row that brought neither a nearer mesh nor another place
  SurfaceMesh recovered;
  for (int time = 0; time < kMostTimes && !last_.geometry.is_near() && !controls_.stopped(); ++time) {
    if (time > 0 && (time % 2 == 0 || cells.count() == cells_before)) spacing /= 2;
    cells_before = cells.count();
    const std::vector<Vec3> samples = cells.samples(spacing);
    if (samples.size() > kMostSamples) break;
    ++cube_parts_;
    const bool is_nearer = take_nearer_mesh(samples, mesh, recovered, cells);
    idle = is_nearer || cells.count() > cells_before ? 0 : idle + 1;
    if (idle == kMostIdle) break;
  }
  controls_.set_observer(observer);
  if (observer != nullptr) observer->reshaped(mesh);
}

// Takes the mesh that these samples give to stage 1, if it is nearer to the isosurface: whether it is. Adds the cells
// where it is not near. `recovered`: what stage 1 has made the time before: the same again would become the same.
bool Pipeline::take_nearer_mesh(std::span<const Vec3> samples, SurfaceMesh& mesh, SurfaceMesh& recovered,
                                CellsNearFaults& cells) {
  const MeshFaults last_before = last_;
  RepairStats repair_before = std::exchange(result_.repair, {});  // its counters decide on rounds
  const std::vector<Vec3> targets_before = coverage_targets_;
  SurfaceMesh again = stage1(samples);
  if (is_same(again, recovered) && coverage_targets_ == targets_before) {
    last_ = last_before;
    std::swap(result_.repair, repair_before);
    result_.repair.seconds += repair_before.seconds;
    return false;
  }
  recovered = again;
  bring_again_near(again);
  if (!is_sized(parameters_)) {
    RepeatedCheck check(*surface_, promise_);
    last_.geometry = timed(result_.certify_stage, [&] { return check(again); });
    improve_while_near(again, check);
  }
  cells.add(again, last_.geometry);
  const bool is_nearer = !controls_.stopped() && places_off(last_.geometry) < places_off(last_before.geometry);
  if (is_nearer) {
    mesh = std::move(again);
  } else {
    last_ = last_before;
    std::swap(result_.repair, repair_before);
  }
  result_.repair.seconds += repair_before.seconds;
  return is_nearer;
}

}  // namespace deliso

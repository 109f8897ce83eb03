// A run whose sizes are an error or a number of vertices (surface/sizes/README.md).
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
#include "surface/mesh/side_adjacency.h"
#include "surface/pipeline.h"
#include "surface/refine/refine.h"
#include "surface/repair/finish/last_resort.h"
#include "surface/shape/shape.h"
#include "surface/shape/shape_options.h"
#include "surface/sizes/decimation.h"
#include "surface/sizes/error_steps.h"
#include "surface/sizes/error_targets.h"
#include "surface/sizes/long_edges.h"
#include "surface/sizes/samples_near_faults.h"

namespace deliso {

namespace {

double area_of(const SurfaceMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += norm(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a])) / 2;
  }
  return area;
}

}  // namespace

// No edge is longer than the diameter of a circumcircle. So circumradii get down to half the length allowed; then those
// edges that are longer all the same are halved.
void Pipeline::limit_edges(SurfaceMesh& mesh, RefineOptions options) {
  constexpr double kSmall = 0.25;  // of the length: the circumradius below which no triangle is refined for its shape
  const double length = *parameters_.size.max_edge;
  options.criterion2 = Criterion2::kCircumradius;
  options.epsilon1 = std::numeric_limits<double>::infinity();
  options.epsilon2 = length / 2;  // of a pole height of 1
  options.h_min = 0;
  options.r_min = std::min(options.r_min, kSmall * length);
  timed(result_.refine, [&] {
    set_side_adjacency(mesh);
    mesh.pole_heights.assign(mesh.points.size(), 1);
    refine_geometry(mesh, *isosurface_, options, controls_, result_.refine);
  });
  if (!improves_shape(parameters_) || controls_.stopped()) return;
  timed(result_.shape,
        [&] { split_long_edges(mesh, *surface_, shape_options(parameters_), controls_, result_.shape); });
}

void Pipeline::fit_sizes(SurfaceMesh& mesh, const RefineOptions& options) {
  const auto& count = parameters_.size.target_vertices;
  if (count && mesh.points.size() < static_cast<std::size_t>(*count)) {
    refine_to_count(mesh, options, static_cast<std::size_t>(*count));
    last_.geometry = timed(result_.certify_stage, [&] { return check_geometry(mesh, *surface_, promise_); });
  }
  if (!last_.geometry.is_near()) find_last_faults(mesh);
  // Between the points that decimation keeps near the mesh, the isosurface may have come to be farther off: then
  // decimation begins again with points there.
  constexpr int kMostTimes = 4;
  const bool is_near = last_.geometry.is_near();
  const SurfaceMesh before = mesh;
  std::vector<Vec3> missed;
  for (int time = 0; time < kMostTimes && !controls_.poll(); ++time) {
    if (time > 0) mesh = before;
    decimate_mesh(mesh, missed);
    improve_decimated(mesh);
    bring_decimated_near(mesh);
    if (!is_near || last_.geometry.missed_points.empty()) break;
    missed.insert(missed.end(), last_.geometry.missed_points.begin(), last_.geometry.missed_points.end());
  }
  timed(result_.certify_stage, [&] {
    if (last_.crossing.crossing_pairs > 0) last_.crossing = crossing_in_world(mesh, *isosurface_, options_.threads);
  });
}

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
  constexpr int kStepRounds = 8;
  // A step may leave a triangle as far as where no error is stated: what counts is how much is far after some of them.
  ShapeOptions options_of_steps = shape_options(parameters_);
  options_of_steps.max_height = std::max(options_of_steps.max_height, ShapeOptions{}.max_height);
  std::int64_t off_before = std::numeric_limits<std::int64_t>::max();
  bool removes_spikes = false;
  for (int round = 0; round < kStepRounds && !controls_.poll(); ++round) {
    const GeometryCheck before = timed(result_.certify_stage, [&] { return check(mesh); });
    const std::int64_t off = before.mesh_off + std::ssize(before.missed_points);
    if (off == 0 || (off >= off_before && removes_spikes)) return;
    removes_spikes = removes_spikes || off >= off_before;
    off_before = off;
    timed(result_.shape, [&] {
      insert_missed(mesh, *surface_, before.missed_points, freedom, options_of_steps, controls_, result_.shape);
    });
    const GeometryCheck now = timed(result_.certify_stage, [&] { return check(mesh); });
    timed(result_.shape, [&] {
      bring_near(mesh, *surface_, now.far_triangles, {check.promise().max_distance, removes_spikes}, options_of_steps,
                 controls_, result_.shape);
    });
  }
}

// Triangles may lie across a fold or between sheets that nearly meet, and tips may be out of reach: what stage 1 makes
// of few samples is right, but no insertion of stage 2 and no step brings it near. Stage 1 runs again with more and
// more samples there; decimation takes out what is not needed. With other samples other places may be too far: those of
// all times get samples, and their spacing is halved each second time only.
void Pipeline::begin_again(SurfaceMesh& mesh) {
  constexpr int kMostTimes = 6;
  constexpr double kSpacing = 2, kLargest = 0.25;  // of samples at first, in distances promised, and in voxels
  constexpr std::size_t kMostSamples = 1'000'000;
  if (!repairs(parameters_) || parameters_.algorithm != Algorithm::kTwoStage) return;
  Observer* const observer = controls_.observer();
  controls_.set_observer(nullptr);  // it learns of the mesh alone
  double spacing = std::min(kSpacing * promise_.max_distance, kLargest);
  CellsNearFaults cells(*isosurface_);
  cells.add(mesh, last_.geometry);
  for (int time = 0; time < kMostTimes && !last_.geometry.is_near() && !controls_.stopped(); ++time) {
    if (time > 0 && time % 2 == 0) spacing /= 2;
    const std::vector<Vec3> samples = cells.samples(spacing);
    if (samples.size() > kMostSamples) break;
    take_nearer_mesh(samples, mesh, cells);
  }
  controls_.set_observer(observer);
  if (observer != nullptr) observer->reshaped(mesh);
}

// The mesh that these samples give to stage 1, if it is nearer to the isosurface. Adds the cells where it is not near.
void Pipeline::take_nearer_mesh(std::span<const Vec3> samples, SurfaceMesh& mesh, CellsNearFaults& cells) {
  const MeshFaults last_before = last_;
  RepairStats repair_before = std::exchange(result_.repair, {});  // its counters decide on rounds
  SurfaceMesh again = stage1(samples);
  controls_.enter("refine");
  RefineOptions options = refine_options(parameters_, r_min_box_, coverage_targets_, options_.threads);
  timed(result_.refine, [&] { refine_geometry(again, *isosurface_, options, controls_, result_.refine); });
  options.smoothing_passes = 0;
  if (parameters_.size.max_edge) limit_edges(again, options);
  improve(again, parameters_.shape.rounds);
  refine_to_error(again, options);
  cells.add(again, last_.geometry);
  const auto off = [](const GeometryCheck& check) { return check.mesh_off + std::ssize(check.missed_points); };
  const bool is_nearer = !controls_.stopped() && off(last_.geometry) < off(last_before.geometry);
  if (is_nearer) {
    mesh = std::move(again);
  } else {
    last_ = last_before;
    std::swap(result_.repair, repair_before);
  }
  result_.repair.seconds += repair_before.seconds;
}

// Where the mesh is farthest from the isosurface first: each round allows a smaller height, until there are enough
// vertices. Where that is nothing any more, as on planes, it allows smaller radii.
void Pipeline::refine_to_count(SurfaceMesh& mesh, RefineOptions options, std::size_t count) {
  constexpr int kMostRounds = 60;
  constexpr double kBeyond = 0.9, kLeastFactor = 0.4, kMostFactor = 0.9, kNoHeight = 2e-3, kRadiusFactor = 0.8,
                   kLeastRadius = 0.2;
  controls_.enter("refine");
  // That of equilateral triangles, two for each vertex.
  const double even_radius = std::sqrt(2 * area_of(mesh) / (3 * std::sqrt(3.0) * static_cast<double>(count)));
  options.r_min = std::min(options.r_min, kLeastRadius * even_radius);
  options.criterion2 = Criterion2::kCircumradius;
  options.coverage_targets = coverage_targets_;  // others than at first, where stage 1 has run again
  double radius = 2 * even_radius;
  for (int round = 0; round < kMostRounds && mesh.points.size() < count && !controls_.poll(); ++round) {
    // Vertices grow as the inverse of the height.
    const double share = static_cast<double>(mesh.points.size()) / static_cast<double>(count);
    options.max_distance *= std::clamp(kBeyond * share, kLeastFactor, kMostFactor);
    if (options.max_distance < kNoHeight) {
      options.epsilon2 = radius;  // of a pole height of 1
      radius *= kRadiusFactor;
    }
    timed(result_.refine, [&] {
      set_side_adjacency(mesh);
      mesh.pole_heights.assign(mesh.points.size(), 1);
      refine_geometry(mesh, *isosurface_, options, controls_, result_.refine);
    });
  }
}

// Down to the number asked for, or as far as the error allows. Where only a number is asked for, more error is allowed
// as long as it takes, and promised afterwards.
void Pipeline::decimate_mesh(SurfaceMesh& mesh, std::span<const Vec3> witnesses) {
  constexpr double kMostTimes = 64, kRounding = 1.001;
  controls_.enter("decimate");
  DecimationOptions options;
  options.max_error = promise_.max_distance;
  options.enough = static_cast<std::size_t>(parameters_.size.target_vertices.value_or(0));
  options.min_angle = shape_options(parameters_).min_angle;
  options.max_edge = longest_edge_allowed(parameters_);
  options.witnesses.assign(witnesses.begin(), witnesses.end());
  const double most = parameters_.size.max_error ? options.max_error : kMostTimes * options.max_error;
  timed(result_.decimation, [&] {
    for (; !controls_.stopped(); options.max_error = std::min(2 * options.max_error, most)) {
      decimate(mesh, *surface_, options, controls_, result_.decimation);
      if (mesh.points.size() <= options.enough || options.max_error >= most) break;
    }
  });
  const double reached = std::min(kRounding * result_.decimation.largest_error, options.max_error);
  promise_.max_distance = std::max(promise_.max_distance, reached);
  result_.promised_distance = promise_.max_distance;
}

// What decimation has left too far off: steps bring it near, and may leave small angles, which others then mend as long
// as all stays near.
void Pipeline::bring_decimated_near(SurfaceMesh& mesh) {
  constexpr double kFreedom = 16;
  constexpr int kMostRounds = 3;
  RepeatedCheck check(*surface_, promise_);
  const auto look = [&] {
    last_.geometry = timed(result_.certify_stage, [&] { return check(mesh); });
    return last_.geometry.is_near();
  };
  if (look()) return;
  if (!parameters_.size.max_error) return widen_promise(mesh, check);
  for (int round = 0; round < kMostRounds && !controls_.stopped(); ++round) {
    take_steps_nearer(mesh, check, kFreedom);
    if (!look()) return;
    SurfaceMesh near = mesh;
    improve_decimated(mesh);
    if (look()) return;
    if (round + 1 == kMostRounds) {
      mesh = std::move(near);
      look();
    }
  }
}

// Where a number of vertices is all that is asked for, what lies between the points measured decides what is promised.
void Pipeline::widen_promise(const SurfaceMesh& mesh, const RepeatedCheck& check) {
  constexpr double kFactor = 1.05, kMost = 1.5;
  const double first = promise_.max_distance;
  while (!last_.geometry.is_near() && promise_.max_distance < kMost * first) {
    promise_.max_distance *= kFactor;
    last_.geometry = timed(result_.certify_stage, [&] { return check.again_within(promise_, mesh); });
  }
  result_.promised_distance = promise_.max_distance;
}

// Decimation makes no angle smaller than it was, but some were small where steps had brought triangles near, and in
// what comes from finer cubes. With fewer vertices they have room to get better, within the distance promised.
void Pipeline::improve_decimated(SurfaceMesh& mesh) {
  if (!improves_shape(parameters_) || controls_.stopped()) return;
  ShapeOptions options = shape_options(parameters_);
  options.max_height = options.max_distance = options.max_sample = promise_.max_distance;
  timed(result_.shape, [&] { improve_shape(mesh, *surface_, options, controls_, result_.shape); });
}

}  // namespace deliso

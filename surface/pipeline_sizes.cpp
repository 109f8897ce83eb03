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
#include "surface/sizes/long_edges.h"

namespace deliso {

namespace {

constexpr double kMostWidened = 1.5;  // of the error of decimation: what is promised for what lies between its points

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
  // decimation begins again with points there, and the last time with a much smaller error, since finer cubes of a
  // whole component would have twenty times as many vertices. Where it leaves triangles that cross when rounded, as
  // along straight creases, with a smaller error: with that it takes other vertices out.
  constexpr int kMostTimes = 4;
  constexpr double kSmaller = 0.95, kMuchSmaller = 0.7;
  const bool is_near = last_.geometry.is_near();
  const SurfaceMesh before = mesh;
  std::vector<Vec3> missed;
  double share = 1;
  for (int time = 0; time < kMostTimes && !controls_.poll(); ++time) {
    if (time > 0) mesh = before;
    decimate_mesh(mesh, missed, share);
    improve_within_promise(mesh, missed);
    bring_decimated_near(mesh, missed);
    timed(result_.certify_stage, [&] { look_in_world(mesh); });
    const bool crosses = last_.crossing.meeting_pairs() > 0;
    if (!is_near || (last_.geometry.missed_points.empty() && !crosses)) break;
    missed.insert(missed.end(), last_.geometry.missed_points.begin(), last_.geometry.missed_points.end());
    if (crosses) {
      share *= kSmaller;
    } else if (time + 2 == kMostTimes) {
      share *= kMuchSmaller;
    }
  }
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

// Whether nothing is wrong with a mesh but that it is farther off than promised at first.
bool Pipeline::is_right_within(const SurfaceMesh& mesh, double error) {
  const double promised = std::exchange(promise_.max_distance, kMostWidened * error);
  const bool is_right = faults_of(mesh).count() == 0;
  promise_.max_distance = promised;
  return is_right;
}

// Down to the number asked for, or as far as the error allows. Where only a number is asked for, more error is allowed
// as long as it takes and as the mesh stays right, and promised afterwards; but none that hardly pays, as where handles
// and components need more vertices than are asked for.
void Pipeline::decimate_mesh(SurfaceMesh& mesh, std::span<const Vec3> witnesses, double share) {
  constexpr double kMostTimes = 64, kRounding = 1.001;
  constexpr double kLeastGain = 0.05;  // of the vertices, for twice the error
  controls_.enter("decimate");
  DecimationOptions options;
  options.enough = static_cast<std::size_t>(parameters_.size.target_vertices.value_or(0));
  options.min_angle = shape_options(parameters_).min_angle;
  options.max_edge = longest_edge_allowed(parameters_);
  options.witnesses.assign(witnesses.begin(), witnesses.end());
  const bool may_grow = !parameters_.size.max_error;
  if (may_grow) promise_.max_distance = kept_distance();
  options.max_error = share * promise_.max_distance;
  const double most = may_grow ? kMostTimes * options.max_error : options.max_error;
  for (bool has_grown = false; !controls_.stopped(); has_grown = true) {
    const SurfaceMesh before = has_grown ? mesh : SurfaceMesh();
    const DecimationStats stats_before = result_.decimation;
    timed(result_.decimation, [&] { decimate(mesh, *surface_, options, controls_, result_.decimation); });
    const bool pays = mesh.points.size() <= options.enough ||
                      double(mesh.points.size()) <= (1 - kLeastGain) * double(before.points.size());
    if (has_grown && !(pays && is_right_within(mesh, options.max_error))) {
      mesh = before;
      const double seconds = result_.decimation.seconds;
      result_.decimation = stats_before;
      result_.decimation.seconds = seconds;
      options.max_error /= 2;
      break;
    }
    if (mesh.points.size() <= options.enough || options.max_error >= most) break;
    options.max_error = std::min(2 * options.max_error, most);
  }
  const double reached = std::min(kRounding * result_.decimation.largest_error, options.max_error);
  promise_.max_distance = std::max(promise_.max_distance, reached);
  note_promised();
}

// What decimation has left too far off: steps bring it near, and may leave small angles, which others then mend as long
// as all stays near.
void Pipeline::bring_decimated_near(SurfaceMesh& mesh, std::span<const Vec3> witnesses) {
  constexpr double kFreedom = 16;
  constexpr int kMostRounds = 3;
  RepeatedCheck check(*surface_, promise_);
  const auto look = [&] {
    last_.geometry = timed(result_.certify_stage, [&] { return check(mesh); });
    return last_.geometry.is_near();
  };
  const bool is_near = look();
  if (!parameters_.size.max_error) return fit_promise(mesh, check);
  if (is_near) return;
  for (int round = 0; round < kMostRounds && !controls_.stopped(); ++round) {
    take_steps_nearer(mesh, check, kFreedom);
    if (!look()) return;
    SurfaceMesh near = mesh;
    improve_within_promise(mesh, witnesses);
    if (look()) return;
    if (round + 1 == kMostRounds) {
      mesh = std::move(near);
      look();
    }
  }
}

// Where a number of vertices is all that is asked for, how far the mesh is off decides what is promised: farther than
// decimation has measured, for what lies between its points, or nearer, since its errors add up from step to step.
void Pipeline::fit_promise(const SurfaceMesh& mesh, const RepeatedCheck& check) {
  constexpr double kFactor = 1.05;
  constexpr int kBisections = 5;
  const double first = promise_.max_distance;
  while (!last_.geometry.is_near() && promise_.max_distance < kMostWidened * first) {
    promise_.max_distance *= kFactor;
    last_.geometry = timed(result_.certify_stage, [&] { return check.again_within(promise_, mesh); });
  }
  double least = kept_distance();
  for (int i = 0; i < kBisections && last_.geometry.is_near(); ++i) {
    if (promise_.max_distance <= kFactor * least || controls_.poll()) break;
    Promise nearer = promise_;
    nearer.max_distance = std::sqrt(least * promise_.max_distance);
    GeometryCheck now = timed(result_.certify_stage, [&] { return check_geometry(mesh, *surface_, nearer); });
    if (now.is_near()) {
      promise_ = nearer;
      last_.geometry = std::move(now);
    } else {
      least = nearer.max_distance;
    }
  }
  note_promised();
  // Decimation adds errors up; what was measured here is nearer.
  DecimationStats& stats = result_.decimation;
  stats.largest_error = std::min(stats.largest_error, result_.promised_distance);
}

void Pipeline::note_promised() {
  const bool is_as_asked = promise_.max_distance == kept_distance();
  result_.promised_distance = is_as_asked ? promised_distance(parameters_) : promise_.max_distance + rounding_;
}

Promise Pipeline::stated() const {
  Promise promise = promise_;
  promise.max_distance = result_.promised_distance;
  return promise;
}

// Better angles for what the other steps would take too far: where steps had brought triangles near, and in what comes
// from cubes. Decimation makes no angle smaller than it was; with fewer vertices these have room to get better.
// `left`: triangles that are left alone.
void Pipeline::improve_within_promise(SurfaceMesh& mesh, std::span<const Vec3> witnesses, KnownTriangles left) {
  if (!improves_shape(parameters_) || controls_.stopped()) return;
  ShapeOptions options = shape_options(parameters_);
  options.max_height = options.max_distance = options.max_sample = promise_.max_distance;
  options.witnesses.assign(witnesses.begin(), witnesses.end());
  timed(result_.shape, [&] { improve_shape(mesh, *surface_, options, controls_, result_.shape, left); });
}

}  // namespace deliso

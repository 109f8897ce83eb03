#include "surface/shape/shape_options.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "surface/base/sizes.h"

namespace deliso {

namespace {

// A triangle whose circumradius is rho times its shortest edge has an angle of this size across from that edge. With
// the paper's rho of 2 fewer triangles are worth the time.
double usual_angle(double rho) {
  constexpr double kPapersRho = 2, kMost = 10 * std::numbers::pi / 180;
  const double bounded = std::asin(1 / (2 * rho));
  return rho < kPapersRho ? bounded : std::min(bounded, kMost);
}

}  // namespace

ShapeOptions shape_options(const Parameters& parameters) {
  // Of the distance promised: heights are measured at centroids alone, and crossings stay within it.
  constexpr double kHeightShare = 0.5, kDistanceShare = 0.75;
  ShapeOptions options;
  const std::optional<double> angle = effective_min_angle(parameters);
  options.min_angle = angle ? *angle * std::numbers::pi / 180 : usual_angle(parameters.stage2.rho);
  options.rounds = parameters.shape.rounds;
  options.max_height = kHeightShare * promised_distance(parameters);
  options.max_distance = kDistanceShare * promised_distance(parameters);
  options.max_edge = longest_edge_allowed(parameters);
  return options;
}

}  // namespace deliso

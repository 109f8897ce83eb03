#include "surface/shape/shape_options.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace deliso {

ShapeOptions shape_options(const Parameters& parameters) {
  constexpr double kHeightShare = 0.5,
                   kDistanceShare = 0.75;  // of the distance promised: heights are measured at centroids alone
  ShapeOptions options;
  // A triangle whose circumradius is rho times its shortest edge has an angle of this size across from that edge.
  options.min_angle = parameters.shape.min_angle ? *parameters.shape.min_angle * std::numbers::pi / 180
                                                 : std::asin(1 / (2 * parameters.stage2.rho));
  options.rounds = parameters.shape.rounds;
  options.max_height = kHeightShare * parameters.promise.max_distance;
  options.max_distance = kDistanceShare * parameters.promise.max_distance;
  return options;
}

}  // namespace deliso

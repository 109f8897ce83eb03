#include "surface/base/sizes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace deliso {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMostAngle = 35;  // degrees: what the shape stage reaches

}  // namespace

double refined_height(const Parameters& parameters) {
  constexpr double kShare = 0.6;
  const double of_stage = parameters.stage2.max_distance.value_or(std::numeric_limits<double>::infinity());
  return is_sized(parameters) ? std::min(of_stage, kShare * promised_distance(parameters)) : of_stage;
}

std::optional<double> wanted_angle(const SizeParameters& size) {
  std::optional<double> angle = size.min_angle;
  if (size.max_aspect) angle = std::max(angle.value_or(0), std::atan(2 / *size.max_aspect) / kDegree);
  return angle ? std::optional(std::min(*angle, kMostAngle)) : std::nullopt;
}

double effective_rho(double rho, const SizeParameters& size) {
  const std::optional<double> angle = wanted_angle(size);
  return angle ? std::min(rho, std::max(1.0, 1 / (2 * std::sin(*angle * kDegree)))) : rho;
}

std::optional<double> effective_min_angle(const Parameters& parameters) {
  const std::optional<double> angle = wanted_angle(parameters.size);
  return angle ? angle : parameters.shape.min_angle;
}

}  // namespace deliso

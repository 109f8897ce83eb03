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

// The usual one takes white noise and masks nearer to the isosurface with as many vertices, and scans as near with
// three to nine tenths of them. It falls as distances do with thresholds finer than the paper's. Where rho asks for
// better angles there is none: small triangles along creases are what has such angles.
double effective_h_min(const Parameters& parameters) {
  const Stage2Parameters& stage2 = parameters.stage2;
  const Stage2Parameters papers;
  constexpr double kUsual = 0.025;
  if (is_sized(parameters)) return 0;
  if (stage2.h_min) return *stage2.h_min;
  const double finer = std::min({1.0, stage2.epsilon1 / papers.epsilon1, stage2.epsilon2 / papers.epsilon2});
  return effective_rho(stage2.rho, parameters.size) < papers.rho ? 0 : kUsual * finer * finer;
}

std::optional<double> effective_min_angle(const Parameters& parameters) {
  const std::optional<double> angle = wanted_angle(parameters.size);
  return angle ? angle : parameters.shape.min_angle;
}

}  // namespace deliso

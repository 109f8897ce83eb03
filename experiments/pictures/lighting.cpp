#include "experiments/pictures/lighting.h"

#include <algorithm>
#include <cmath>

namespace deliso {
namespace {

constexpr Colour kOutside{0.78, 0.58, 0.30};
constexpr Colour kInside{0.20, 0.40, 0.62};
constexpr Colour kLine{0.012, 0.014, 0.02};

// Shares of the lights; together 1.
constexpr double kEverywhere = 0.26;
constexpr double kFromEye = 0.22;
constexpr double kFromShoulder = 0.52;
constexpr double kHighlight = 0.10;

// Over the left shoulder, of unit length.
constexpr Vec3 kShoulder{-2.0 / 7, 3.0 / 7, 6.0 / 7};
// Half way between that light and the eye: a mirror turned there shows the light.
const Vec3 kHalfWay = (kShoulder + Vec3{0, 0, 1}) / norm(kShoulder + Vec3{0, 0, 1});

double encoded(double linear) {
  const double value = std::clamp(linear, 0.0, 1.0);
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

double fortieth_power(double x) {
  const double x2 = x * x, x4 = x2 * x2, x8 = x4 * x4, x16 = x8 * x8;
  return x16 * x16 * x8;
}

}  // namespace

Colour lit(const LitPoint& point) {
  const double eye = std::max(0.0, point.normal.z);
  const double shoulder = std::max(0.0, dot(point.normal, kShoulder));
  // Enclosed places get less of every light, but lose less of the light that shines into them.
  const double inward = 0.35 + 0.65 * point.openness;
  const double light = kEverywhere * point.openness + inward * (kFromEye * eye + kFromShoulder * shoulder);
  const double highlight = inward * kHighlight * fortieth_power(std::max(0.0, dot(point.normal, kHalfWay)));
  const Colour surface = light * (point.outside ? kOutside : kInside) + highlight * Colour{1, 1, 1};
  return (1 - point.line) * surface + point.line * kLine;
}

std::array<std::uint8_t, 3> srgb(const Colour& colour) {
  const auto byte = [](double linear) { return static_cast<std::uint8_t>(std::lround(255 * encoded(linear))); };
  return {byte(colour.x), byte(colour.y), byte(colour.z)};
}

}  // namespace deliso

#include "experiments/pictures/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace deliso {
namespace {

constexpr double kMargin = 0.04;  // of the picture, left free on each side

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

}  // namespace

Camera::Camera(const View& view, std::span<const Vec3> framed, std::int32_t width, std::int32_t height)
    : perspective_(view.field_of_view > 0), width_(width), height_(height) {
  const double azimuth = radians(view.azimuth);
  const double elevation = radians(view.elevation);
  right_ = {-std::sin(azimuth), std::cos(azimuth), 0};
  toward_eye_ = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  up_ = cross(toward_eye_, right_);
  // The framed points and their middle, in the camera's orientation.
  Box3 extent;
  for (const Vec3& p : framed) extent.extend(turned(p));
  const Vec3 middle = 0.5 * (extent.low + extent.high);
  const Vec3 look_at = view.look_at.value_or(middle.x * right_ + middle.y * up_ + middle.z * toward_eye_);
  // Half the picture's sides, in units of half its smaller side, without the margin.
  const double smaller = std::min(width, height);
  const double half_width = width / smaller * (1 - 2 * kMargin);
  const double half_height = height / smaller * (1 - 2 * kMargin);
  const auto across = [&](const Vec3& from_middle) {
    return std::max(std::abs(from_middle.x) / half_width, std::abs(from_middle.y) / half_height);
  };
  if (!perspective_) {
    eye_ = look_at + norm(extent.size()) * toward_eye_;
    pixel_ = 2 * across(extent.high - middle) / (smaller * view.zoom);
    return;
  }
  // The distance of the point that needs the largest one.
  const double tangent = std::tan(radians(0.5 * view.field_of_view));
  double distance = 0;
  for (const Vec3& p : framed) {
    const Vec3 from_middle = turned(p) - middle;
    distance = std::max(distance, from_middle.z + across(from_middle) / tangent);
  }
  eye_ = look_at + distance * toward_eye_;
  pixel_ = 2 * tangent / (smaller * view.zoom);
}

Line Camera::ray(double x, double y) const {
  const Vec3 across = (x - 0.5 * width_) * pixel_ * right_ + (0.5 * height_ - y) * pixel_ * up_;
  if (!perspective_) return {eye_ + across, -toward_eye_};
  const Vec3 direction = across - toward_eye_;
  return {eye_, direction / norm(direction)};
}

double Camera::first_t() const { return perspective_ ? 0 : -std::numeric_limits<double>::infinity(); }

std::optional<std::array<double, 2>> Camera::project(const Vec3& p) const {
  const Vec3 seen = in_frame(p);
  const double pixel = pixel_size(seen);
  if (!(pixel > 0)) return std::nullopt;
  return std::array<double, 2>{0.5 * width_ + seen.x / pixel, 0.5 * height_ - seen.y / pixel};
}

}  // namespace deliso

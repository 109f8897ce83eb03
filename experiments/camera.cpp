#include "experiments/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace deliso {
namespace {

constexpr double kMargin = 0.04;  // of the picture, left free on each side

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

// Calls visit(corner - centre) for the corners of the box.
template <class Visit>
void for_each_corner(const Box3& box, Visit&& visit) {
  const Vec3 half = 0.5 * box.size();
  for (const double x : {-half.x, half.x}) {
    for (const double y : {-half.y, half.y}) {
      for (const double z : {-half.z, half.z}) visit(Vec3{x, y, z});
    }
  }
}

}  // namespace

Camera::Camera(const View& view, const Box3& framed, std::int32_t width, std::int32_t height)
    : perspective_(view.field_of_view > 0), width_(width), height_(height) {
  const double azimuth = radians(view.azimuth);
  const double elevation = radians(view.elevation);
  right_ = {-std::sin(azimuth), std::cos(azimuth), 0};
  toward_eye_ = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  up_ = cross(toward_eye_, right_);
  const Vec3 look_at = view.look_at.value_or(0.5 * (framed.low + framed.high));

  // Half the picture's sides, in units of half its smaller side, without the margin.
  const double smaller = std::min(width, height);
  const double half_width = width / smaller * (1 - 2 * kMargin);
  const double half_height = height / smaller * (1 - 2 * kMargin);
  if (perspective_) {
    // As far away as the corner that needs it most.
    const double tangent = std::tan(radians(0.5 * view.field_of_view));
    double distance = 0;
    for_each_corner(framed, [&](const Vec3& corner) {
      const double across =
          std::max(std::abs(dot(corner, right_)) / half_width, std::abs(dot(corner, up_)) / half_height);
      distance = std::max(distance, dot(corner, toward_eye_) + across / tangent);
    });
    eye_ = look_at + distance * toward_eye_;
    pixel_ = 2 * tangent / (smaller * view.zoom);
    return;
  }
  double half_extent = 0;
  for_each_corner(framed, [&](const Vec3& corner) {
    half_extent =
        std::max({half_extent, std::abs(dot(corner, right_)) / half_width, std::abs(dot(corner, up_)) / half_height});
  });
  eye_ = look_at + framed.diagonal() * toward_eye_;
  pixel_ = 2 * half_extent / (smaller * view.zoom);
}

Line Camera::ray(double x, double y) const {
  const Vec3 across = (x - 0.5 * width_) * pixel_ * right_ + (0.5 * height_ - y) * pixel_ * up_;
  if (!perspective_) return {eye_ + across, -toward_eye_};
  const Vec3 direction = across - toward_eye_;
  return {eye_, direction / norm(direction)};
}

double Camera::first_t() const { return perspective_ ? 0 : -std::numeric_limits<double>::infinity(); }

std::optional<std::array<double, 2>> Camera::project(const Vec3& p) const {
  const Vec3 seen = p - eye_;
  const double distance = -dot(seen, toward_eye_);
  if (perspective_ && distance <= 0) return std::nullopt;
  const double scale = 1 / (perspective_ ? pixel_ * distance : pixel_);
  return std::array<double, 2>{0.5 * width_ + dot(seen, right_) * scale, 0.5 * height_ - dot(seen, up_) * scale};
}

}  // namespace deliso

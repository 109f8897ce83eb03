// The camera of a picture: it maps points of the picture to rays, and points in space to points of the picture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"

namespace deliso {

struct View {
  // The direction towards the eye, in degrees: azimuth in the xy plane from x towards y, elevation from that plane
  // towards z. z is up in the picture.
  double azimuth = 30;
  double elevation = 20;
  double zoom = 1;              // > 0; 1: the framed points just fit
  double field_of_view = 0;     // degrees, 0 <= f < 180, of the picture's smaller side at zoom 1; 0: parallel rays
  std::optional<Vec3> look_at;  // in the middle of the picture; default: the middle of the framed points
};

class Camera {
 public:
  // A picture of width x height pixels. All framed points are visible at zoom 1, unless look_at is given. Precondition:
  // there are at least two different points.
  Camera(const View& view, std::span<const Vec3> framed, std::int32_t width, std::int32_t height);

  // The ray through the point (x, y) of the picture, in pixels from its top left corner. The direction has unit length.
  [[nodiscard]] Line ray(double x, double y) const;
  // The ray parameter from which on things are visible: 0 at the eye, minus infinity for parallel rays.
  [[nodiscard]] double first_t() const;
  // Where `p` appears in the picture; nothing when it is behind the eye.
  [[nodiscard]] std::optional<std::array<double, 2>> project(const Vec3& p) const;
  // A direction in the camera's frame: to the right, upwards, towards the eye.
  [[nodiscard]] Vec3 turned(const Vec3& v) const { return {dot(v, right_), dot(v, up_), dot(v, toward_eye_)}; }
  // A point in that frame; its origin is the eye (for parallel rays: some point in front of everything framed).
  [[nodiscard]] Vec3 in_frame(const Vec3& p) const { return turned(p - eye_); }
  // The size of a pixel in space at a point of the camera's frame.
  [[nodiscard]] double pixel_size(const Vec3& in_frame) const { return perspective_ ? pixel_ * -in_frame.z : pixel_; }

  // From the middle of the picture towards the eye, of unit length.
  [[nodiscard]] const Vec3& toward_eye() const { return toward_eye_; }
  [[nodiscard]] std::int32_t width() const { return width_; }
  [[nodiscard]] std::int32_t height() const { return height_; }

 private:
  Vec3 right_;
  Vec3 up_;
  Vec3 toward_eye_;
  Vec3 eye_;                  // parallel rays: the middle of the plane that they start from
  bool perspective_ = false;  // rays from one point
  double pixel_ = 0;          // size of a pixel; in perspective at distance 1
  std::int32_t width_ = 0;
  std::int32_t height_ = 0;
};

}  // namespace deliso

// Where a picture is seen from: which ray belongs to a point of the picture, and which point of the picture to a point
// in space.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"

namespace deliso {

struct View {
  // The direction towards the eye, in degrees: azimuth in the xy plane from x towards y, elevation from that plane
  // towards z. z is up in the picture.
  double azimuth = 30;
  double elevation = 20;
  double zoom = 1;              // > 0; 1: the framed box just fits
  double field_of_view = 0;     // degrees, 0 <= f < 180, of the picture's smaller side at zoom 1; 0: parallel rays
  std::optional<Vec3> look_at;  // in the middle of the picture; default: the framed box's centre
};

class Camera {
 public:
  // A picture of width x height pixels that shows `framed` whole. Precondition: the box is not empty.
  Camera(const View& view, const Box3& framed, std::int32_t width, std::int32_t height);

  // The ray through the point (x, y) of the picture, in pixels from its top left corner. The direction has unit length.
  [[nodiscard]] Line ray(double x, double y) const;
  // The ray parameter where things begin to be seen: 0 at the eye, minus infinity for parallel rays.
  [[nodiscard]] double first_t() const;
  // Where `p` is seen; nothing when it is not before the eye.
  [[nodiscard]] std::optional<std::array<double, 2>> project(const Vec3& p) const;
  // The size of a pixel in space at the ray parameter t.
  [[nodiscard]] double pixel_size(double t) const { return perspective_ ? pixel_ * t : pixel_; }

  // Unit vectors: to the right and upwards in the picture, and from its middle towards the eye.
  [[nodiscard]] const Vec3& right() const { return right_; }
  [[nodiscard]] const Vec3& up() const { return up_; }
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

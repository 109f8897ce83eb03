// Shapes that a picture can show, as surfaces that rays intersect; and the part of space that is shown.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"
#include "experiments/pictures/camera.h"
#include "raycast/isosurface.h"

namespace deliso {

// Where a ray meets a surface.
struct SurfacePoint {
  double t = 0;               // on the ray
  Vec3 normal;                // of unit length, towards the side that the ray comes from
  bool outside = true;        // the ray comes from the side of lower values
  std::uint32_t element = 0;  // the triangle of a mesh
};

// A surface in world coordinates. All functions may be called by several threads at once.
class Shape {
 public:
  Shape() = default;
  virtual ~Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;

  // The first point of the surface on the ray between t0 and t1 (finite). Precondition: ray.direction has unit length.
  [[nodiscard]] virtual std::optional<SurfacePoint> first_hit(const Line& ray, double t0, double t1) const = 0;
  // The distance from the picture's point (x, y) to the nearest edge of an element as projected, in pixels; infinity
  // without edges.
  [[nodiscard]] virtual double edge_distance(std::uint32_t /*element*/, const Camera& /*camera*/, double /*x*/,
                                             double /*y*/) const {
    return std::numeric_limits<double>::infinity();
  }
  // The projected size of an element: its mean edge in pixels; infinity without edges.
  [[nodiscard]] virtual double element_size(std::uint32_t /*element*/, const Camera& /*camera*/) const {
    return std::numeric_limits<double>::infinity();
  }
  // A box that holds the surface; empty when there is none.
  [[nodiscard]] virtual const Box3& box() const = 0;
};

// A plane across an axis. What lies between it and the eye is cut away.
struct ClipPlane {
  std::size_t axis = 0;
  double value = 0;  // world coordinate
};

// "z=12.5". Throws InputError naming `option`.
ClipPlane parse_clip_plane(const std::string& text, const std::string& option);

// The part of `whole` that the planes leave, slightly enlarged so that triangles in its faces are inside. `toward_eye`
// is the direction of the eye (for a plane along that direction, the part at lower coordinates is kept). Throws
// InputError naming `option` and the range when nothing is left.
Box3 kept_box(const Box3& whole, const std::vector<ClipPlane>& planes, const Vec3& toward_eye,
              const std::string& option);

// The part t_first <= t <= t_last of a ray in a box.
struct RayPart {
  double first = 0;
  double last = 0;
};
std::optional<RayPart> part_in_box(const Line& ray, const Box3& box);

}  // namespace deliso

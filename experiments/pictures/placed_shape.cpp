#include "experiments/pictures/placed_shape.h"

#include <utility>

namespace deliso {

Box3 placed_box(const Box3& box, const Affine& to_world) {
  Box3 placed;
  if (!(box.low.x <= box.high.x)) return placed;
  for (const double x : {box.low.x, box.high.x}) {
    for (const double y : {box.low.y, box.high.y}) {
      for (const double z : {box.low.z, box.high.z}) placed.extend(to_world({x, y, z}));
    }
  }
  return placed;
}

PlacedShape::PlacedShape(std::unique_ptr<Shape> shape, const Affine& to_world)
    : shape_(std::move(shape)), from_world_(to_world.inverse()), box_(placed_box(shape_->box(), to_world)) {}

std::optional<SurfacePoint> PlacedShape::first_hit(const Line& ray, double t0, double t1) const {
  const Vec3 direction = from_world_.direction(ray.direction);
  const double length = norm(direction);  // 1 but where the map is sheared or rounded
  auto point = shape_->first_hit({from_world_(ray.origin), direction / length}, t0 * length, t1 * length);
  if (!point) return point;
  point->t /= length;
  // Normals are mapped by the transposed inverse, which keeps them on the side of the ray.
  const auto& [a, b, c] = from_world_.columns;
  const Vec3 normal{dot(a, point->normal), dot(b, point->normal), dot(c, point->normal)};
  point->normal = normal / norm(normal);
  return point;
}

}  // namespace deliso

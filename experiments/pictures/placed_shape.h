// A shape under an affine map: that of a volume's own coordinates to the world's.
#pragma once

#include <memory>

#include "experiments/pictures/shape.h"
#include "volume/affine.h"

namespace deliso {

// A box that holds the box under the map; empty for an empty one.
Box3 placed_box(const Box3& box, const Affine& to_world);

class PlacedShape : public Shape {
 public:
  // Precondition: the shape has no edges, the map has an inverse.
  PlacedShape(std::unique_ptr<Shape> shape, const Affine& to_world);

  // The ray is mapped back to the shape's own coordinates, where it is intersected.
  [[nodiscard]] std::optional<SurfacePoint> first_hit(const Line& ray, double t0, double t1) const override;
  [[nodiscard]] const Box3& box() const override { return box_; }

 private:
  std::unique_ptr<Shape> shape_;
  Affine from_world_;
  Box3 box_;
};

}  // namespace deliso

// The isosurface of the trilinear interpolant as a thing to be seen: rays are solved against it, no mesh is made.
#pragma once

#include "experiments/shape.h"
#include "raycast/isosurface.h"
#include "volume/scalar_grid.h"

namespace deliso {

class IsosurfaceShape : public Shape {
 public:
  // Keeps a reference to the grid. Precondition: no sample equals `isovalue`.
  IsosurfaceShape(const ScalarGrid& grid, double isovalue);

  // The surface inside the volume's box. The normal is the gradient's direction at the point, so creases between voxel
  // cells are seen as they are.
  [[nodiscard]] std::optional<SurfacePoint> first_hit(const Line& ray, double t0, double t1) const override;
  // The voxel cells that hold the surface.
  [[nodiscard]] const Box3& box() const override { return box_; }

 private:
  Isosurface surface_;
  Box3 volume_box_;
  double unit_ = 1;  // of mesh space, in world units
  Box3 box_;
};

}  // namespace deliso

// The isosurface of the trilinear interpolant as a shape: rays are intersected with it directly, without a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "experiments/pictures/shape.h"
#include "raycast/isosurface.h"
#include "volume/scalar_grid.h"

namespace deliso {

class IsosurfaceShape : public Shape {
 public:
  // Keeps a reference to the grid. Precondition: no sample equals `isovalue`.
  IsosurfaceShape(const ScalarGrid& grid, double isovalue);

  // The surface inside the volume's box. The normal is the direction of the gradient at the point, so the creases
  // between voxel cells are visible.
  [[nodiscard]] std::optional<SurfacePoint> first_hit(const Line& ray, double t0, double t1) const override;
  [[nodiscard]] const Box3& box() const override { return box_; }
  // Grid-edge crossings: for edges of each direction, the first and last crossing of each row of parallel edges along
  // x. For every view the outermost crossings are among them.
  [[nodiscard]] std::vector<Vec3> outermost_points() const;

 private:
  // A block of voxel cells; a brick that does not hold the isovalue is skipped in one step.
  using Brick = std::array<std::int32_t, 3>;
  class BrickWalk;
  static constexpr std::int32_t kBrickSide = 8;

  void find_active_bricks();
  [[nodiscard]] std::size_t brick_index(const Brick& brick) const {
    return static_cast<std::size_t>(brick[0]) +
           static_cast<std::size_t>(brick_dims_[0]) *
               (static_cast<std::size_t>(brick[1]) +
                static_cast<std::size_t>(brick_dims_[1]) * static_cast<std::size_t>(brick[2]));
  }

  const ScalarGrid& grid_;
  double isovalue_;
  Isosurface surface_;
  Box3 box_;          // of the volume, in the world
  double unit_ = 1;   // of mesh space, in world units
  Brick brick_dims_;  // bricks along each axis
  std::vector<std::uint8_t> is_active_;
};

}  // namespace deliso

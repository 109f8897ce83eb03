// Distances of points to an isosurface, found by walks along gradients of the trilinear interpolant. For checks: it
// shares no code with the mesher's ray search.
//
// Voxel space: lengths in units of the smallest spacing, the first sample at the origin.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"
#include "surface/search/box_tree.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// A point of the isosurface near a given point.
struct FootPoint {
  Vec3 point;
  double distance = 0;  // to the given point
};

class IsosurfaceProbe {
 public:
  // Keeps references to the grid and to `crossings` (all crossings of the isosurface, at least one: see
  // exact_topology).
  IsosurfaceProbe(const ScalarGrid& grid, double isovalue, std::span<const EdgeCrossing> crossings);

  // The smallest spacing in world units, and the maps to voxel space and back.
  [[nodiscard]] double voxel() const { return voxel_; }
  [[nodiscard]] Vec3 to_voxels(const Vec3& world) const { return (world - grid_.origin()) / voxel_; }
  [[nodiscard]] Vec3 to_world(const Vec3& p) const { return grid_.origin() + voxel_ * p; }
  // The volume's box in voxel space, and its spacing there.
  [[nodiscard]] const Vec3& step() const { return step_; }
  [[nodiscard]] const Box3& box() const { return box_; }

  // Interpolant minus isovalue, and its gradient; outside the box, those at the nearest point of the box.
  [[nodiscard]] double value(const Vec3& p) const;
  [[nodiscard]] Vec3 gradient(const Vec3& p) const;

  // A point of the isosurface near p: where lines through p along gradients meet it (far off or near creases also lines
  // in about a hundred directions), or the nearest of its points on grid edges if that is nearer. So the distance is
  // never below the true one (but for rounding). It exceeds the true one only where the isosurface bends strongly
  // within a voxel. If it is farther than `most`, the ball of that radius is searched completely: a point of the
  // isosurface there is found, however the surface bends.
  FootPoint foot_point(const Vec3& p, double most = 0);

  // The same for a point that should lie on the isosurface. If the foot point is farther than 1e-4, the surroundings of
  // p are searched completely, up to a quarter of a voxel. A foot point within that range is at most two thirds farther
  // than the nearest point of the isosurface, however the surface bends.
  FootPoint nearest_point(const Vec3& p, double most = 0);

  // The positions of `crossings` in voxel space, in their order.
  [[nodiscard]] std::vector<Vec3> crossing_points() const;

 private:
  struct Place {
    CellCorners corners;  // less the isovalue
    Vec3 uvw;
  };
  [[nodiscard]] Place place(const Vec3& p) const;
  [[nodiscard]] std::optional<FootPoint> along_line(const Vec3& p, double value_at_p, const Vec3& direction,
                                                    double first_step, double reach) const;
  [[nodiscard]] unsigned faces_beside(const Vec3& p) const;
  void look_around_grid_face(const Vec3& p, unsigned axis, FootPoint& best) const;
  void look_beside_creases(const Vec3& p, FootPoint& best);
  void look_among_crossings(const Vec3& p, FootPoint& best);
  FootPoint foot_along_gradients(const Vec3& p);
  [[nodiscard]] std::optional<FootPoint> foot_within(const Vec3& p, double reach) const;
  [[nodiscard]] std::optional<Vec3> other_side_in(const Vec3& p, const Box3& box, double reach, int halvings) const;
  void look_in_box(const Vec3& p, bool is_below, const Box3& box, FootPoint& beyond) const;

  const ScalarGrid& grid_;
  double isovalue_;
  std::span<const EdgeCrossing> crossings_;
  double voxel_;
  Vec3 step_;  // spacing in voxels
  Box3 box_;
  // Built when first needed.
  std::optional<BoxTree> tree_;
  std::vector<Vec3> points_;
};

}  // namespace deliso

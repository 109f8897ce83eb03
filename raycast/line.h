// A line in mesh space, and in index space, where sample (i, j, k) sits at (i, j, k).
#pragma once

#include <array>
#include <cstddef>

#include "delaunay/base/lanes.h"
#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso {

using AxisValues = std::array<double, 3>;
inline AxisValues axis_values(const Vec3& v) { return {v.x, v.y, v.z}; }

struct Line {
  Vec3 origin;
  Vec3 direction;
  [[nodiscard]] Vec3 at(double t) const { return origin + t * direction; }
};

// A line parameter at which the extended field equals the isovalue.
struct Hit {
  double t = 0;
  bool falling = false;  // the field falls from above to below the isovalue as t grows
};

// A line in each lane.
struct LineLanes {
  Vec3Lanes origin;
  Vec3Lanes direction;
  [[nodiscard]] Line at(std::size_t lane) const { return {origin.at(lane), direction.at(lane)}; }
  void set(std::size_t lane, const Line& line) {
    origin.set(lane, line.origin);
    direction.set(lane, line.direction);
  }
};

// In index space: position(s) = base + s * direction, where the caller's parameter is t = t_origin + s.
struct IndexLine {
  AxisValues base{};
  AxisValues direction{};
  AxisValues inverse{};  // 1 / direction, 0 where direction is 0
  double t_origin = 0;

  // The line parameter at which coordinate `axis` is `plane`. Precondition: direction[axis] is not zero.
  [[nodiscard]] double crossing(std::size_t axis, double plane) const { return (plane - base[axis]) * inverse[axis]; }
};

// A line from far away is re-parametrised near the box, so that s keeps its digits there.
IndexLine index_line(const Line& line, const Vec3& inverse_step, const Dims& dims);

}  // namespace deliso

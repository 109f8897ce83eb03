// Exact tests that marching cubes needs but `volume` may not include: the caller passes them in
// (surface/intersection/exact_tests.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "delaunay/base/vec3.h"

namespace deliso {

struct ExactTests {
  // The side of d with respect to the plane through a, b and c: positive when abc is counterclockwise seen from d.
  double (*orientation)(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
  // Whether three points are not collinear.
  bool (*has_area)(const Vec3& a, const Vec3& b, const Vec3& c);
  // Whether two triangles with areas, given by indices into `points`, have points in common beyond their common
  // corners.
  bool (*meet)(std::span<const Vec3> points, const std::array<std::uint32_t, 3>& s,
               const std::array<std::uint32_t, 3>& t);
};

}  // namespace deliso

// Affine maps of space, such as the one from the index of a sample to its point in the world.
#pragma once

#include <array>
#include <cmath>

#include "delaunay/base/vec3.h"

namespace deliso {

// p goes to offset + p.x columns[0] + p.y columns[1] + p.z columns[2].
struct Affine {
  std::array<Vec3, 3> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 offset{};

  [[nodiscard]] Vec3 direction(const Vec3& v) const { return v.x * columns[0] + v.y * columns[1] + v.z * columns[2]; }
  [[nodiscard]] Vec3 operator()(const Vec3& p) const { return offset + direction(p); }
  // Negative when the map reflects.
  [[nodiscard]] double determinant() const { return dot(columns[0], cross(columns[1], columns[2])); }
  // Precondition: the determinant is not 0.
  [[nodiscard]] Affine inverse() const;

  friend bool operator==(const Affine& a, const Affine& b) { return a.columns == b.columns && a.offset == b.offset; }
};

inline Affine Affine::inverse() const {
  const auto& [a, b, c] = columns;
  const double d = determinant();
  // The rows of the inverse are cross products of the columns.
  const Vec3 x = cross(b, c) / d, y = cross(c, a) / d, z = cross(a, b) / d;
  Affine out;
  out.columns = {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
  out.offset = -out.direction(offset);
  return out;
}

// First b, then a.
inline Affine composed(const Affine& a, const Affine& b) {
  return {{a.direction(b.columns[0]), a.direction(b.columns[1]), a.direction(b.columns[2])}, a(b.offset)};
}

}  // namespace deliso

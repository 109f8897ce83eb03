// Where lines parallel to the x axis cross a mesh, decided exactly.
//
// A line that passes an edge or a vertex crosses what it would cross if it were moved by an infinitely small step along
// y and by a still smaller one along z (simulation of simplicity: Edelsbrunner and Muecke, ACM Transactions on Graphics
// 9, 1990). So a closed surface is crossed an even number of times, inwards and outwards in turn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

struct AxisCrossing {
  std::uint32_t triangle = 0;
  int side = 0;   // 1 when the normal of the triangle has a positive x, else -1
  int place = 0;  // 1: at a larger x than the point that was asked for, -1: at a smaller x, 0: the point lies on it
  double x = 0;   // of the crossing, rounded
};

class AxisRays {
 public:
  // Keeps a reference to the mesh. Precondition: the coordinates are zero or have a magnitude in [2^-160, 2^200]
  // (delaunay/predicates.h), and indices are in range.
  explicit AxisRays(const TriangleMesh& mesh);

  // The crossings of the line through p, in ascending order of x, where they are equal of triangles; `out` is cleared
  // first. The coordinates of p must be as those of the mesh.
  void cross(const Vec3& p, std::vector<AxisCrossing>& out) const;

  // Whether p may lie on a triangle: in its plane and in its box. Triangles along the line are among them, which no
  // line crosses.
  [[nodiscard]] bool may_touch(const Vec3& p) const;

 private:
  [[nodiscard]] std::size_t column_of(double value, std::size_t axis) const;

  const TriangleMesh& mesh_;
  Box3 box_;
  std::size_t side_ = 1;            // columns along y and along z
  std::vector<std::size_t> begin_;  // of each column in `triangles_`
  std::vector<std::uint32_t> triangles_;
};

}  // namespace deliso

#include "surface/recover/boundary_curves.h"

#include <array>
#include <cstdint>

#include "volume/topology/crossing_index.h"

namespace deliso {

namespace {

// One face of the box: the axes (u, v) in it, and the fixed index along the third.
struct Face {
  const ScalarGrid& grid;
  double isovalue;
  std::size_t u, v, w;
  std::int32_t fixed;

  [[nodiscard]] std::array<std::int32_t, 3> sample(std::int32_t i, std::int32_t j) const {
    std::array<std::int32_t, 3> index{};
    index[u] = i;
    index[v] = j;
    index[w] = fixed;
    return index;
  }
  [[nodiscard]] double value(std::int32_t i, std::int32_t j) const {
    const auto s = sample(i, j);
    return grid.at(s[0], s[1], s[2]);
  }
  // The position of the sign change on the edge between two samples of the face, as a fraction of the edge.
  [[nodiscard]] double crossing(double from, double to) const { return edge_parameter(from, to, isovalue); }
  // Index-space point at (x, y) in the face.
  [[nodiscard]] Vec3 at(double x, double y) const {
    Vec3 p;
    p[u] = x;
    p[v] = y;
    p[w] = fixed;
    return p;
  }
};

// In a face cell with four crossings: a point inside each of the two arcs. The bilinear function is
// saddle + k (x - cx)(y - cy); its level set has one branch in each of two opposite quadrants of (cx, cy).
void add_arc_points(const Face& face, std::int32_t i, std::int32_t j, std::vector<Vec3>& points) {
  const double f00 = face.value(i, j);
  const double f10 = face.value(i + 1, j);
  const double f01 = face.value(i, j + 1);
  const double f11 = face.value(i + 1, j + 1);
  const double k = f00 - f10 - f01 + f11;
  const double cx = (f00 - f01) / k;
  const double cy = (f00 - f10) / k;
  const double saddle = f00 - face.isovalue - k * cx * cy;
  if (saddle == 0) return;
  // k (x - cx)(y - cy) = -saddle: one branch right of cx, one left of it.
  const double side = -saddle / k > 0 ? 1 : -1;
  for (const double direction : {-1.0, 1.0}) {
    // Between the ends of a branch, x runs from the vertical side to the crossing of the horizontal side.
    const bool right = direction > 0;
    const bool top = right == (side > 0);
    const double x_end = top ? face.crossing(f01, f11) : face.crossing(f00, f10);
    const double x = right ? 0.5 * (x_end + 1) : 0.5 * x_end;
    const double y = cy - saddle / (k * (x - cx));
    if (y > 0 && y < 1) points.push_back(face.at(i + x, j + y));
  }
}

void add_face(const Face& face, std::vector<Vec3>& points) {
  const std::int32_t nu = face.grid.dims()[face.u];
  const std::int32_t nv = face.grid.dims()[face.v];
  // A box edge belongs to two faces; its crossings are added by the face whose normal axis comes first.
  const auto owns_along_u = [&](std::int32_t j) { return face.w < face.v || (j > 0 && j + 1 < nv); };
  const auto owns_along_v = [&](std::int32_t i) { return face.w < face.u || (i > 0 && i + 1 < nu); };
  for (std::int32_t j = 0; j < nv; ++j) {
    for (std::int32_t i = 0; i < nu; ++i) {
      const double here = face.value(i, j);
      const bool above = here > face.isovalue;
      const bool along_u = i + 1 < nu && above != (face.value(i + 1, j) > face.isovalue);
      const bool along_v = j + 1 < nv && above != (face.value(i, j + 1) > face.isovalue);
      if (along_u && owns_along_u(j)) points.push_back(face.at(i + face.crossing(here, face.value(i + 1, j)), j));
      if (along_v && owns_along_v(i)) points.push_back(face.at(i, j + face.crossing(here, face.value(i, j + 1))));
      const bool four = along_u && along_v && above == (face.value(i + 1, j + 1) > face.isovalue);
      if (four) add_arc_points(face, i, j, points);
    }
  }
}

}  // namespace

std::vector<Vec3> boundary_curve_points(const Isosurface& isosurface) {
  const ScalarGrid& grid = isosurface.grid();
  std::vector<Vec3> points;
  for (std::size_t w = 0; w < 3; ++w) {
    for (const bool high : {false, true}) {
      add_face({grid, isosurface.isovalue(), (w + 1) % 3, (w + 2) % 3, w, high ? grid.dims()[w] - 1 : 0}, points);
    }
  }
  for (Vec3& p : points) p = scaled(p, isosurface.step());
  return points;
}

}  // namespace deliso

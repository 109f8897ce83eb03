#include "surface/mesh/axis_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "delaunay/predicates.h"

namespace deliso {

namespace {

int sign_of(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

// The orientation of a, b, p in the projection along x, with p moved by the steps of the header. 0 only where the edge
// ab is parallel to the line.
int projected_side(const Vec3& a, const Vec3& b, const Vec3& p) {
  if (const int exact = normal_sign(a, b, p, 0); exact != 0) return exact;
  if (a.z != b.z) return a.z > b.z ? 1 : -1;
  return a.y == b.y ? 0 : b.y > a.y ? 1 : -1;
}

// The x at which the plane of a triangle meets the line through p; it stays within the triangle's own x.
double x_in_plane(const std::array<Vec3, 3>& corners, const Vec3& p) {
  const auto& [a, b, c] = corners;
  const Vec3 normal = cross(b - a, c - a);
  const double x = a.x - (normal.y * (p.y - a.y) + normal.z * (p.z - a.z)) / normal.x;
  const auto [low, high] = std::minmax({a.x, b.x, c.x});
  return std::isfinite(x) ? std::clamp(x, low, high) : low + 0.5 * (high - low);
}

}  // namespace

AxisRays::AxisRays(const TriangleMesh& mesh) : mesh_(mesh) {
  constexpr double kMostColumns = 1024;  // along an axis
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) box_.extend(mesh.points[v]);
  }
  side_ =
      static_cast<std::size_t>(std::clamp(std::sqrt(static_cast<double>(mesh.triangles.size())), 1.0, kMostColumns));
  begin_.assign(side_ * side_ + 2, 0);
  if (mesh.triangles.empty()) return;
  const auto for_each_column = [&](std::size_t t, const auto& visit) {
    Box3 box;
    for (const std::uint32_t v : mesh.triangles[t]) box.extend(mesh.points[v]);
    for (std::size_t z = column_of(box.low.z, 2); z <= column_of(box.high.z, 2); ++z) {
      for (std::size_t y = column_of(box.low.y, 1); y <= column_of(box.high.y, 1); ++y) visit(z * side_ + y);
    }
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for_each_column(t, [&](std::size_t column) { ++begin_[column + 2]; });
  }
  for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  triangles_.resize(begin_.back());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for_each_column(t, [&](std::size_t column) { triangles_[begin_[column + 1]++] = static_cast<std::uint32_t>(t); });
  }
}

// Grows with the value, so that a point lies in a column between those of the corners around it.
std::size_t AxisRays::column_of(double value, std::size_t axis) const {
  const double extent = box_.high[axis] - box_.low[axis];
  const double place = extent > 0 ? (value - box_.low[axis]) / extent * static_cast<double>(side_) : 0;
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(side_ - 1)));
}

bool AxisRays::may_touch(const Vec3& p) const {
  const std::size_t column = column_of(p.z, 2) * side_ + column_of(p.y, 1);
  for (std::size_t i = begin_[column]; i < begin_[column + 1]; ++i) {
    const auto& [a, b, c] = mesh_.triangles[triangles_[i]];
    Box3 box;
    for (const std::uint32_t v : {a, b, c}) box.extend(mesh_.points[v]);
    if (box.contains(p) && orient3d(mesh_.points[a], mesh_.points[b], mesh_.points[c], p) == 0) return true;
  }
  return false;
}

void AxisRays::cross(const Vec3& p, std::vector<AxisCrossing>& out) const {
  out.clear();
  const std::size_t column = column_of(p.z, 2) * side_ + column_of(p.y, 1);
  for (std::size_t i = begin_[column]; i < begin_[column + 1]; ++i) {
    const auto& triangle = mesh_.triangles[triangles_[i]];
    const std::array<Vec3, 3> corners = {mesh_.points[triangle[0]], mesh_.points[triangle[1]],
                                         mesh_.points[triangle[2]]};
    const auto& [a, b, c] = corners;
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const auto [low_z, high_z] = std::minmax({a.z, b.z, c.z});
    if (p.y < low_y || p.y > high_y || p.z < low_z || p.z > high_z) continue;
    const int side = projected_side(a, b, p);
    if (side == 0 || projected_side(b, c, p) != side || projected_side(c, a, p) != side) continue;
    // The point is before the triangle where it lies on the side away from the normal's x.
    const int place = -side * sign_of(orient3d(a, b, c, p));
    out.push_back({triangles_[i], side, place, x_in_plane(corners, p)});
  }
  std::sort(out.begin(), out.end(), [](const AxisCrossing& s, const AxisCrossing& t) {
    return std::tie(s.x, s.triangle) < std::tie(t.x, t.triangle);
  });
}

}  // namespace deliso

#include "surface/extract/pinch_directions.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

namespace deliso {

namespace {

// A direction is good when it makes at least this sine with every triangle of the fan.
constexpr double kLeastSine = 0.05;
constexpr int kSteps = 200;

Vec3 within_face(const Box3& box, const Vec3& at, Vec3 d) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (at[axis] == box.low[axis] || at[axis] == box.high[axis]) d[axis] = 0;
  }
  return d;
}

std::vector<Vec3> unit_normals(const SurfaceMesh& mesh, const PinchNeighbourhoods& around, std::uint32_t copy) {
  std::vector<Vec3> normals;
  for (const std::uint32_t t : around.fan(copy)) {
    if (!around.is_at(t, copy)) continue;
    const auto& v = mesh.triangles[t];
    const Vec3 n = cross(mesh.points[v[1]] - mesh.points[v[0]], mesh.points[v[2]] - mesh.points[v[0]]);
    if (norm(n) > 0) normals.push_back(1 / norm(n) * n);
  }
  return normals;
}

// A direction towards one side of all triangles with these normals. Perceptron: step towards the normal with the least
// sine.
std::optional<Vec3> direction(std::span<const Vec3> normals, double side, const Box3& box, const Vec3& at) {
  Vec3 sum;
  for (const Vec3& n : normals) sum += side * n;
  Vec3 d = within_face(box, at, sum);
  for (int step = 0; step < kSteps && norm(d) > 0; ++step) {
    d = d / norm(d);
    const auto least = std::min_element(normals.begin(), normals.end(), [&](const Vec3& a, const Vec3& b) {
      return side * dot(a, d) < side * dot(b, d);
    });
    const double sine = side * dot(*least, d);
    if (sine >= kLeastSine) return d;
    d += within_face(box, at, (2 * kLeastSine - sine) * (side * *least));
  }
  return std::nullopt;
}

}  // namespace

std::vector<Vec3> pinch_directions(const SurfaceMesh& mesh, const PinchNeighbourhoods& around, const Box3& box,
                                   std::uint32_t copy, bool is_stubborn) {
  const Vec3& at = mesh.points[copy];
  const std::vector<Vec3> normals = unit_normals(mesh, around, copy);
  std::vector<Vec3> directions;
  for (const double side : {1.0, -1.0}) {
    if (const auto d = direction(normals, side, box, at)) directions.push_back(*d);
  }
  if (directions.size() == 2 && !is_stubborn) return directions;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vec3 d = within_face(box, at, Vec3{z * 1.0, y * 1.0, x * 1.0});
        if (norm(d) > 0) directions.push_back(d / norm(d));
      }
    }
  }
  return directions;
}

}  // namespace deliso

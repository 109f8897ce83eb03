#include "surface/mesh/vertex_separation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

namespace deliso {

namespace {

// The vertices with the place of another, ascending.
std::vector<std::uint32_t> equal_vertices(std::span<const Vec3> places) {
  const auto coordinates = [&](std::uint32_t v) { return std::array{places[v].x, places[v].y, places[v].z}; };
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto of_a = coordinates(a), of_b = coordinates(b);
    return of_a != of_b ? of_a < of_b : a < b;
  });
  std::vector<std::uint32_t> equal;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_as_before = i > 0 && places[order[i - 1]] == places[order[i]];
    const bool is_as_next = i + 1 < order.size() && places[order[i + 1]] == places[order[i]];
    if (is_as_before || is_as_next) equal.push_back(order[i]);
  }
  std::sort(equal.begin(), equal.end());
  return equal;
}

}  // namespace

std::int64_t separate_equal_vertices(std::span<const Vec3> places, const Box3& box, SurfaceMesh& mesh) {
  constexpr double kShare = 1e-4, kLongest = 2e-4;  // of the way to the middle of its triangles; mesh-space units
  const std::vector<std::uint32_t> equal = equal_vertices(places);
  if (equal.empty()) return 0;
  std::vector<Vec3> sums(equal.size());
  std::vector<double> counts(equal.size(), 0.0);
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const std::uint32_t v : {a, b, c}) {
      const auto at = std::lower_bound(equal.begin(), equal.end(), v);
      if (at == equal.end() || *at != v) continue;
      const auto i = static_cast<std::size_t>(at - equal.begin());
      sums[i] += (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
      counts[i] += 1;
    }
  }
  for (std::size_t i = 0; i < equal.size(); ++i) {
    if (counts[i] == 0) continue;
    Vec3& p = mesh.points[equal[i]];
    Vec3 way = kShare * (sums[i] / counts[i] - p);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (p[axis] == box.low[axis] || p[axis] == box.high[axis]) way[axis] = 0;
    }
    const double length = norm(way);
    if (length > kLongest) way = (kLongest / length) * way;
    p = p + way;
  }
  return static_cast<std::int64_t>(equal.size());
}

}  // namespace deliso

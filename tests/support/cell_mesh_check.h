// Slow, plain checks of a mesh's geometry: every pair of triangles, and the side that a patch faces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/triangle_contact.h"
#include "volume/scalar_grid.h"

namespace deliso::test {

// The triangles without an area, and the pairs that meet beyond what they share (some of them more than once): sweeps
// along x, over the boxes in each column of unit squares that they meet.
inline int contacts(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  int count = 0;
  std::map<std::pair<long, long>, std::vector<std::pair<Box3, std::uint32_t>>> columns;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (!has_area(points[a], points[b], points[c])) {
      ++count;
      continue;
    }
    Box3 box;
    for (const std::uint32_t v : triangles[t]) box.extend(points[v]);
    for (long y = std::lround(std::floor(box.low.y)); static_cast<double>(y) <= box.high.y; ++y) {
      for (long z = std::lround(std::floor(box.low.z)); static_cast<double>(z) <= box.high.z; ++z) {
        columns[{y, z}].emplace_back(box, t);
      }
    }
  }
  for (auto& [place, boxes] : columns) {
    std::sort(boxes.begin(), boxes.end(), [](const auto& a, const auto& b) { return a.first.low.x < b.first.low.x; });
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = i + 1; j < boxes.size() && boxes[j].first.low.x <= boxes[i].first.high.x; ++j) {
        if (!boxes[i].first.meets(boxes[j].first)) continue;
        const auto contact = triangle_contact(points, triangles[boxes[i].second], triangles[boxes[j].second]);
        if (contact != TriangleContact::kNone) ++count;
      }
    }
  }
  return count;
}

// Whether a boundary edge of the mesh of a single cell, from a to b as its triangle has it, lies on a face of the cell
// with the higher values to its right when seen from outside: then the triangle is counterclockwise seen from the
// lower side. Both ends are crossings.
inline bool runs_along_higher_values(const ScalarGrid& cell, double isovalue, const Vec3& a, const Vec3& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a[axis] != b[axis] || (a[axis] != 0 && a[axis] != 1)) continue;
    Vec3 outwards;
    outwards[axis] = a[axis] == 0 ? -1 : 1;
    // The ends of a's grid edge.
    std::array<std::int32_t, 3> low{}, high{};
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = a[i] == 1 ? 1 : 0;
      high[i] = a[i] == 0 ? 0 : 1;
    }
    const bool is_high_above = cell.at(high[0], high[1], high[2]) > isovalue;
    const Vec3 along =
        Vec3{double(high[0]), double(high[1]), double(high[2])} - Vec3{double(low[0]), double(low[1]), double(low[2])};
    return dot(cross(b - a, outwards), along) * (is_high_above ? 1 : -1) > 0;
  }
  return false;
}

}  // namespace deliso::test

// How two triangles with small integer coordinates (below 2^15) meet, by exact separating planes: convex sets are
// disjoint when one of finitely many directions separates them strictly, and their relative interiors are when one
// separates them properly. Shares no idea with the interval test that it checks.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/triangle_contact.h"

namespace deliso::testing {

using IntPoint = std::array<std::int64_t, 3>;

inline IntPoint minus(const IntPoint& a, const IntPoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline IntPoint times(const IntPoint& a, const IntPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline bool is_zero(const IntPoint& a) { return a == IntPoint{0, 0, 0}; }

struct Meeting {
  bool have_common_points = true;
  bool have_common_inner_points = true;  // points of both relative interiors
};

// Two convex hulls of two or three points each. Facet normals of their Minkowski difference: the normals of either, the
// products of their edges and, when all lies in one plane, the normals of the edges within it.
inline Meeting meeting(const std::vector<IntPoint>& a, const std::vector<IntPoint>& b) {
  std::vector<IntPoint> edges, normals;
  for (const auto* hull : {&a, &b}) {
    for (std::size_t i = 0; i < hull->size(); ++i) edges.push_back(minus((*hull)[(i + 1) % hull->size()], (*hull)[i]));
    if (hull->size() == 3) normals.push_back(times(minus((*hull)[1], (*hull)[0]), minus((*hull)[2], (*hull)[0])));
  }
  std::vector<IntPoint> directions = normals;
  for (const IntPoint& e : edges) {
    for (const IntPoint& f : edges) directions.push_back(times(e, f));
    for (const IntPoint& n : normals) directions.push_back(times(n, e));
  }
  Meeting result;
  for (const IntPoint& d : directions) {
    if (is_zero(d)) continue;
    const auto range = [&](const std::vector<IntPoint>& points) {
      std::pair<std::int64_t, std::int64_t> r{0, 0};
      for (std::size_t i = 0; i < points.size(); ++i) {
        std::int64_t height = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) height += d[axis] * points[i][axis];
        r = i == 0 ? std::pair{height, height} : std::pair{std::min(r.first, height), std::max(r.second, height)};
      }
      return r;
    };
    const auto [low_a, high_a] = range(a);
    const auto [low_b, high_b] = range(b);
    if (high_a < low_b || high_b < low_a) return {false, false};
    const bool in_one_plane = low_a == high_a && low_b == high_b && low_a == low_b;
    if (!in_one_plane && (high_a <= low_b || high_b <= low_a)) result.have_common_inner_points = false;
  }
  return result;
}

// The answer that triangle_contact must give for two triangles of different vertices but `shared` common ones.
inline TriangleContact expected_contact(const std::array<IntPoint, 3>& s, const std::array<IntPoint, 3>& t,
                                        const std::array<std::uint32_t, 3>& vs,
                                        const std::array<std::uint32_t, 3>& vt) {
  const Meeting whole = meeting({s.begin(), s.end()}, {t.begin(), t.end()});
  if (whole.have_common_inner_points) return TriangleContact::kCrossing;
  std::vector<std::size_t> in_s, in_t;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (vs[i] == vt[j]) {
        in_s.push_back(i);
        in_t.push_back(j);
      }
    }
  }
  bool touching = false;
  if (in_s.empty()) touching = whole.have_common_points;
  if (in_s.size() == 1) {
    // A common point beyond the vertex lies on a ray that leaves one of the triangles through the opposite edge.
    const std::size_t i = in_s[0], j = in_t[0];
    touching = meeting({s[(i + 1) % 3], s[(i + 2) % 3]}, {t.begin(), t.end()}).have_common_points ||
               meeting({t[(j + 1) % 3], t[(j + 2) % 3]}, {s.begin(), s.end()}).have_common_points;
  }
  return touching ? TriangleContact::kTouching : TriangleContact::kNone;
}

}  // namespace deliso::testing

#include "volume/marching_cubes/hull_annulus.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <set>
#include <utility>

namespace deliso {

namespace {

using Corners = std::array<std::uint32_t, 3>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;  // directed

std::array<Edge, 3> edges_of(const Corners& t) { return {{{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}}}; }

// The points in the plane of the corners, one bit each, when all points lie on one side of it; else 0.
std::uint32_t facet_through(std::span<const Vec3> points, const Corners& corners, const ExactTests& tests) {
  std::uint32_t facet = 0;
  bool is_any_above = false, is_any_below = false;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double side = tests.orientation(points[corners[0]], points[corners[1]], points[corners[2]], points[p]);
    if (side == 0) facet |= 1u << p;
    is_any_above |= side > 0;
    is_any_below |= side < 0;
  }
  return is_any_above != is_any_below ? facet : 0;
}

// Appends the facet's polygon as a fan, counterclockwise seen from outside. Seen from outside, all of the facet lies to
// the left of each of its sides. Seen from a point of the hull beyond the facet's plane it lies to the right.
void append_fan(std::span<const Vec3> points, std::uint32_t facet, const ExactTests& tests,
                std::vector<Corners>& triangles) {
  const Vec3& inside = points[static_cast<std::size_t>(std::countr_one(facet))];
  const auto follows = [&](std::uint32_t p, std::uint32_t q) {
    for (std::uint32_t left = facet & ~(1u << p | 1u << q); left != 0; left &= left - 1) {
      const Vec3& r = points[static_cast<std::size_t>(std::countr_zero(left))];
      if (tests.orientation(points[p], points[q], r, inside) >= 0) return false;
    }
    return p != q;
  };
  const auto first = static_cast<std::uint32_t>(std::countr_zero(facet));
  std::vector<std::uint32_t> polygon{first};
  while (polygon.size() < static_cast<std::size_t>(std::popcount(facet))) {
    std::uint32_t rest = facet;
    while (rest != 0 && !follows(polygon.back(), static_cast<std::uint32_t>(std::countr_zero(rest)))) rest &= rest - 1;
    if (rest == 0) return;  // not all are corners of the hull
    polygon.push_back(static_cast<std::uint32_t>(std::countr_zero(rest)));
  }
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) triangles.push_back({first, polygon[i], polygon[i + 1]});
}

// The hull's boundary, counterclockwise seen from outside.
std::vector<Corners> hull_triangles(std::span<const Vec3> points, const ExactTests& tests) {
  const auto count = static_cast<std::uint32_t>(points.size());
  std::set<std::uint32_t> facets;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = i + 1; j < count; ++j) {
      for (std::uint32_t k = j + 1; k < count; ++k) facets.insert(facet_through(points, {i, j, k}, tests));
    }
  }
  facets.erase(0);
  std::vector<Corners> triangles;
  for (const std::uint32_t facet : facets) append_fan(points, facet, tests, triangles);
  return triangles;
}

std::set<Edge> edges_along(std::span<const std::uint32_t> polygon) {
  std::set<Edge> edges;
  for (std::size_t i = 0; i < polygon.size(); ++i) edges.insert({polygon[i], polygon[(i + 1) % polygon.size()]});
  return edges;
}

}  // namespace

std::vector<Corners> hull_annulus(std::span<const Vec3> points, std::span<const std::uint32_t> first,
                                  std::span<const std::uint32_t> second, const ExactTests& tests) {
  std::vector<Corners> hull = hull_triangles(points, tests);
  std::set<Edge> rims = edges_along(first);
  rims.merge(edges_along(second));
  for (int side = 0; side < 2; ++side) {
    // Flood fill from the first polygon, across all edges but those of the polygons.
    std::vector<Corners> part;
    std::set<Edge> entered{{first[0], first[1]}};
    for (bool has_grown = true; has_grown;) {
      const auto reached = std::partition(hull.begin(), hull.end(), [&](const Corners& t) {
        const auto edges = edges_of(t);
        return std::none_of(edges.begin(), edges.end(), [&](const Edge& e) { return entered.contains(e); });
      });
      has_grown = reached != hull.end();
      for (auto t = reached; t != hull.end(); ++t) {
        part.push_back(*t);
        for (const Edge& e : edges_of(*t)) {
          const Edge back{e.second, e.first};
          if (!rims.contains(e) && !rims.contains(back)) entered.insert(back);
        }
      }
      hull.erase(reached, hull.end());
    }
    std::set<Edge> edges;
    for (const Corners& t : part) {
      for (const Edge& e : edges_of(t)) edges.insert(e);
    }
    if (std::includes(edges.begin(), edges.end(), rims.begin(), rims.end())) return part;
    // The other side of the polygons: the whole hull seen from inside.
    hull = hull_triangles(points, tests);
    for (Corners& t : hull) std::swap(t[1], t[2]);
  }
  return {};
}

}  // namespace deliso

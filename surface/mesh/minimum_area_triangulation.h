// The triangulation of a closed polygon in space that has the least area (Barequet and Sharir, Filling gaps in the
// boundary of a polyhedron, 1995): by dynamic programming over the polygon's diagonals.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace deliso {

class MinimumAreaTriangulation {
 public:
  // For a polygon with so many corners, at least 3. area(i, k, j), for i < k < j, is the cost of the triangle with
  // these corners; it may be infinite. is_free(i, j) says whether a diagonal is allowed. Time grows with the cube of
  // the number of corners.
  template <class Area, class IsFree>
  MinimumAreaTriangulation(std::size_t corners, Area&& area, IsFree&& is_free);

  [[nodiscard]] bool exists() const { return area() < kInfinity; }
  // Infinite when there is none.
  [[nodiscard]] double area() const { return least_[at(0, corners_ - 1)]; }
  // The third corner of the triangle at the side or diagonal ij, between i and j. Precondition: ij belongs to the
  // triangulation.
  [[nodiscard]] std::size_t apex(std::size_t i, std::size_t j) const { return apex_[at(i, j)]; }
  // All triangles, with ascending corners. Precondition: exists().
  [[nodiscard]] std::vector<std::array<std::size_t, 3>> triangles() const;

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const { return i * corners_ + j; }

  std::size_t corners_;
  std::vector<double> least_;      // area of the polygon from i to j
  std::vector<std::size_t> apex_;  // of the triangle at ij in it
};

template <class Area, class IsFree>
MinimumAreaTriangulation::MinimumAreaTriangulation(std::size_t corners, Area&& area, IsFree&& is_free)
    : corners_(corners), least_(corners * corners, 0), apex_(corners * corners, 0) {
  for (std::size_t span = 2; span < corners; ++span) {
    for (std::size_t i = 0; i + span < corners; ++i) {
      const std::size_t j = i + span;
      least_[at(i, j)] = kInfinity;
      const bool is_side = span + 1 == corners;
      if (!is_side && !is_free(i, j)) continue;
      for (std::size_t k = i + 1; k < j; ++k) {
        const double sum = least_[at(i, k)] + least_[at(k, j)];
        if (!(sum < least_[at(i, j)])) continue;
        const double with_triangle = sum + area(i, k, j);
        if (!(with_triangle < least_[at(i, j)])) continue;
        least_[at(i, j)] = with_triangle;
        apex_[at(i, j)] = k;
      }
    }
  }
}

inline std::vector<std::array<std::size_t, 3>> MinimumAreaTriangulation::triangles() const {
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<std::array<std::size_t, 2>> open = {{0, corners_ - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j == i + 1) continue;
    const std::size_t k = apex(i, j);
    triangles.push_back({i, k, j});
    open.push_back({i, k});
    open.push_back({k, j});
  }
  return triangles;
}

}  // namespace deliso

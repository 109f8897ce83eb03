// The triangles that fill a polygon in space without further vertices, and are shaped best.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"

namespace deliso {

// The filling whose least quality (triangle_shape.h) is the largest, by dynamic programming over the diagonals (as
// Gilbert, 1979, and Klincsek, 1980, for the least length), in cubic time. Triangles may cross; they are as the polygon
// is directed.
class BestFilling {
 public:
  // Precondition: at least three corners.
  explicit BestFilling(std::span<const Vec3> polygon)
      : BestFilling(polygon, [](std::size_t, std::size_t) { return true; }) {}
  // Of the fillings whose diagonals, from corner i to corner j > i, are all free: is_free(i, j). The quality is 0 when
  // there is none.
  template <class IsFree>
  BestFilling(std::span<const Vec3> polygon, const IsFree& is_free)
      : size_(polygon.size()), best_(size_ * size_, 1), middle_(size_ * size_, 0) {
    for (std::size_t width = 2; width < size_; ++width) {
      for (std::size_t i = 0; i + width < size_; ++i) {
        find(polygon, i, i + width);
        const bool is_diagonal = width + 1 < size_;
        if (is_diagonal && !is_free(i, i + width)) best_[i * size_ + i + width] = 0;
      }
    }
  }

  [[nodiscard]] double quality() const { return best_[size_ - 1]; }
  // Corners of the polygon.
  [[nodiscard]] std::vector<std::array<std::size_t, 3>> triangles() const;

 private:
  void find(std::span<const Vec3> polygon, std::size_t i, std::size_t j);

  std::size_t size_;
  std::vector<double> best_;         // of the part of the polygon from i to j, at i * size_ + j
  std::vector<std::size_t> middle_;  // the third corner of its triangle at the diagonal from i to j
};

}  // namespace deliso

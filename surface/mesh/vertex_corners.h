// Which triangles have a corner at each vertex.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/check.h"

namespace deliso {

// A corner of a triangle: 4 * triangle + 0, 1 or 2.
using TriangleCorner = std::uint32_t;

class VertexCorners {
 public:
  using Triangles = std::span<const std::array<std::uint32_t, 3>>;

  // For the triangles t with takes_part(t). Precondition: indices below `vertices`, fewer than 2^30 triangles.
  template <class TakesPart>
  VertexCorners(std::size_t vertices, Triangles triangles, const TakesPart& takes_part) : begin_(vertices + 2) {
    DELISO_CHECK(triangles.size() < std::size_t{1} << 30, "numbers of corners fit into 32 bits");
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (!takes_part(t)) continue;
      for (const std::uint32_t v : triangles[t]) ++begin_[v + 2];
    }
    for (std::size_t v = 2; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    corners_.resize(begin_.back());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (!takes_part(t)) continue;
      for (std::uint32_t i = 0; i < 3; ++i) corners_[begin_[triangles[t][i] + 1]++] = 4 * t + i;
    }
  }

  // The corners at a vertex, in the order of the triangles.
  [[nodiscard]] std::span<const TriangleCorner> at(std::size_t v) const {
    return std::span(corners_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
  }

 private:
  std::vector<std::uint32_t> begin_;
  std::vector<TriangleCorner> corners_;
};

}  // namespace deliso

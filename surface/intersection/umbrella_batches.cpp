#include "surface/intersection/umbrella_batches.h"

#include <algorithm>

namespace deliso {

namespace {

constexpr std::uint32_t kNoRow = 0xFFFFFFFFU;
constexpr std::size_t kMostLookedAt = 16;  // corners of a vertex examined

class RowMaker {
 public:
  RowMaker(VertexCorners::Triangles triangles, const VertexCorners& corners, std::size_t vertices)
      : triangles_(triangles), corners_(corners), row_of_(triangles.size(), kNoRow), is_taken_(vertices) {
    rows_.reserve(triangles.size() / (kTrianglesPerBatch - 2));
  }

  [[nodiscard]] bool is_left(std::size_t t) const { return row_of_[t] == kNoRow; }

  // Makes a row of the umbrella of a vertex, if none of its triangles is in a row yet. Call before take_triangle().
  void take_umbrella(std::uint32_t v) {
    if (is_taken_[v] != 0) return;
    const auto corners = corners_.at(v);
    if (corners.empty() || corners.size() > kTrianglesPerBatch) return;
    begin_row(v);
    for (const TriangleCorner corner : corners) {
      append(static_cast<std::uint32_t>(rows_.size() - 1), corner >> 2);
      for (const std::uint32_t w : triangles_[corner >> 2]) is_taken_[w] = 1;
    }
  }

  // Puts a triangle into a row that has room and a triangle at one of its vertices, or into a new row.
  void take_triangle(std::uint32_t t) {
    for (const std::uint32_t v : triangles_[t]) {
      const auto corners = corners_.at(v);
      for (const TriangleCorner corner : corners.first(std::min(corners.size(), kMostLookedAt))) {
        const std::uint32_t row = row_of_[corner >> 2];
        if (row != kNoRow && rows_[row].count < kTrianglesPerBatch) return append(row, t);
      }
    }
    begin_row(triangles_[t][0]);
    append(static_cast<std::uint32_t>(rows_.size() - 1), t);
  }

  [[nodiscard]] std::vector<UmbrellaBatch> rows() && { return std::move(rows_); }

 private:
  void begin_row(std::uint32_t v) {
    rows_.emplace_back();
    rows_.back().vertex = v;
  }
  void append(std::uint32_t row, std::uint32_t t) {
    rows_[row].triangles[rows_[row].count++] = t;
    row_of_[t] = row;
  }

  VertexCorners::Triangles triangles_;
  const VertexCorners& corners_;
  std::vector<std::uint32_t> row_of_;
  std::vector<std::uint8_t> is_taken_;  // of each vertex: whether a triangle of its umbrella is in a row
  std::vector<UmbrellaBatch> rows_;
};

}  // namespace

std::vector<UmbrellaBatch> umbrella_batches(VertexCorners::Triangles triangles,
                                            std::span<const std::uint8_t> takes_part, const VertexCorners& corners,
                                            std::size_t vertices) {
  RowMaker maker(triangles, corners, vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) maker.take_umbrella(v);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (takes_part[t] != 0 && maker.is_left(t)) maker.take_triangle(t);
  }
  return std::move(maker).rows();
}

}  // namespace deliso

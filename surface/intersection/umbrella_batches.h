// The triangles of a mesh in rows of eight at most, each as a rule the umbrella of one vertex.
//
// Umbrellas of vertices that are no neighbours share no triangle, and as many as fit cover most of a mesh. What is left
// over fills up rows beside it. So rows are small in space, there is little more of them than must be, and the
// triangles of a row have nearly all a vertex in common.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/mesh/vertex_corners.h"

namespace deliso {

inline constexpr std::size_t kTrianglesPerBatch = 8;

struct UmbrellaBatch {
  std::array<std::uint32_t, kTrianglesPerBatch> triangles{};
  std::uint32_t count = 0;
  std::uint32_t vertex = 0;  // of the first triangle
};

// Rows of the triangles that takes_part[t] names (not 0), each in one of them. Precondition: `corners` are theirs.
std::vector<UmbrellaBatch> umbrella_batches(VertexCorners::Triangles triangles,
                                            std::span<const std::uint8_t> takes_part, const VertexCorners& corners,
                                            std::size_t vertices);

}  // namespace deliso

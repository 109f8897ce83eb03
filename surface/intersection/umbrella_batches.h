// The triangles of a mesh in rows of at most eight, most rows being the umbrella of one vertex.
//
// Umbrellas of vertices that are no neighbours share no triangle, and a maximal set of such umbrellas covers most of a
// mesh. The remaining triangles fill up neighbouring rows. So rows are small in space, there are few more rows than
// necessary, and nearly all triangles of a row share a vertex.
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

// Rows of the triangles with takes_part[t] not 0, each in one row. Precondition: `corners` are those of these
// triangles.
std::vector<UmbrellaBatch> umbrella_batches(VertexCorners::Triangles triangles,
                                            std::span<const std::uint8_t> takes_part, const VertexCorners& corners,
                                            std::size_t vertices);

}  // namespace deliso

// Vertices around which nothing can meet: their triangles, seen along a coordinate axis, lie side by side.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"
#include "surface/mesh/vertex_corners.h"

namespace deliso {

// How a triangle abc lies in the projections along the three axes, in bits.
class ProjectedTriangle {
 public:
  ProjectedTriangle() = default;
  // Precondition: coordinates as orient3d wants them (delaunay/predicates.h).
  ProjectedTriangle(const Vec3& a, const Vec3& b, const Vec3& c);

  // Bits k and 3 + k: seen along axis k it is certainly counterclockwise, or clockwise. If any is set it has an area.
  [[nodiscard]] std::uint32_t senses() const { return bits_ & 63u; }
  // Bits 0 and 1: of the two other corners one is below corner i along the x axis (the y axis), and one is not.
  [[nodiscard]] std::uint32_t straddles(std::uint32_t i) const { return bits_ >> (6 + 2 * i) & 3u; }

 private:
  std::uint16_t bits_ = 0;
};

// Of each vertex, whether its triangles close up to one fan, each next to the one before it at an edge, that goes
// around the vertex once in the projection along some coordinate axis, every triangle in the same sense. Then of two of
// them the projections have only the projection of what they share in common, and so have the triangles themselves.
// Certain where it is 1; 0 says nothing. `projected`: of each triangle.
std::vector<std::uint8_t> injective_umbrellas(VertexCorners::Triangles triangles,
                                              std::span<const ProjectedTriangle> projected,
                                              const VertexCorners& corners, std::size_t vertices, int threads = 1);

}  // namespace deliso

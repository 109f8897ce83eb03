// Vertices whose umbrella is injective in the projection along some coordinate axis: no two of its triangles meet
// beyond what they share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"
#include "surface/mesh/vertex_corners.h"

namespace deliso {

// The orientation of a triangle abc in the projections along the three axes, as bits.
class ProjectedTriangle {
 public:
  ProjectedTriangle() = default;
  // Precondition: coordinates as orient3d wants them (delaunay/predicates.h).
  ProjectedTriangle(const Vec3& a, const Vec3& b, const Vec3& c);

  // Bits k and 3 + k: in the projection along axis k it is certainly counterclockwise, or clockwise. If any bit is set
  // the triangle has an area.
  [[nodiscard]] std::uint32_t senses() const { return bits_ & 63u; }
  // Bits 0 and 1: along the x axis (the y axis), one of the two other corners lies below corner i, and the other does
  // not.
  [[nodiscard]] std::uint32_t straddles(std::uint32_t i) const { return bits_ >> (6 + 2 * i) & 3u; }

 private:
  std::uint16_t bits_ = 0;
};

// For each vertex: 1 when its triangles certainly form one closed fan that, in the projection along some coordinate
// axis, goes around the vertex exactly once, with every triangle in the same orientation. Then the projections of two
// of these triangles meet only in the projection of what they share, and so the triangles meet only in what they share.
// 0 says nothing. `projected`: of each triangle.
std::vector<std::uint8_t> injective_umbrellas(VertexCorners::Triangles triangles,
                                              std::span<const ProjectedTriangle> projected,
                                              const VertexCorners& corners, std::size_t vertices, int threads = 1);

}  // namespace deliso

#include "surface/intersection/injective_umbrellas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "delaunay/base/parallel.h"

namespace deliso {

namespace {

using Triangles = VertexCorners::Triangles;

constexpr std::size_t kMostTriangles = 16;  // vertices with more triangles are not examined
constexpr std::size_t kMostTasks = 16, kFewestVertices = 8192;

// Examines one vertex after the other.
class VertexExamination {
 public:
  VertexExamination(Triangles triangles, std::span<const ProjectedTriangle> projected, std::size_t vertices)
      : triangles_(triangles), projected_(projected), place_(vertices) {}

  // In the projection along an axis in which all triangles have the same orientation, each edge of the link turns
  // around the vertex by less than half a turn. With every full turn the edges cross a line through the vertex twice.
  // So if they cross it twice, the link is a single closed walk around the vertex.
  bool is_laid_out(std::span<const TriangleCorner> corners) {
    constexpr std::array<std::size_t, 3> kNext = {1, 2, 0}, kPrevious = {2, 0, 1};
    if (corners.size() < 3 || corners.size() > kMostTriangles) return false;
    std::array<std::uint32_t, kMostTriangles> begins{}, ends{};
    std::uint32_t senses = 63, changes = 0;  // eight bits for each axis
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t t = corners[i] >> 2, corner = corners[i] & 3;
      const std::uint32_t straddles = projected_[t].straddles(corner);
      senses &= projected_[t].senses();
      changes += (straddles & 1) | (straddles & 2) << 7;
      begins[i] = triangles_[t][kNext[corner]];
      ends[i] = triangles_[t][kPrevious[corner]];
      place_[begins[i]] = static_cast<std::uint8_t>(i);
    }
    const bool is_twice_along_x = (changes & 255) == 2, is_twice_along_y = changes >> 8 == 2;
    const std::uint32_t once_around = (is_twice_along_x ? 6U : 0U) | (is_twice_along_y ? 1U : 0U);
    if (((senses | senses >> 3) & once_around) == 0) return false;

    // The edges form a closed walk when each end of an edge is the beginning of exactly one edge.
    std::uint32_t seen = 0, others = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t place = place_[ends[i]];
      others |= begins[place] ^ ends[i];
      seen |= 1U << place;
    }
    return others == 0 && seen == (1U << corners.size()) - 1;
  }

 private:
  Triangles triangles_;
  std::span<const ProjectedTriangle> projected_;
  std::vector<std::uint8_t> place_;  // for each vertex: index of the last edge that began there, below kMostTriangles
};

}  // namespace

ProjectedTriangle::ProjectedTriangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  // The error of a determinant of rounded differences (Shewchuk 1997); the summand covers products that underflow.
  constexpr double kRelative = 3.3306690738754716e-16, kUnderflow = 1e-300;
  const Vec3 p = a - c, q = b - c;
  const auto senses_along = [&](std::size_t axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double left = p[u] * q[v], right = p[v] * q[u];
    const double determinant = left - right, error = kRelative * (std::abs(left) + std::abs(right)) + kUnderflow;
    return ((determinant > error ? 1U : 0U) | (determinant < -error ? 8U : 0U)) << axis;
  };
  const auto straddles_along = [](double x, double y, double z) {
    const auto is_below = [](double s, double t) { return s < t ? 1U : 0U; };
    return (is_below(y, x) ^ is_below(z, x)) | (is_below(z, y) ^ is_below(x, y)) << 2 |
           (is_below(x, z) ^ is_below(y, z)) << 4;
  };
  bits_ = static_cast<std::uint16_t>(senses_along(0) | senses_along(1) | senses_along(2) |
                                     straddles_along(a.x, b.x, c.x) << 6 | straddles_along(a.y, b.y, c.y) << 7);
}

std::vector<std::uint8_t> injective_umbrellas(Triangles triangles, std::span<const ProjectedTriangle> projected,
                                              const VertexCorners& corners, std::size_t vertices, int threads) {
  std::vector<std::uint8_t> laid_out(vertices);
  const std::size_t per_task = std::max(kFewestVertices, vertices / kMostTasks + 1);
  run_tasks((vertices + per_task - 1) / per_task, threads, [&](std::size_t task) {
    VertexExamination examination(triangles, projected, vertices);
    const std::size_t end = std::min((task + 1) * per_task, vertices);
    for (std::size_t v = task * per_task; v < end; ++v) {
      laid_out[v] = examination.is_laid_out(corners.at(v)) ? 1 : 0;
    }
  });
  return laid_out;
}

}  // namespace deliso

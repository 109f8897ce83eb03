// Points that a mesh goes through, sorted into blocks of space, to find those near a place and to go through them so
// that neighbours follow one another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "surface/mesh/surface_mesh.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/point_grid.h"

namespace deliso {

// Edges longer than this many reaches may pass a point whose surroundings hold none of their ends.
inline constexpr double kLongEdge = 2;

inline double squared_distance_to(const Vec3& p, const SurfaceMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return squared_distance_to_triangle(p, mesh.points[a], mesh.points[b], mesh.points[c]);
}

// Points of the mesh block by block, each with a triangle that it lies on: all vertices, and the centroids of long
// triangles. Nearly all crossings are near such a point, and most others near one of these triangles.
class MeshPoints {
 public:
  // `long_triangles`: all triangles that have an edge longer than kLongEdge reaches.
  MeshPoints(const SurfaceMesh& mesh, double reach, std::vector<std::uint32_t> long_triangles)
      : mesh_(mesh), reach_(reach), long_triangles_(std::move(long_triangles)) {
    const std::size_t vertices = mesh.points.size();
    std::vector<std::uint32_t> triangle_of(vertices, kNone);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) triangle_of[v] = t;
    }
    triangle_of.insert(triangle_of.end(), long_triangles_.begin(), long_triangles_.end());
    const auto point = [&](std::size_t i) {
      if (i < vertices) return mesh.points[i];
      const auto& [a, b, c] = mesh.triangles[long_triangles_[i - vertices]];
      return (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
    };
    blocks_ = PointGrid(triangle_of.size(), point, 2 * reach);
    points_.reserve(triangle_of.size());
    triangle_at_.reserve(triangle_of.size());
    for (const std::uint32_t i : blocks_.order()) {
      points_.push_back(point(i));
      triangle_at_.push_back(triangle_of[i]);
    }
  }

  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }
  [[nodiscard]] double reach() const { return reach_; }
  [[nodiscard]] const std::vector<std::uint32_t>& long_triangles() const { return long_triangles_; }
  // Numbers of vertices, block by block, with those of centroids among them, from the number of vertices on.
  [[nodiscard]] std::span<const std::uint32_t> order() const { return blocks_.order(); }
  // Whether a triangle is seen to be within reach of p. False tells nothing.
  [[nodiscard]] bool cover(const Vec3& p) const {
    const auto is_near = [&](std::uint32_t place) {
      return squared_distance(p, points_[place]) <= reach_ * reach_ && triangle_at_[place] != kNone;
    };
    if (blocks_.any_place_beside(p, is_near)) return true;
    const Box3 around{p - Vec3{reach_, reach_, reach_}, p + Vec3{reach_, reach_, reach_}};
    if (blocks_.any_place_near(around, is_near)) return true;
    return blocks_.any_place_near(around, [&](std::uint32_t place) {
      const std::uint32_t t = triangle_at_[place];
      return t != kNone && squared_distance_to(p, mesh_, t) <= reach_ * reach_;
    });
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  const SurfaceMesh& mesh_;
  double reach_;
  std::vector<std::uint32_t> long_triangles_;
  PointGrid blocks_;
  std::vector<Vec3> points_;                // block by block
  std::vector<std::uint32_t> triangle_at_;  // that each of these lies on
};

}  // namespace deliso

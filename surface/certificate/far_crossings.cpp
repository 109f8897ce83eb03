#include "surface/certificate/far_crossings.h"

#include <atomic>
#include <cstddef>

#include "surface/base/parallel_blocks.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/occupied_blocks.h"
#include "surface/search/point_grid.h"

namespace deliso {

namespace {

constexpr double kBlock = 3.1;  // side of the blocks around crossings that are left, in reaches

double squared_distance_to(const Vec3& p, const SurfaceMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return squared_distance_to_triangle(p, mesh.points[a], mesh.points[b], mesh.points[c]);
}

// Points of the mesh block by block, each with a triangle that it lies on: all vertices, and the centroids of long
// triangles. Nearly all crossings are near such a point, and most others near one of these triangles.
class MeshPoints {
 public:
  MeshPoints(const SurfaceMesh& mesh, double reach, const std::vector<std::uint32_t>& long_triangles)
      : mesh_(mesh), reach_(reach), triangle_of_(mesh.points.size(), kNone) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) triangle_of_[v] = t;
    }
    triangle_of_.insert(triangle_of_.end(), long_triangles.begin(), long_triangles.end());
    const auto point = [&](std::size_t i) {
      if (i < mesh.points.size()) return mesh.points[i];
      const auto& [a, b, c] = mesh.triangles[long_triangles[i - mesh.points.size()]];
      return (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
    };
    blocks_ = PointGrid(triangle_of_.size(), point, 2 * reach);
    points_.reserve(triangle_of_.size());
    for (const std::uint32_t i : blocks_.order()) points_.push_back(point(i));
  }

  // Whether a triangle is seen to be within reach of p. False tells nothing.
  [[nodiscard]] bool cover(const Vec3& p) const {
    const auto is_near = [&](std::uint32_t place) {
      return squared_distance(p, points_[place]) <= reach_ * reach_ && triangle_at(place) != kNone;
    };
    if (blocks_.any_place_beside(p, is_near)) return true;
    const Box3 around{p - Vec3{reach_, reach_, reach_}, p + Vec3{reach_, reach_, reach_}};
    if (blocks_.any_place_near(around, is_near)) return true;
    return blocks_.any_place_near(around, [&](std::uint32_t place) {
      const std::uint32_t t = triangle_at(place);
      return t != kNone && squared_distance_to(p, mesh_, t) <= reach_ * reach_;
    });
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  [[nodiscard]] std::uint32_t triangle_at(std::uint32_t place) const { return triangle_of_[blocks_.order()[place]]; }

  const SurfaceMesh& mesh_;
  double reach_;
  std::vector<std::uint32_t> triangle_of_;
  PointGrid blocks_;
  std::vector<Vec3> points_;  // block by block
};

// The crossings that a look beside them leaves open.
std::vector<Vec3> crossings_to_ask_for(const SurfaceMesh& mesh, const ExactSurface& surface, double reach,
                                       const std::vector<std::uint32_t>& long_triangles) {
  const MeshPoints points(mesh, reach, long_triangles);
  const auto& crossings = surface.topology.crossings;
  return collect_in_blocks<Vec3>(crossings.size(), surface.threads, [&](std::size_t i, std::vector<Vec3>& left) {
    if (!surface.wants(crossings[i])) return;
    const Vec3 p = surface.position(crossings[i]);
    if (!points.cover(p)) left.push_back(p);
  });
}

}  // namespace

std::vector<Vec3> far_crossings(const SurfaceMesh& mesh, const ExactSurface& surface, double reach,
                                const std::vector<std::uint32_t>& long_triangles) {
  const std::vector<Vec3> points = crossings_to_ask_for(mesh, surface, reach, long_triangles);
  if (points.empty()) return {};
  // What is left is asked of all triangles that are near it by a corner, and of those that need not be. Blocks reach
  // farther than a long edge and `reach` together.
  const OccupiedBlocks near_blocks(points, kBlock * reach);
  const PointGrid grid(points, reach);
  std::vector<std::uint8_t> is_covered(points.size(), 0), is_near(mesh.points.size());
  for_each_block(is_near.size(), surface.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) is_near[v] = near_blocks.is_near(mesh.points[v]) ? 1 : 0;
  });
  const auto cover_by = [&](std::uint32_t t) {
    const Vec3 around{reach, reach, reach};
    const Box3 box = box_of(mesh, t);
    grid.for_each_near({box.low - around, box.high + around}, [&](std::uint32_t i) {
      const std::atomic_ref covered(is_covered[i]);
      if (covered.load(std::memory_order_relaxed) != 0) return;
      if (squared_distance_to(points[i], mesh, t) <= reach * reach) covered.store(1, std::memory_order_relaxed);
    });
  };
  const auto is_corner_near = [&](std::uint32_t t) { return is_near[mesh.triangles[t][0]] != 0; };
  for_each_block(mesh.triangles.size(), surface.threads, [&](std::size_t first, std::size_t last) {
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      if (is_corner_near(t)) cover_by(t);
    }
  });
  for_each_block(long_triangles.size(), surface.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (!is_corner_near(long_triangles[i])) cover_by(long_triangles[i]);
    }
  });
  std::vector<Vec3> far;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_covered[i] == 0) far.push_back(points[i]);
  }
  return far;
}

}  // namespace deliso

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

struct OpenCrossing {
  std::uint32_t number;
  Vec3 position;
};

// Of the crossings asked for those that a look beside them leaves open.
std::vector<OpenCrossing> crossings_left_open(const MeshPoints& points, const ExactSurface& surface,
                                              const std::optional<std::span<const std::uint32_t>>& asked) {
  const auto& crossings = surface.topology.crossings;
  const auto append_if_open = [&](std::size_t i, std::vector<OpenCrossing>& left) {
    const std::uint32_t number = asked ? (*asked)[i] : static_cast<std::uint32_t>(i);
    if (!surface.wants(crossings[number])) return;
    const Vec3 p = surface.position(crossings[number]);
    if (!points.cover(p)) left.push_back({number, p});
  };
  return collect_in_blocks<OpenCrossing>(asked ? asked->size() : crossings.size(), surface.threads, append_if_open);
}

}  // namespace

std::vector<std::uint32_t> far_crossings(const MeshPoints& mesh_points, const ExactSurface& surface,
                                         std::optional<std::span<const std::uint32_t>> asked) {
  const SurfaceMesh& mesh = mesh_points.mesh();
  const double reach = mesh_points.reach();
  const std::vector<std::uint32_t>& long_triangles = mesh_points.long_triangles();
  const std::vector<OpenCrossing> open = crossings_left_open(mesh_points, surface, asked);
  if (open.empty()) return {};
  std::vector<Vec3> points;
  points.reserve(open.size());
  for (const OpenCrossing& crossing : open) points.push_back(crossing.position);
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
  std::vector<std::uint32_t> far;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_covered[i] == 0) far.push_back(open[i].number);
  }
  return far;
}

}  // namespace deliso

#include "surface/repair/finish/missed_crossings.h"

#include <algorithm>
#include <cmath>

#include "surface/search/box_tree.h"
#include "surface/search/coverage_query.h"
#include "surface/search/covering_triangles.h"

namespace deliso {

namespace {

constexpr std::int32_t kLayers = 3;  // of cells around a crossing

}  // namespace

std::vector<std::uint32_t> missed_crossings(const SurfaceMesh& mesh, std::span<const Box3> boxes,
                                            const ExactSurface& surface) {
  if (boxes.empty()) return {};
  const IsosurfaceTopology& topology = surface.topology;
  const BoxTree tree(boxes);
  std::vector<std::uint32_t> inside;
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < topology.crossings.size(); ++i) {
    const Vec3 p = surface.position(topology.crossings[i]);
    bool is_inside = false;
    tree.for_each_meeting({p, p}, [&](std::uint32_t) { is_inside = true; });
    if (!is_inside) continue;
    inside.push_back(i);
    points.push_back(p);
  }
  // Most crossings have a triangle close by. Only for the others a tree of all triangles is worth its cost.
  const auto any = [](std::uint32_t) { return true; };
  const std::vector<std::uint32_t> covering = covering_triangles(points, mesh, any, surface.threads);
  if (std::find(covering.begin(), covering.end(), kNoTriangle) == covering.end()) return {};
  const CoverageQuery cover(mesh, surface.threads);
  std::vector<std::uint32_t> missed;
  std::uint32_t guess = 0;
  for (std::size_t k = 0; k < inside.size(); ++k) {
    if (covering[k] == kNoTriangle && !cover.covers(points[k], guess)) missed.push_back(inside[k]);
  }
  return missed;
}

std::vector<CellName> cells_around(std::span<const std::uint32_t> crossings, const ExactSurface& surface,
                                   const CellLevels& cells) {
  const ScalarGrid& grid = surface.grid();
  const IsosurfaceTopology& topology = surface.topology;
  std::vector<CellName> found;
  for (const std::uint32_t crossing : crossings) {
    const Vec3 p = crossing_position(grid, topology.crossings[crossing]);
    CellIndex low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto layer = static_cast<std::int32_t>(std::floor(p[axis]));
      low[axis] = layer - kLayers;
      high[axis] = layer + kLayers;
    }
    cells.append_active_cells(topology.index, low, high, found);
  }
  return found;
}

}  // namespace deliso

#include "surface/sizes/witnesses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "raycast/voxel_intersection.h"
#include "surface/base/parallel_blocks.h"
#include "surface/certificate/cells/missed_places.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/box_tree.h"

namespace deliso {

namespace {

double squared_distance_from(const Vec3& p, const Patch& mesh, std::uint32_t triangle) {
  const auto [a, b, c] = mesh.corner_points(triangle);
  return squared_distance_to_triangle(p, a, b, c);
}

// Appends the points at which the isosurface crosses the edges of a grid so many times as fine, in one cell; not those
// on edges of the cell, and those on a face once.
void append_crossings_within(const CellIndex& cell, const Isosurface& isosurface, int times,
                             std::vector<Vec3>& points) {
  const CellCorners field = relative_to(isosurface.grid().cell(cell[0], cell[1], cell[2]), isosurface.isovalue());
  const Vec3 low{double(cell[0]), double(cell[1]), double(cell[2])};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < times; ++i) {
      for (int j = i == 0 ? 1 : 0; j < times; ++j) {
        Vec3 p;
        p[u] = double(i) / times;
        p[v] = double(j) / times;
        double before = relative_value(field, p);
        for (int k = 1; k <= times; ++k) {
          p[axis] = double(k) / times;
          const double value = relative_value(field, p);
          if ((value >= 0) != (before >= 0)) {
            Vec3 crossing = p;
            crossing[axis] = (k - 1 + before / (before - value)) / times;
            points.push_back(scaled(isosurface.step(), low + crossing));
          }
          before = value;
        }
      }
    }
  }
}

// What has to stay near the mesh beside its own vertices.
std::vector<Vec3> points_of(const ExactSurface& surface, double reach) {
  std::vector<Vec3> points;
  for (const EdgeCrossing& crossing : surface.topology.crossings) {
    if (surface.wants(crossing)) points.push_back(surface.position(crossing));
  }
  constexpr double kLarge = 0.75;   // voxels
  constexpr double kSpacing = 2.5;  // of the finer grid, in reaches
  if (reach >= kLarge) return points;
  const int times = static_cast<int>(std::clamp(std::ceil(1 / (kSpacing * reach)), 2.0, 4.0));
  for (const std::uint64_t cell : crossed_cells(surface)) {
    append_crossings_within(sample_of({cell, 0, 0, 0}, surface.grid().dims()), surface.isosurface, times, points);
  }
  if (!surface.is_dropped.empty()) {
    std::erase_if(points, [&](const Vec3& p) {
      const auto component = surface.component_at(p);
      return component && surface.is_dropped[*component] != 0;
    });
  }
  return points;
}

}  // namespace

Witnesses::Witnesses(const Patch& mesh, const ExactSurface& surface, double reach, std::span<const Vec3> others)
    : points_(mesh.points()) {
  const std::size_t vertices = points_.size();
  std::vector<Vec3> points = points_of(surface, reach);
  points.insert(points.end(), others.begin(), others.end());
  points_.insert(points_.end(), points.begin(), points.end());
  next_.assign(points_.size(), kNone);
  first_.assign(mesh.triangle_count(), kNone);
  const BoxTree tree(
      mesh.triangle_count(), [&](std::size_t t) { return mesh.box_of(static_cast<std::uint32_t>(t)); },
      surface.threads);
  std::vector<std::uint32_t> nearest(points.size());
  for_each_block(points.size(), surface.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      nearest[i] = tree.nearest(points[i], reach * reach,
                                [&](std::uint32_t t) { return squared_distance_from(points[i], mesh, t); })
                       .first;
    }
  });
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (nearest[i] != BoxTree::kNone) give(static_cast<std::uint32_t>(vertices + i), nearest[i]);
  }
}

void Witnesses::give(std::uint32_t witness, std::uint32_t triangle) {
  next_[witness] = first_[triangle];
  first_[triangle] = witness;
}

void Witnesses::pass_on(std::span<const std::uint32_t> removed, std::uint32_t vertex, std::uint32_t first_added,
                        const Patch& mesh) {
  first_.resize(mesh.triangle_count(), kNone);
  const auto give_to_nearest = [&](std::uint32_t witness) {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = first_added;
    for (std::uint32_t t = first_added; t < mesh.triangle_count(); ++t) {
      const double squared = squared_distance_from(points_[witness], mesh, t);
      if (squared < least) {
        least = squared;
        nearest = t;
      }
    }
    give(witness, nearest);
  };
  for (const std::uint32_t t : removed) {
    for (std::uint32_t w = std::exchange(first_[t], kNone); w != kNone;) {
      const std::uint32_t next = next_[w];
      give_to_nearest(w);
      w = next;
    }
  }
  give_to_nearest(vertex);
}

}  // namespace deliso

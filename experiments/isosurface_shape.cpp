#include "experiments/isosurface_shape.h"

#include <algorithm>

namespace deliso {
namespace {

// All voxel cells whose samples lie on both sides, as one box in the world.
Box3 box_of_cells(const ScalarGrid& grid, double isovalue) {
  Box3 box;
  const Dims& dims = grid.dims();
  const auto world = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
    return grid.origin() +
           scaled(grid.spacing(), Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
  };
  // A cell with samples on both sides has an edge with them: the edges of all cells are enough.
  visit_samples(grid.samples(), [&](const auto& samples) {
    for (std::int32_t k = 0; k < dims[2]; ++k) {
      for (std::int32_t j = 0; j < dims[1]; ++j) {
        for (std::int32_t i = 0; i < dims[0]; ++i) {
          const auto above = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
            return static_cast<double>(samples[grid.index(a, b, c)]) >= isovalue;
          };
          const bool here = above(i, j, k);
          const bool crossed = (i + 1 < dims[0] && above(i + 1, j, k) != here) ||
                               (j + 1 < dims[1] && above(i, j + 1, k) != here) ||
                               (k + 1 < dims[2] && above(i, j, k + 1) != here);
          if (!crossed) continue;
          box.extend(world(std::max(i - 1, 0), std::max(j - 1, 0), std::max(k - 1, 0)));
          box.extend(world(std::min(i + 1, dims[0] - 1), std::min(j + 1, dims[1] - 1), std::min(k + 1, dims[2] - 1)));
        }
      }
    }
  });
  return box;
}

SearchOptions search_options() {
  SearchOptions options;
  options.traversal = Traversal::kKdTree;  // rays through the whole volume cross much empty space
  return options;
}

}  // namespace

IsosurfaceShape::IsosurfaceShape(const ScalarGrid& grid, double isovalue)
    : surface_(grid, isovalue, search_options()),
      volume_box_(grid.box()),
      unit_(std::min({grid.spacing().x, grid.spacing().y, grid.spacing().z})),
      box_(box_of_cells(grid, isovalue)) {}

std::optional<SurfacePoint> IsosurfaceShape::first_hit(const Line& ray, double t0, double t1) const {
  const std::optional<RayPart> part = part_in_box(ray, volume_box_);
  if (!part) return std::nullopt;
  const double first = std::max(t0, part->first);
  const double last = std::min(t1, part->last);
  // The same ray in mesh space, with the same parameter.
  const Line line{(ray.origin - volume_box_.low) / unit_, ray.direction / unit_};
  // Piece by piece: what lies behind the first hit need not be solved. Pieces share their ends, so no hit is lost.
  const double piece = 32 * unit_;
  std::vector<Hit> hits;
  SearchCounters counters;
  for (double begin = first; begin < last;) {
    const double end = begin + piece < last ? begin + piece : last;
    surface_.all_hits(line, begin, end, hits, counters);
    if (!hits.empty()) break;
    begin = end;
  }
  if (hits.empty()) return std::nullopt;
  const Hit& hit = hits.front();
  // Rising: the ray comes from the side of lower values. The gradient points to higher ones.
  const Vec3 gradient = surface_.gradient(line.at(hit.t));
  const Vec3 towards_ray = hit.falling ? gradient : -gradient;
  const double length = norm(towards_ray);
  return SurfacePoint{hit.t, length > 0 ? towards_ray / length : -ray.direction, !hit.falling, 0};
}

}  // namespace deliso

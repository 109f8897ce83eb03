#include "raycast/isosurface.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "delaunay/base/check.h"
#include "raycast/active_cells.h"
#include "raycast/cell_hits.h"
#include "raycast/cell_walk.h"
#include "raycast/empty_bricks.h"
#include "raycast/intersect.h"
#include "raycast/line.h"
#include "raycast/line_segment.h"
#include "raycast/min_max_kdtree.h"
#include "raycast/voxel_intersection.h"

namespace deliso {

Isosurface::Isosurface(const ScalarGrid& grid, double isovalue, const SearchOptions& options)
    : Isosurface(grid, isovalue, options, grid.spacing()) {}

Isosurface::Isosurface(const ScalarGrid& grid, double isovalue, const SearchOptions& options, const Vec3& spacing,
                       int threads)
    : grid_(grid), isovalue_(isovalue), options_(options) {
  if (options.leaf_cells < 1)
    throw InputError("search.leaf_cells is " + std::to_string(options.leaf_cells) + ": it must be at least 1");
  step_ = spacing / std::min({spacing.x, spacing.y, spacing.z});
  inverse_step_ = {1 / step_.x, 1 / step_.y, 1 / step_.z};
  const Vec3 last{static_cast<double>(grid.dims()[0] - 1), static_cast<double>(grid.dims()[1] - 1),
                  static_cast<double>(grid.dims()[2] - 1)};
  box_ = {{0, 0, 0}, scaled(last, step_)};
  if (!options.min_max_pruning) return;
  if (options.traversal == Traversal::kKdTree) {
    tree_ = std::make_unique<MinMaxKdTree>(grid, options.leaf_cells);
  } else {
    active_ = std::make_unique<ActiveCells>(grid, isovalue, threads);
    bricks_ = std::make_unique<EmptyBricks>(grid, *active_, isovalue, threads);
  }
}

Isosurface::~Isosurface() = default;

CellCorners Isosurface::relative_corners(const Vec3& p, Vec3& uvw) const {
  const Dims& dims = grid_.dims();
  const Vec3 point = scaled(p, inverse_step_);
  const auto along = [](double coordinate, std::int32_t count, double& place) {
    const double x = std::clamp(coordinate, 0.0, static_cast<double>(count - 1));
    const std::int32_t cell = std::min(static_cast<std::int32_t>(x), count - 2);
    place = x - cell;
    return cell;
  };
  const std::int32_t i = along(point.x, dims[0], uvw.x), j = along(point.y, dims[1], uvw.y),
                     k = along(point.z, dims[2], uvw.z);
  return visit_samples(grid_.samples(), [&, first = grid_.index(i, j, k)](const auto& samples) {
    const auto row = static_cast<std::size_t>(dims[0]);
    const auto* const a = samples.data() + first;
    const auto* const b = a + row * static_cast<std::size_t>(dims[1]);
    const auto relative = [this](auto sample) { return static_cast<double>(sample) - isovalue_; };
    return CellCorners{relative(a[0]), relative(a[1]), relative(a[row]), relative(a[row + 1]),
                       relative(b[0]), relative(b[1]), relative(b[row]), relative(b[row + 1])};
  });
}

double Isosurface::value(const Vec3& p) const {
  Vec3 uvw;
  const CellCorners corners = relative_corners(p, uvw);
  return relative_value(corners, uvw);
}

Box3 Isosurface::surface_box() const { return grid_.walls() ? Box3{box_.low + step_, box_.high - step_} : box_; }

Vec3 Isosurface::settled(const Vec3& p) const {
  if (!grid_.walls()) return p;
  constexpr double kNear = 0x1p-20;  // of a spacing
  Vec3 on_wall = p;
  for (std::size_t a = 0; a < 3; ++a) {
    for (const double wall : {step_[a], box_.high[a] - step_[a]}) {
      if (std::abs(p[a] - wall) <= kNear * step_[a]) on_wall[a] = wall;
    }
  }
  return on_wall;
}

Vec3 Isosurface::gradient(const Vec3& p) const {
  Vec3 uvw;
  const CellCorners corners = relative_corners(p, uvw);
  return scaled(trilinear_gradient(corners, uvw), inverse_step_);
}

bool Isosurface::passes_within(const Vec3& p, double distance) const {
  Vec3 uvw;
  const CellCorners corners = relative_corners(p, uvw);
  const Vec3 gradient = scaled(trilinear_gradient(corners, uvw), inverse_step_);
  const Vec3 offset = scaled((distance / norm(gradient)) * gradient, inverse_step_);
  const auto is_in_cell = [](const Vec3& q) {
    return q.x >= 0 && q.x <= 1 && q.y >= 0 && q.y <= 1 && q.z >= 0 && q.z <= 1;
  };
  const Vec3 below = uvw - offset, above = uvw + offset;
  return is_in_cell(below) && is_in_cell(above) && relative_value(corners, below) < 0 &&
         relative_value(corners, above) >= 0;
}

// The first and the last cell of a segment but for what lies near an end that is far from the isosurface. The walk from
// one to the other is a part of the whole one, and meets all of its active cells.
std::pair<Cell, Cell> Isosurface::without_clear_ends(const LineSegment& segment) const {
  constexpr int kWorthwhile = 2;  // bricks: what is nearer is passed as fast step by step
  std::pair<Cell, Cell> ends(segment.first, segment.last);
  double from = segment.s_low;
  // Tells whether anything is left.
  const auto cut = [&](Cell& end, int side) {
    for (;;) {
      const int clearance = bricks_->clearance(end);
      if (std::abs(clearance) < kWorthwhile) return true;
      const double s = segment.within(EmptyBricks::clear_block(end, clearance), side);
      if (side > 0 ? s >= segment.s_high : s <= from) return false;
      end = segment.cell_at(s);
      if (side > 0) from = s;
    }
  };
  if (!cut(ends.first, +1) || !cut(ends.second, -1)) ends.second = ends.first;  // a cell that is not active
  return ends;
}

// CollectVoxels of Figure 12 (section 4.1), without a list: calls solve(visit) for every voxel cell of the segment that
// can hold the isovalue, front to back. The plain form is collect_voxels() of intersect.h, which gives the same cells.
template <class Solve>
void Isosurface::visit_voxels(const LineSegment& segment, Solve&& solve) const {
  const auto [first, last] = active_ != nullptr ? without_clear_ends(segment) : std::pair(segment.first, segment.last);
  CellWalk<> walk(segment.line, first, last, segment.s_low, segment.s_high);
  if (active_ != nullptr) {
    do {
      if (active_->is_active(walk.cell())) solve(walk.visit());
    } while (walk.step());
    return;
  }
  if (tree_ == nullptr) {
    do {
      solve(walk.visit());
    } while (walk.step());
    return;
  }
  // From the smallest node that holds the segment down to the cell at hand. A node without the isovalue is left in one
  // jump, and the search goes on below the smallest node that holds both the old and the new cell.
  Cell cell = grid_cell(walk.cell(), grid_.dims());
  int level = tree_->common_level(cell, grid_cell(segment.last, grid_.dims()));
  const int lowest = std::max(tree_->leaf_level(), 1);
  for (;;) {
    while (level >= lowest && tree_->holds(isovalue_, level, cell)) --level;
    bool more = false;
    if (level >= lowest) {
      more = walk.leave(tree_->block(level, cell));
    } else {
      if (cell_holds(grid_, walk.cell(), isovalue_)) solve(walk.visit());
      more = walk.step();
    }
    if (!more) return;
    const Cell next = grid_cell(walk.cell(), grid_.dims());
    level = tree_->common_level(cell, next) - 1;
    cell = next;
  }
}

// Intersect of Figure 12 with its two steps fused: FindIntersections solves each voxel cell as CollectVoxels comes to
// it. The plain form is intersect() of intersect.h, which gives the same hits.
void Isosurface::all_hits(const Line& line, double t0, double t1, std::vector<Hit>& hits,
                          SearchCounters& counters) const {
  hits.clear();
  ++counters.searches;
  if (!(t0 < t1)) return;
  const LineSegment segment(line, t0, t1, inverse_step_, grid_.dims());
  std::uint64_t solves = 0;
  visit_voxels(segment, [&](const CellVisit& voxel) {
    ++solves;
    find_intersections_in(voxel, grid_, isovalue_, options_.solver, segment, hits);
  });
  counters.solves += solves;
  if (hits.empty()) return;
  ++counters.searches_hit;
  counters.solves_hit += solves;
}

}  // namespace deliso

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
#include "raycast/line.h"
#include "raycast/min_max_kdtree.h"
#include "raycast/voxel_intersection.h"

namespace deliso {

// A segment of a line, from cell to cell.
struct Isosurface::Segment {
  IndexLine line;
  AxisValues low{};  // its ends in index space
  AxisValues high{};
  double s_low = 0;
  double s_high = 0;
  Cell first{};
  Cell last{};

  Segment(const Isosurface& surface, const Line& mesh_line, double t0, double t1)
      : line(index_line(mesh_line, surface.inverse_step_, surface.grid_.dims())) {
    const Dims& dims = surface.grid_.dims();
    // Where an infinite line starts and stops to move.
    double moves_from = kNever;
    double moves_to = -kNever;
    const bool any_infinite = std::isinf(t0) || std::isinf(t1);
    for (std::size_t a = 0; any_infinite && a < 3; ++a) {
      if (line.direction[a] == 0) continue;
      const double at_low = line.crossing(a, 0);
      const double at_high = line.crossing(a, dims[a] - 1);
      moves_from = std::min({moves_from, at_low, at_high});
      moves_to = std::max({moves_to, at_low, at_high});
    }
    // An end is where the caller's line.at(t) is, so that its side is that of is_above(line.at(t)).
    const auto end = [&](double t, double s_infinite, double& s, Cell& cell) {
      AxisValues point{};
      const bool is_infinite = std::isinf(t);
      if (!is_infinite) point = axis_values(scaled(mesh_line.at(t), surface.inverse_step_));
      s = is_infinite ? s_infinite : std::clamp(t - line.t_origin, -kNever, kNever);
      for (std::size_t a = 0; a < 3; ++a) {
        if (is_infinite)
          point[a] = line.direction[a] == 0 ? line.base[a] : std::copysign(kNever, line.direction[a] * t);
        cell[a] = extended_cell(point[a], dims[a]);
      }
      return point;
    };
    low = end(t0, moves_from, s_low, first);
    high = end(t1, moves_to, s_high, last);
    if (s_low > s_high) (std::isinf(t0) ? s_low : s_high) = std::isinf(t0) ? s_high : s_low;
  }

  // How far from its first (side +1) or last (side -1) cell on the segment certainly stays within a block around it.
  [[nodiscard]] double within(const CellBlock& block, const Dims& dims, int side) const {
    constexpr double kMargin = 1.0 / 16;  // cells, far above rounding
    double until = kNever;                // times `side`
    for (std::size_t a = 0; a < 3; ++a) {
      // Without branches: where it goes cannot be foretold.
      const auto is_up = static_cast<std::size_t>(line.direction[a] * side > 0);
      const std::int32_t plane = std::array{block.low[a] - 1, block.high[a]}[is_up];
      const double s = side * line.crossing(a, plane + std::array{kMargin, -kMargin}[is_up]);
      // Outermost cells go on for ever.
      const std::size_t is_open = static_cast<std::size_t>(line.direction[a] == 0) |
                                  static_cast<std::size_t>(plane < 0) | static_cast<std::size_t>(plane >= dims[a]);
      until = std::min(until, std::array{s, kNever}[is_open]);
    }
    return side * until;
  }
  // The cell that the walk over the segment is in when all crossings up to parameter s are behind it.
  [[nodiscard]] Cell cell_at(double s, const Dims& dims) const {
    Cell cell;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int32_t step = 1 | ((last[a] - first[a]) >> 31);  // -1 when it goes back
      const std::int32_t upward = (step + 1) / 2;  // 1 or 0
      const auto passed = [&](std::int32_t c) { return line.crossing(a, c - upward) <= s; };  // on the way to c
      // A guess from the rounded position, then settled by crossings.
      std::int32_t& c = cell[a];
      c = std::clamp(extended_cell(line.base[a] + s * line.direction[a], dims[a]), std::min(first[a], last[a]),
                     std::max(first[a], last[a]));
      while (c != first[a] && !passed(c)) c -= step;
      while (c != last[a] && passed(c + step)) c += step;
    }
    return cell;
  }
};

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
  const AxisValues point = axis_values(scaled(p, inverse_step_));
  Cell cell;
  for (std::size_t a = 0; a < 3; ++a) {
    const double x = std::clamp(point[a], 0.0, static_cast<double>(dims[a] - 1));
    cell[a] = std::min(static_cast<std::int32_t>(x), dims[a] - 2);
    uvw[a] = x - cell[a];
  }
  return relative_to(grid_.cell(cell[0], cell[1], cell[2]), isovalue_);
}

double Isosurface::value(const Vec3& p) const {
  Vec3 uvw;
  const CellCorners corners = relative_corners(p, uvw);
  return relative_value(corners, uvw);
}

Vec3 Isosurface::gradient(const Vec3& p) const {
  Vec3 uvw;
  const CellCorners corners = relative_corners(p, uvw);
  return scaled(trilinear_gradient(corners, uvw), inverse_step_);
}

// The first and the last cell of a segment but for what lies near an end that is far from the isosurface. The walk from
// one to the other is a part of the whole one, and meets all of its active cells.
std::pair<Cell, Cell> Isosurface::without_clear_ends(const Segment& segment) const {
  constexpr int kWorthwhile = 2;  // bricks: what is nearer is passed as fast step by step
  std::pair<Cell, Cell> ends(segment.first, segment.last);
  double from = segment.s_low;
  // Tells whether anything is left.
  const auto cut = [&](Cell& end, int side) {
    for (;;) {
      const int clearance = bricks_->clearance(end);
      if (std::abs(clearance) < kWorthwhile) return true;
      const double s = segment.within(EmptyBricks::clear_block(end, clearance), grid_.dims(), side);
      if (side > 0 ? s >= segment.s_high : s <= from) return false;
      end = segment.cell_at(s, grid_.dims());
      if (side > 0) from = s;
    }
  };
  if (!cut(ends.first, +1) || !cut(ends.second, -1)) ends.second = ends.first;  // a cell that is not active
  return ends;
}

// Calls solve(walk) for every cell of the segment that can hold the isovalue, front to back.
template <class Solve>
void Isosurface::search_cells(const Segment& segment, Solve&& solve) const {
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

void Isosurface::all_hits(const Line& line, double t0, double t1, std::vector<Hit>& hits,
                          SearchCounters& counters) const {
  hits.clear();
  ++counters.searches;
  if (!(t0 < t1)) return;
  const Segment segment(*this, line, t0, t1);
  std::uint64_t solves = 0;
  search_cells(segment, [&](const CellVisit& visit) {
    ++solves;
    const CellHits found =
        solve_cell(grid_, isovalue_, options_.solver, segment.line, visit, segment.low, segment.high);
    for (int i = 0; i < found.changes.count; ++i)
      hits.push_back({std::clamp(found.t(segment.line, i), t0, t1), found.falling(i)});
  });
  counters.solves += solves;
  if (hits.empty()) return;
  ++counters.searches_hit;
  counters.solves_hit += solves;
}

}  // namespace deliso

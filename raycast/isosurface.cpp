#include "raycast/isosurface.h"

#include <cmath>
#include <limits>
#include <string>

#include "delaunay/base/check.h"
#include "raycast/active_cells.h"
#include "raycast/cell_hits.h"
#include "raycast/cell_walk.h"
#include "raycast/empty_bricks.h"
#include "raycast/min_max_kdtree.h"
#include "raycast/voxel_intersection.h"

namespace deliso {

namespace {

AxisValues axis_values(const Vec3& v) { return {v.x, v.y, v.z}; }

// The line in index space. A line from far away is re-parametrised near the box, so that s keeps its digits there.
IndexLine index_line(const Line& line, const Vec3& inverse_step, const Dims& dims) {
  constexpr double kFar = 64;                // in sizes of the box
  constexpr double kLargestInverse = 1e280;  // keeps crossings finite
  IndexLine result;
  result.base = axis_values(scaled(line.origin, inverse_step));
  result.direction = axis_values(scaled(line.direction, inverse_step));
  bool is_far = false;
  for (std::size_t a = 0; a < 3; ++a) {
    is_far |= std::abs(result.base[a]) > kFar * dims[a];
    if (result.direction[a] != 0)
      result.inverse[a] = std::clamp(1 / result.direction[a], -kLargestInverse, kLargestInverse);
  }
  if (!is_far) return result;
  // The point nearest to the middle of the box; the direction is first brought to unit size.
  double largest = 0;
  for (const double d : result.direction) largest = std::max(largest, std::abs(d));
  if (largest == 0) return result;
  double along = 0;
  double squared = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double d = result.direction[a] / largest;
    along += (0.5 * dims[a] - result.base[a]) * d;
    squared += d * d;
  }
  const double t = along / squared / largest;
  if (!std::isfinite(t) || !is_finite(line.at(t))) return result;
  result.t_origin = t;
  result.base = axis_values(scaled(line.at(t), inverse_step));
  return result;
}

// The candidate nearest to t = 0; of two at the same distance the one at positive t.
struct Nearest {
  double t = std::numeric_limits<double>::infinity();

  void offer(double candidate) {
    const double now = std::abs(t);
    const double then = std::abs(candidate);
    if (then < now || (then == now && candidate > t)) t = candidate;
  }
  void offer_falling(const CellHits& hits, const IndexLine& line) {
    for (int i = 0; i < hits.changes.count; ++i)
      if (hits.falling(i)) offer(hits.t(line, i));
  }
  [[nodiscard]] std::optional<double> within(double reach) const {
    if (std::isinf(t) || !(std::abs(t) <= reach)) return std::nullopt;
    return t;
  }
};

}  // namespace

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
};

Isosurface::Isosurface(const ScalarGrid& grid, double isovalue, const SearchOptions& options)
    : Isosurface(grid, isovalue, options, grid.spacing()) {}

Isosurface::Isosurface(const ScalarGrid& grid, double isovalue, const SearchOptions& options, const Vec3& spacing)
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
    active_ = std::make_unique<ActiveCells>(grid, isovalue);
    bricks_ = std::make_unique<EmptyBricks>(grid, *active_, isovalue);
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

// Calls solve(walk) for every cell of the segment that can hold the isovalue, front to back.
template <class Solve>
void Isosurface::search_cells(const Segment& segment, Solve&& solve) const {
  CellWalk<> walk(segment.line, segment.first, segment.last, segment.s_low, segment.s_high);
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

std::optional<double> Isosurface::nearest_on_line(const Line& line, double reach, std::uint64_t& solves) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Segment segment(*this, line, -kInfinity, kInfinity);
  Nearest nearest;
  search_cells(segment, [&](const CellVisit& visit) {
    ++solves;
    nearest.offer_falling(solve_cell(grid_, isovalue_, options_.solver, segment.line, visit, segment.low, segment.high),
                          segment.line);
  });
  return nearest.within(reach);
}

std::optional<double> Isosurface::nearest_outward(const Line& mesh_line, double reach, std::uint64_t& solves) const {
  const Dims& dims = grid_.dims();
  const IndexLine line = index_line(mesh_line, inverse_step_, dims);
  // Two walks leave the cell of t = 0, one each way.
  const AxisValues origin = axis_values(scaled(mesh_line.origin, inverse_step_));
  Cell start;
  Cell ahead_end;
  Cell behind_end;
  for (std::size_t a = 0; a < 3; ++a) {
    const double d = line.direction[a];
    start[a] = extended_cell(origin[a], dims[a]);
    ahead_end[a] = d > 0 ? dims[a] : d < 0 ? 0 : start[a];
    behind_end[a] = d > 0 ? 0 : d < 0 ? dims[a] : start[a];
  }
  CellWalk<false> ahead(line, start, ahead_end, -line.t_origin, kNever);
  CellWalk<true> behind(line, start, behind_end, -line.t_origin, -kNever);
  Nearest nearest;
  const auto solve = [&](const CellVisit& visit) {
    if (active_ != nullptr ? !active_->is_active(visit.cell)
                           : options_.min_max_pruning && !cell_holds(grid_, visit.cell, isovalue_))
      return;
    ++solves;
    nearest.offer_falling(solve_cell(grid_, isovalue_, options_.solver, line, visit, line.base, line.base), line);
  };
  Crossing ahead_exit = ahead.exit();
  Crossing behind_exit = behind.exit();
  solve({start, behind_exit, ahead_exit});
  // The segment between the walks grows by one cell at a time, at the end nearer to t = 0, until nothing beyond its
  // ends can be nearer than the best hit.
  for (;;) {
    const double reached_ahead = ahead_exit.s + line.t_origin;
    const double reached_behind = -(behind_exit.s + line.t_origin);
    if (std::min(reached_ahead, reached_behind) > std::min(std::abs(nearest.t), reach)) break;
    if (reached_ahead <= reached_behind) {
      if (!ahead.step()) break;  // this side is never nearer than kNever: both are done
      const Crossing entry = ahead_exit;
      ahead_exit = ahead.exit();
      solve({ahead.cell(), entry, ahead_exit});
    } else {
      if (!behind.step()) break;
      const Crossing entry = behind_exit;
      behind_exit = behind.exit();
      solve({behind.cell(), behind_exit, entry});
    }
  }
  return nearest.within(reach);
}

std::optional<double> Isosurface::nearest_falling_hit(const Line& line, double reach, SearchCounters& counters) const {
  std::uint64_t solves = 0;
  const std::optional<double> hit =
      options_.incremental ? nearest_outward(line, reach, solves) : nearest_on_line(line, reach, solves);
  ++counters.searches;
  counters.solves += solves;
  if (hit) {
    ++counters.searches_hit;
    counters.solves_hit += solves;
  }
  return hit;
}

}  // namespace deliso

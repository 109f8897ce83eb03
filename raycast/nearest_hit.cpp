// The hit of a line nearest to its origin: in the cell where it starts, or from there outward.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "raycast/active_cells.h"
#include "raycast/cell_hits.h"
#include "raycast/cell_walk.h"
#include "raycast/isosurface.h"
#include "raycast/line.h"
#include "raycast/start_cell.h"
#include "raycast/voxel_intersection.h"

namespace deliso {

namespace {

// So many searches are made side by side.
constexpr std::size_t kTogether = 8;

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

std::optional<double> Isosurface::nearest_on_line(const Line& line, double reach, std::uint64_t& solves) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<Hit> hits;
  SearchCounters counters;
  all_hits(line, -kInfinity, kInfinity, hits, counters);
  solves += counters.solves;
  Nearest nearest;
  for (const Hit& hit : hits) {
    if (hit.falling) nearest.offer(hit.t);
  }
  return nearest.within(reach);
}

// Most hits that are asked for lie close to t = 0, and are found so in a third of the time. Schwarze's solver does
// without: it is there to be compared. At most kTogether lines.
void Isosurface::hits_in_start_cells(std::span<const Line> lines, double reach,
                                     std::span<std::optional<double>> hits) const {
  if (options_.solver != CubicSolver::kBracketed || !options_.incremental) return;
  std::array<CellCorners, kTogether> corners;
  std::array<Vec3, kTogether> place;  // within the cell
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (box_.contains(lines[i].origin)) corners[i] = relative_corners(lines[i].origin, place[i]);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!box_.contains(lines[i].origin)) continue;
    const Vec3 direction = scaled(lines[i].direction, inverse_step_);
    const std::optional<double> t = falling_hit_around(corners[i], place[i], direction);
    if (t && std::abs(*t) <= reach) hits[i] = t;
  }
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
  std::optional<double> hit;
  nearest_falling_hits({&line, 1}, reach, {&hit, 1}, counters);
  return hit;
}

// A start cell without a hit counts when the walks solve it.
void Isosurface::nearest_falling_hits(std::span<const Line> lines, double reach, std::span<std::optional<double>> hits,
                                      SearchCounters& counters) const {
  for (std::size_t first = 0; first < lines.size(); first += kTogether) {
    const std::size_t count = std::min(kTogether, lines.size() - first);
    const auto some = hits.subspan(first, count);
    std::fill(some.begin(), some.end(), std::nullopt);
    hits_in_start_cells(lines.subspan(first, count), reach, some);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::uint64_t solves = 1;
    if (!hits[i]) {
      solves = 0;
      hits[i] =
          options_.incremental ? nearest_outward(lines[i], reach, solves) : nearest_on_line(lines[i], reach, solves);
    }
    ++counters.searches;
    counters.solves += solves;
    if (!hits[i]) continue;
    ++counters.searches_hit;
    counters.solves_hit += solves;
  }
}

}  // namespace deliso

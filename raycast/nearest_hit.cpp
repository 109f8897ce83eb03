// The hit of a line nearest to its origin, which stage 2 asks for (Dey and Levine, sections 2.2.3 and 4.2).
//
// nearest_on_line() takes the nearest of all hits. nearest_outward() is the paper's enhancement: a small segment around
// the origin grows until it holds the hit. hits_in_start_cells() is its first step in a fast form, for several lines
// side by side; lines that it finds nothing for are left to nearest_outward(). All find the same hit, the start cells
// to within rounding (tests/raycast/isosurface_options_test.cpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "raycast/active_cells.h"
#include "raycast/cell_hits.h"
#include "raycast/cell_walk.h"
#include "raycast/isosurface.h"
#include "raycast/line.h"
#include "raycast/start_cells.h"
#include "raycast/voxel_intersection.h"

namespace deliso {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

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

// Without the enhancement: the nearest of the hits of Intersect (Figure 12).
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

// Most hits that are asked for lie close to t = 0, in the cell of the line's origin, and are found so in a third of the
// time. Schwarze's solver does without: it is there to be compared.
void Isosurface::hits_in_start_cells(const LineLanes& lines, double reach, bool first_alone, Lanes& hits) const {
  if (options_.solver != CubicSolver::kBracketed || !options_.incremental) {
    hits.fill(kNothing);
    return;
  }
  StartCells cells;
  find_start_cells(lines, reach, {grid_.dims(), inverse_step_, box_.high}, first_alone, cells);
  const std::size_t count = first_alone ? 1 : kLanes;
  const std::size_t row = grid_.index(0, 1, 0), layer = grid_.index(0, 0, 1);
  visit_samples(grid_.samples(), [&](const auto& samples) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto* const lowest = samples.data() + cells.first[i];
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const std::size_t offset = (corner & 1) + (corner >> 1 & 1) * row + (corner >> 2) * layer;
        cells.relative[corner][i] = static_cast<double>(lowest[offset]) - isovalue_;
      }
    }
  });
  falling_hits_around(first_alone, cells);
  hits = cells.hit;
}

// Section 4.2: voxel cells are traversed from the origin in both directions, the nearest first, each of them once.
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
  LineLanes lines;
  lines.set(0, line);
  Lanes hits;
  nearest_falling_hits(lines, {true}, reach, hits, counters);
  return std::isnan(hits[0]) ? std::nullopt : std::optional(hits[0]);
}

// A start cell without a hit counts when the walks solve it.
void Isosurface::nearest_falling_hits(const LineLanes& lines, const std::array<bool, kLanes>& asked, double reach,
                                      Lanes& hits, SearchCounters& counters) const {
  hits_in_start_cells(lines, reach, !asked[1] && !asked[2] && !asked[3], hits);
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (!asked[i]) continue;
    std::uint64_t solves = 1;
    if (std::isnan(hits[i])) {
      solves = 0;
      const Line line = lines.at(i);
      hits[i] = (options_.incremental ? nearest_outward(line, reach, solves) : nearest_on_line(line, reach, solves))
                    .value_or(kNothing);
    }
    ++counters.searches;
    counters.solves += solves;
    if (std::isnan(hits[i])) continue;
    ++counters.searches_hit;
    counters.solves_hit += solves;
  }
}

}  // namespace deliso

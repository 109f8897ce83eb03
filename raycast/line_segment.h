// A segment of a line on its way through the voxel cells: the r(t) = a + b t of the paper (Dey and Levine, section 4).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "raycast/cell_walk.h"
#include "raycast/line.h"

namespace deliso {

struct LineSegment {
  double t0 = 0;  // its ends in the caller's line parameter
  double t1 = 0;
  IndexLine line;
  AxisValues low{};  // its ends in index space
  AxisValues high{};
  double s_low = 0;  // the same as parameters of `line`
  double s_high = 0;
  Cell first{};  // the extended cells that hold them
  Cell last{};
  Dims dims{};  // of the grid, in samples

  // The part t0 <= t <= t1 of a line in mesh space. Precondition: t0 < t1; either may be infinite.
  LineSegment(const Line& mesh_line, double from, double to, const Vec3& inverse_step, const Dims& grid_dims)
      : t0(from), t1(to), line(index_line(mesh_line, inverse_step, grid_dims)), dims(grid_dims) {
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
      if (!is_infinite) point = axis_values(scaled(mesh_line.at(t), inverse_step));
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
  [[nodiscard]] double within(const CellBlock& block, int side) const {
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
  [[nodiscard]] Cell cell_at(double s) const {
    Cell cell;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int32_t step = 1 | ((last[a] - first[a]) >> 31);                             // -1 when it goes back
      const std::int32_t upward = (step + 1) / 2;                                             // 1 or 0
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

}  // namespace deliso

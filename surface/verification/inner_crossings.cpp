#include "surface/verification/inner_crossings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>

#include "volume/trilinear_cell.h"

namespace deliso {

namespace {

// Which components pass through a cell: such as are left out, and others.
struct Passing {
  bool left_out = false, kept = false;
};

// The cells around the edges crossed.
std::map<CellIndex, Passing> cells_crossed(const ScalarGrid& grid, std::span<const EdgeCrossing> crossings,
                                           std::span<const std::uint8_t> is_dropped) {
  std::map<CellIndex, Passing> cells;
  for (const EdgeCrossing& crossing : crossings) {
    const bool is_left_out = !is_dropped.empty() && is_dropped[crossing.component] != 0;
    const CellIndex above = sample_of(crossing, grid.dims());
    for (std::int32_t back_u = 0; back_u < 2; ++back_u) {
      for (std::int32_t back_v = 0; back_v < 2; ++back_v) {
        CellIndex cell = above;
        cell.at((crossing.axis + 1U) % 3) -= back_u;
        cell.at((crossing.axis + 2U) % 3) -= back_v;
        bool is_cell = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          is_cell = is_cell && cell.at(axis) >= 0 && cell.at(axis) + 2 <= grid.dims().at(axis);
        }
        if (is_cell) (is_left_out ? cells[cell].left_out : cells[cell].kept) = true;
      }
    }
  }
  return cells;
}

// A line along an axis through one cell: where the interpolant changes sides between points spaced evenly on it.
void append_changes(const CellCorners& corners, double isovalue, std::size_t axis, Vec3 start, int times,
                    const CellIndex& cell, std::vector<Vec3>& points) {
  const Vec3 low{double(cell[0]), double(cell[1]), double(cell[2])};
  double last = trilinear_value(corners, start) - isovalue;
  for (int step = 1; step <= times; ++step) {
    Vec3 end = start;
    end[axis] = static_cast<double>(step) / times;
    const double value = trilinear_value(corners, end) - isovalue;
    if ((last < 0) != (value < 0)) {
      Vec3 p = end;
      p[axis] -= value / (value - last) / times;
      points.push_back(low + p);
    }
    last = value;
  }
}

}  // namespace

std::vector<Vec3> inner_crossings(const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology,
                                  std::span<const std::uint8_t> is_dropped, int times) {
  std::vector<Vec3> points;
  const auto is_of_dropped = [&](const Vec3& p) {
    const auto component = component_of(grid, isovalue, topology, p);
    return component && is_dropped[*component] != 0;
  };
  for (const auto& [cell, passing] : cells_crossed(grid, topology.crossings, is_dropped)) {
    if (!passing.kept) continue;
    const auto first = static_cast<std::ptrdiff_t>(points.size());
    const CellCorners corners = grid.cell(cell[0], cell[1], cell[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Lines on a face are those of both its cells; each counts once but at the last faces of the grid.
      for (int place = 1; place < times * times; ++place) {
        const int row = place / times;
        Vec3 start;
        start[(axis + 1) % 3] = static_cast<double>(place % times) / times;
        start[(axis + 2) % 3] = static_cast<double>(row) / times;
        append_changes(corners, isovalue, axis, start, times, cell, points);
      }
    }
    if (passing.left_out)
      points.erase(std::remove_if(points.begin() + first, points.end(), is_of_dropped), points.end());
  }
  return points;
}

}  // namespace deliso

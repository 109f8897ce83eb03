#include "raycast/cell_hits.h"

#include "delaunay/base/pair.h"
#include "raycast/voxel_intersection.h"

namespace deliso {

namespace {

// Where a line enters and leaves an extended cell, in the parameters of the grid cell behind it. Each of the two
// positions is a face crossing, or an end of the segment, at `low` or `high`. Both cells of a face use this one
// formula: only the coordinate across the face differs, and it is exactly 0 or 1.
std::array<Vec3, 2> positions_in_cell(const IndexLine& line, const CellVisit& visit, const AxisValues& low,
                                      const AxisValues& high, const Cell& base, const Dims& dims) {
  // No branches, because the kind of a position and its axis are unpredictable. The plane of a segment's end, which has
  // none, is written behind the coordinates.
  std::array<std::array<double, 4>, 2> crossings;
  for (std::size_t a = 0; a < 3; ++a) {
    const Pair at = line.base[a] + Pair{visit.in.s, visit.out.s} * line.direction[a];
    crossings[0][a] = at[0];
    crossings[1][a] = at[1];
  }
  crossings[0][static_cast<std::size_t>(visit.in.axis & 3)] = visit.in.plane;
  crossings[1][static_cast<std::size_t>(visit.out.axis & 3)] = visit.out.plane;
  const auto place = [&](const Crossing& at, const AxisValues& end, std::size_t i) {
    return std::array<const double*, 2>{end.data(), crossings[i].data()}[static_cast<std::size_t>(at.axis >= 0)];
  };
  const double* const in = place(visit.in, low, 0);
  const double* const out = place(visit.out, high, 1);
  const auto coordinate = [&](std::size_t a) {
    // By selection, because a crossing lies on either face as often as between them. In outer cells the coordinate
    // keeps the value of the box's face.
    const auto least = static_cast<double>(visit.cell[a] == dims[a]);
    const auto most = static_cast<double>(visit.cell[a] != 0);
    const Pair u = Pair{in[a], out[a]} - static_cast<double>(base[a]);
    const Pair at_least = u < least ? Pair{least, least} : u;
    return at_least > most ? Pair{most, most} : at_least;
  };
  const Pair x = coordinate(0), y = coordinate(1), z = coordinate(2);
  return {Vec3{x[0], y[0], z[0]}, Vec3{x[1], y[1], z[1]}};
}

}  // namespace

CellHits solve_cell(const ScalarGrid& grid, double isovalue, CubicSolver solver, const IndexLine& line,
                    const CellVisit& visit, const AxisValues& low, const AxisValues& high) {
  const Cell base = grid_cell(visit.cell, grid.dims());
  const CellCorners corners = relative_to(grid.cell(base[0], base[1], base[2]), isovalue);
  const auto [a, b] = positions_in_cell(line, visit, low, high, base, grid.dims());
  CellHits hits;
  hits.changes = voxel_intersection(corners, a, b, solver, hits.starts_above);
  hits.s_in = visit.in.s;
  hits.s_out = visit.out.s;
  return hits;
}

bool cell_holds(const ScalarGrid& grid, const Cell& cell, double isovalue) {
  const Dims& dims = grid.dims();
  const Cell base = grid_cell(cell, dims);
  CellCorners corners = relative_to(grid.cell(base[0], base[1], base[2]), isovalue);
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t bit = std::size_t{1} << a;
    for (std::size_t i = 0; i < 8; ++i) {
      if (cell[a] == 0 && (i & bit) != 0) corners[i] = corners[i ^ bit];
      if (cell[a] == dims[a] && (i & bit) == 0) corners[i] = corners[i ^ bit];
    }
  }
  return holds_isovalue(corners);
}

}  // namespace deliso

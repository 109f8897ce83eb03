#include "raycast/cell_hits.h"

#include "raycast/voxel_intersection.h"

namespace deliso {

namespace {

// Where a place on the line lies in an extended cell, in the parameters of the grid cell behind it. The place is a
// crossing, or the end of a segment at `end`. The one formula for both cells of a face: only the coordinate across the
// face differs, and that is exactly 0 or 1.
Vec3 position_in_cell(const IndexLine& line, const Crossing& at, const AxisValues& end, const Cell& cell,
                      const Cell& base, const Dims& dims) {
  AxisValues inside = end;
  if (at.axis >= 0) {
    for (std::size_t a = 0; a < 3; ++a) inside[a] = line.base[a] + at.s * line.direction[a];
    inside[static_cast<std::size_t>(at.axis)] = at.plane;
  }
  const auto coordinate = [&](std::size_t a) {
    // By selection: crossings lie on either face as often as between them.
    double u = inside[a] - base[a];
    u = u < 0 ? 0 : u;
    u = u > 1 ? 1 : u;
    // Outer cells: the coordinate stays that of the box's face.
    return cell[a] == 0 ? 0.0 : cell[a] == dims[a] ? 1.0 : u;
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

}  // namespace

CellHits solve_cell(const ScalarGrid& grid, double isovalue, CubicSolver solver, const IndexLine& line,
                    const CellVisit& visit, const AxisValues& low, const AxisValues& high) {
  const Cell base = grid_cell(visit.cell, grid.dims());
  const CellCorners corners = relative_to(grid.cell(base[0], base[1], base[2]), isovalue);
  const Vec3 a = position_in_cell(line, visit.in, low, visit.cell, base, grid.dims());
  const Vec3 b = position_in_cell(line, visit.out, high, visit.cell, base, grid.dims());
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

#include "surface/sizes/samples_near_faults.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "raycast/line.h"

namespace deliso {

void CellsNearFaults::add(const SurfaceMesh& mesh, const GeometryCheck& check) {
  for (const std::uint32_t t : check.far_triangles) {
    Box3 box;
    for (const std::uint32_t v : mesh.triangles[t]) box.extend(mesh.points[v]);
    add(box);
  }
  for (const Vec3& p : check.missed_points) {
    Box3 box;
    box.extend(p);
    add(box);
  }
}

void CellsNearFaults::add(const Box3& box) {
  constexpr double kMargin = 0.5;  // of a cell
  const Vec3& step = isosurface_.step();
  CellIndex low{}, high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = std::round(isosurface_.box().high[axis] / step[axis]) - 1;
    const auto cell = [&](double place) { return static_cast<std::int32_t>(std::clamp(std::floor(place), 0.0, last)); };
    low[axis] = cell(box.low[axis] / step[axis] - kMargin);
    high[axis] = cell(box.high[axis] / step[axis] + kMargin);
  }
  for (std::int32_t k = low[2]; k <= high[2]; ++k) {
    for (std::int32_t j = low[1]; j <= high[1]; ++j) {
      for (std::int32_t i = low[0]; i <= high[0]; ++i) cells_.insert({i, j, k});
    }
  }
}

std::vector<Vec3> CellsNearFaults::samples(double spacing) const {
  std::vector<Vec3> samples;
  for (const CellIndex& cell : cells_) {
    for (std::size_t axis = 0; axis < 3; ++axis) append_hits(cell, axis, spacing, samples);
  }
  return samples;
}

// Those of the lattice edges along an axis; edges in faces that are shared with the next cell are its own.
void CellsNearFaults::append_hits(const CellIndex& cell, std::size_t axis, double spacing,
                                  std::vector<Vec3>& samples) const {
  const Vec3& step = isosurface_.step();
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto parts = [&](std::size_t across) { return static_cast<int>(std::ceil(step[across] / spacing)); };
  const int parts_u = parts(u), parts_v = parts(v);
  std::vector<Hit> hits;
  SearchCounters counters;
  for (int i = 0; i < parts_u; ++i) {
    for (int j = 0; j < parts_v; ++j) {
      Line line;
      line.direction[axis] = 1;
      line.origin[axis] = cell[axis] * step[axis];
      line.origin[u] = (cell[u] + static_cast<double>(i) / parts_u) * step[u];
      line.origin[v] = (cell[v] + static_cast<double>(j) / parts_v) * step[v];
      hits.clear();
      isosurface_.all_hits(line, 0, step[axis], hits, counters);
      for (const Hit& hit : hits) samples.push_back(line.at(hit.t));
    }
  }
}

}  // namespace deliso

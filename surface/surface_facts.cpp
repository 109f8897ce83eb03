#include "surface/surface_facts.h"

#include <cstdint>
#include <exception>

#include "volume/critical_points.h"

namespace deliso {

namespace {

std::vector<CellIndex> find_critical_cells(const ScalarGrid& grid, const CrossingIndex& index) {
  std::vector<CellIndex> cells;
  std::vector<CriticalPoint> saddles;
  index.for_each_active_cell([&](const CellIndex& cell, std::uint8_t) {
    saddles.clear();
    append_critical_points(grid.cell(cell[0], cell[1], cell[2]), saddles);
    if (!saddles.empty() || critical_corners(grid, cell) != 0) cells.push_back(cell);
  });
  return cells;
}

}  // namespace

SurfaceFacts::SurfaceFacts(const ScalarGrid& grid, const Isosurface& isosurface, const IsosurfaceTopology& topology,
                           int threads)
    : grid_(grid),
      topology_(topology),
      critical_cells_(
          std::async(std::launch::deferred, [&grid, &topology] { return find_critical_cells(grid, topology.index); })),
      polygonized_(std::async(std::launch::deferred, [&grid, &isosurface, &topology] {
        return polygonized_surface(grid, isosurface, topology);
      })) {
  if (threads < 2) return;
  try {
    // Through futures of its own; what a search throws is thrown to those who ask.
    finder_ = std::jthread([cells = critical_cells_, surface = polygonized_](const std::stop_token& stop) {
      cells.wait();
      if (!stop.stop_requested()) surface.wait();  // nobody will ask any more
    });
  } catch (const std::exception&) {
    // No thread to be had: facts are found when they are asked for.
  }
}

}  // namespace deliso

#include "surface/repair/rounds/sample_budget.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "surface/repair/lattice/sample_lattice.h"

namespace deliso {

namespace {

constexpr double kMostPerCrossing = 2;
// So many are worth a try for any component.
constexpr double kAlways = 1024;
// New samples that a cell brings at each level, on average, in random masks and noise.
constexpr std::array<double, kMaxLatticeLevel + 1> kSamplesOfLevel = {0, 1.6, 5, 8, 28, 100};

}  // namespace

std::vector<std::uint32_t> components_over_budget(const ExactSurface& surface, const CellLevels& cell_levels,
                                                  std::vector<CellName> cells, const std::vector<bool>& done) {
  const auto& crossings = surface.topology.crossings;
  std::vector<double> samples(done.size(), 0);
  std::vector<std::uint32_t> of_cell;
  const auto count = [&](CellName cell, double added) {
    of_cell.clear();
    surface.topology.index.for_each_crossing_of_cell(
        cell_levels.cell(cell), [&](std::uint32_t crossing) { of_cell.push_back(crossings[crossing].component); });
    for (const std::uint32_t c : of_cell) samples[c] += added / static_cast<double>(of_cell.size());
  };
  const auto at_level = [](int level) { return kSamplesOfLevel[static_cast<std::size_t>(level)]; };
  for (const auto& [cell, level] : cell_levels.levels()) count(cell, at_level(level));
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  for (const CellName cell : cells) {
    const auto at = cell_levels.levels().find(cell);
    const int level = at == cell_levels.levels().end() ? 0 : at->second;
    count(cell, at_level(std::min(level + 1, kMaxLatticeLevel)) - at_level(level));
  }
  std::vector<double> most(done.size(), 0);
  for (const EdgeCrossing& crossing : crossings) most[crossing.component] += kMostPerCrossing;
  std::vector<std::uint32_t> over;
  for (std::uint32_t c = 0; c < done.size(); ++c) {
    if (!done[c] && samples[c] > std::max(most[c], kAlways)) over.push_back(c);
  }
  return over;
}

}  // namespace deliso

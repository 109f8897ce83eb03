#include "surface/repair/lattice/cell_levels.h"

#include <algorithm>
#include <cmath>

#include "surface/repair/lattice/sample_lattice.h"

namespace deliso {

namespace {

// From this level on the levels of neighbouring cells differ by at most one.
constexpr int kGradedLevel = 3;
// A point this near to a side of its cell (in index space) lies on that side.
constexpr double kOnSide = 1e-6;

}  // namespace

CellIndex CellLevels::cell(CellName name) const {
  const auto nx = static_cast<std::uint64_t>(grid_.dims()[0]);
  const auto ny = static_cast<std::uint64_t>(grid_.dims()[1]);
  return {static_cast<std::int32_t>(name % nx), static_cast<std::int32_t>(name / nx % ny),
          static_cast<std::int32_t>(name / nx / ny)};
}

CellIndex CellLevels::cell_of(const Vec3& p) const {
  CellIndex cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = grid_.dims()[axis] - 2;
    cell[axis] = static_cast<std::int32_t>(std::clamp(std::floor(p[axis] / isosurface_.step()[axis]), 0.0, last));
  }
  return cell;
}

void CellLevels::append_cells_of(const Vec3& p, std::vector<CellName>& cells) const {
  const Vec3 margin = kOnSide * isosurface_.step();
  const CellIndex low = cell_of(p - margin);
  const CellIndex high = cell_of(p + margin);
  for (std::int32_t k = low[2]; k <= high[2]; ++k) {
    for (std::int32_t j = low[1]; j <= high[1]; ++j) {
      for (std::int32_t i = low[0]; i <= high[0]; ++i) cells.push_back(name({i, j, k}));
    }
  }
}

void CellLevels::append_active_cells(const CrossingIndex& index, const CellIndex& low, const CellIndex& high,
                                     std::vector<CellName>& cells) const {
  for (std::int32_t k = std::max(low[2], 0); k <= std::min(high[2], index.cell_layers() - 1); ++k) {
    for (std::int32_t j = std::max(low[1], 0); j <= std::min(high[1], index.cell_rows() - 1); ++j) {
      index.for_each_active_cell_in_row(j, k, [&](const CellIndex& cell, std::uint8_t) {
        if (low[0] <= cell[0] && cell[0] <= high[0]) cells.push_back(name(cell));
      });
    }
  }
}

void CellLevels::refine(std::vector<CellName> cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  for (const CellName cell : cells) {
    int& level = level_[cell];
    level = std::min(level + 1, kMaxLatticeLevel);
  }
  grade();
}

void CellLevels::grade() {
  std::vector<CellName> stack;
  for (const auto& [cell, level] : level_) {
    if (level >= kGradedLevel) stack.push_back(cell);
  }
  while (!stack.empty()) {
    const CellName at = stack.back();
    stack.pop_back();
    const int least = level_[at] - 1;
    for_each_neighbour(cell(at), [&](const CellIndex& neighbour) {
      int& level = level_[name(neighbour)];
      if (level >= least) return;
      level = least;
      if (least >= kGradedLevel) stack.push_back(name(neighbour));
    });
  }
}

std::vector<bool> CellLevels::zone() const {
  std::vector<bool> zone(grid_.sample_count(), false);
  for (const auto& [at, level] : level_) {
    zone[at] = true;
    for_each_neighbour(cell(at), [&](const CellIndex& neighbour) { zone[name(neighbour)] = true; });
  }
  return zone;
}

template <class Visit>
void CellLevels::for_each_neighbour(const CellIndex& cell, Visit visit) const {
  for (std::int32_t dk = -1; dk <= 1; ++dk) {
    for (std::int32_t dj = -1; dj <= 1; ++dj) {
      for (std::int32_t di = -1; di <= 1; ++di) {
        const CellIndex c{cell[0] + di, cell[1] + dj, cell[2] + dk};
        bool inside = true;
        for (std::size_t axis = 0; axis < 3; ++axis) inside &= c[axis] >= 0 && c[axis] < grid_.dims()[axis] - 1;
        if (inside && c != cell) visit(c);
      }
    }
  }
}

}  // namespace deliso

#include "volume/marching_cubes/loop_band.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace deliso {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kPlaces = kCellEdges + 1;

// The cheapest paths from one start. Node (i, j) is the chord from corner i to corner start + j; the last node, a full
// turn along both polygons, is the start again. A path must not join one corner to all corners of the other polygon,
// because such a fan would end on the chord with which it began. So the path leaves corner 0 of the first polygon at
// once, and returns to it only after it has left the start of the second. Also it must not make a full turn along the
// second polygon at one corner of the first. Hence there are two layers of nodes: the second layer is for paths that
// have left the corner at which they left the start.
class CheapestPaths {
 public:
  template <class Chord>
  CheapestPaths(std::size_t first_size, std::size_t second_size, const Chord& chord) {
    for (auto& layer : cost_) {
      for (auto& row : layer) row.fill(kInfinity);
    }
    cost_[0][0][0] = chord(0, 0);
    for (std::size_t i = 1; i <= first_size; ++i) {
      for (std::size_t j = 0; j <= second_size; ++j) {
        if (i < first_size && j < second_size) {
          cost_[0][i][j] = (j == 0 ? cost_[0][i - 1][0] : cost_[0][i][j - 1]) + chord(i, j);
        }
        if (j == 0) continue;
        const std::array<double, 3> from = before(i, j);
        cost_[1][i][j] = *std::min_element(from.begin(), from.end()) + chord(i, j);
      }
    }
  }

  [[nodiscard]] double cost(std::size_t i, std::size_t j) const { return cost_[1][i][j]; }
  // How many steps along the second polygon the path to a node has.
  [[nodiscard]] unsigned steps_along_second(std::size_t i, std::size_t j) const {
    unsigned steps = 0;
    for (std::size_t layer = 1; i + j > 0;) {
      bool is_along_second = j > 0;
      if (layer == 1) {
        const std::array<double, 3> from = before(i, j);
        const auto best = std::min_element(from.begin(), from.end()) - from.begin();
        is_along_second = best == 2;
        if (best == 0) layer = 0;
      }
      --(is_along_second ? j : i);
      if (is_along_second) steps |= 1u << (i + j);
    }
    return steps;
  }

 private:
  // The costs of the nodes before a node of the second layer: in either layer along the first polygon, and along the
  // second.
  [[nodiscard]] std::array<double, 3> before(std::size_t i, std::size_t j) const {
    return {cost_[0][i - 1][j], cost_[1][i - 1][j], cost_[1][i][j - 1]};
  }

  std::array<std::array<std::array<double, kPlaces>, kPlaces>, 2> cost_{};
};

}  // namespace

std::vector<LoopBand> loop_bands(std::size_t first_size, std::size_t second_size,
                                 const std::function<double(std::size_t, std::size_t)>& chord_cost) {
  std::array<std::array<double, kCellEdges>, kCellEdges> chord{};
  for (std::size_t i = 0; i < first_size; ++i) {
    for (std::size_t j = 0; j < second_size; ++j) chord[i][j] = chord_cost(i, j);
  }
  std::vector<LoopBand> bands;
  for (std::size_t start = 0; start < second_size; ++start) {
    const CheapestPaths paths(first_size, second_size, [&](std::size_t i, std::size_t j) {
      const auto wrapped = [](std::size_t k, std::size_t size) { return k < size ? k : k - size; };
      return chord[wrapped(i, first_size)][wrapped(start + j, second_size)];
    });
    const double cost = paths.cost(first_size, second_size);
    if (std::isfinite(cost)) bands.push_back({start, paths.steps_along_second(first_size, second_size), cost});
  }
  std::stable_sort(bands.begin(), bands.end(), [](const LoopBand& a, const LoopBand& b) { return a.cost < b.cost; });
  return bands;
}

}  // namespace deliso

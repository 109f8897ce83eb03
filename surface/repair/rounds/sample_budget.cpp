#include "surface/repair/rounds/sample_budget.h"

#include <array>

#include "surface/repair/lattice/cell_pieces.h"

namespace deliso {

namespace {

constexpr double kSamplesPerCrossing = 2;
// So many more are worth a try, for all components together.
constexpr double kMore = 4096;

}  // namespace

SampleBudget::SampleBudget(const ExactSurface& surface) : left_(surface.topology.components.size(), 0) {
  // A grid edge is one of as many of the finer grid as there are pieces across it.
  const auto [x, y, z] = cell_pieces(surface.isosurface);
  const std::array<double, 3> edges = {static_cast<double>(y) * z, static_cast<double>(x) * z,
                                       static_cast<double>(x) * y};
  for (const EdgeCrossing& crossing : surface.topology.crossings) {
    left_[crossing.component] += kSamplesPerCrossing * edges[crossing.axis];
  }
}

std::vector<std::uint32_t> SampleBudget::spend(std::span<const std::uint32_t> component_of_sample,
                                               const std::vector<bool>& done) {
  for (const std::uint32_t c : component_of_sample) {
    if (c < left_.size()) left_[c] -= 1;
  }
  std::vector<std::uint32_t> overdrawn;
  double more = 0;
  for (std::uint32_t c = 0; c < left_.size(); ++c) {
    if (done[c] || left_[c] >= 0) continue;
    overdrawn.push_back(c);
    more -= left_[c];
  }
  if (more <= kMore) overdrawn.clear();
  return overdrawn;
}

}  // namespace deliso

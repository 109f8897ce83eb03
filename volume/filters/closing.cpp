#include "volume/filters/closing.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "volume/regular_isovalue.h"

namespace deliso {

namespace {

// Along a grid edge from a sample b of the solid to one of the layer, at `pad`, the isovalue k comes after (b - k) /
// (b - pad) of the spacing. That is at most this, for the largest b too.
constexpr double kBeyondWall = 0x1p-30;

// The samples in a type that holds them and the layer: a float where both fit, else a double.
template <class Sample>
Samples widened(const SampleArray<Sample>& samples, double pad) {
  constexpr bool kFloatHolds = !std::is_same_v<Sample, double> && !std::is_same_v<Sample, std::int32_t>;
  if constexpr (kFloatHolds) {
    if (std::abs(pad) <= static_cast<double>(std::numeric_limits<float>::max())) {
      return SampleArray<float>(std::vector<float>(samples.begin(), samples.end()));
    }
  }
  return SampleArray<double>(std::vector<double>(samples.begin(), samples.end()));
}

}  // namespace

bool has_solid(const ScalarGrid& grid, double isovalue, Inside inside) {
  const auto [low, high] = grid.range();
  return inside == Inside::kAbove ? isovalue <= high : low < isovalue;
}

ClosedGrid closed_grid(const ScalarGrid& grid, double isovalue, Inside inside) {
  const auto [low, high] = grid.range();
  // Made regular before there is a layer: the gap below the lowest sample would reach down to it.
  const double used = regular_isovalue(grid, isovalue);
  const double pad = inside == Inside::kAbove ? used - (high - used) / kBeyondWall : used + (used - low) / kBeyondWall;
  Samples samples = visit_samples(grid.samples(), [pad](const auto& s) { return widened(s, pad); });
  ScalarGrid closed = padded(ScalarGrid(grid.dims(), std::move(samples), grid.spacing(), grid.origin()), pad);
  closed.set_walls(grid.box());
  return {std::move(closed), used};
}

}  // namespace deliso

#include "volume/sample_neighbors.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace deliso {

namespace {

// Of samples given one after the other, by turns to several searches: no sample waits for the comparison of the one
// before it.
class NeighborSearch {
 public:
  static constexpr std::size_t kTurns = 8;

  explicit NeighborSearch(double value) : value_(value) {
    lower_.fill(-kNone);
    higher_.fill(kNone);
  }
  void add(std::size_t turn, double s) {
    const double below = s < value_ ? s : -kNone, above = s > value_ ? s : kNone;
    lower_[turn] = below > lower_[turn] ? below : lower_[turn];
    higher_[turn] = above < higher_[turn] ? above : higher_[turn];
    equal_[turn] += s == value_ ? 1 : 0;
  }
  [[nodiscard]] Neighbors found() const {
    return {std::any_of(equal_.begin(), equal_.end(), [](double count) { return count > 0; }),
            *std::max_element(lower_.begin(), lower_.end()), *std::min_element(higher_.begin(), higher_.end())};
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double value_;
  std::array<double, kTurns> lower_{}, higher_{}, equal_{};
};

template <class Sample, class Value>
Neighbors find_neighbors_in(const SampleArray<Sample>& samples, double value, const Value& value_of) {
  NeighborSearch search(value);
  const Sample* const at = samples.data();
  std::size_t i = 0;
  for (; i + NeighborSearch::kTurns <= samples.size(); i += NeighborSearch::kTurns) {
    for (std::size_t turn = 0; turn < NeighborSearch::kTurns; ++turn) search.add(turn, value_of(at[i + turn]));
  }
  for (; i < samples.size(); ++i) search.add(0, value_of(at[i]));
  return search.found();
}

}  // namespace

Neighbors find_neighbors(const ScalarGrid& grid, double value) {
  return visit_samples(grid.samples(), [&]<class Sample>(const SampleArray<Sample>& samples) {
    if (!grid.walls()) return find_neighbors_in(samples, value, [](Sample s) { return static_cast<double>(s); });
    return find_neighbors_in(samples, value, [layer = samples.front()](Sample s) {
      return s == layer ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(s);
    });
  });
}

}  // namespace deliso

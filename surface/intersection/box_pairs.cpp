#include "surface/intersection/box_pairs.h"

#include <algorithm>

namespace deliso {

template <class Real>
typename BoxPairs<Real>::Bounds BoxPairs<Real>::Block::bounds() const {
  Bounds bounds;
  for (std::size_t k = 0; k < 3; ++k) {
    bounds.low[k] = *std::min_element(low[k].begin(), low[k].end());
    bounds.high[k] = *std::max_element(high[k].begin(), high[k].end());
  }
  return bounds;
}

// The levels above the lowest.
template <class Real>
void BoxPairs<Real>::enclose() {
  while (levels_.back().size() > 1) {
    const std::vector<Block>& below = levels_.back();
    std::vector<Block> level((below.size() + kParts - 1) / kParts);
    for (std::size_t i = 0; i < below.size(); ++i) level[i / kParts].set(i % kParts, below[i].bounds());
    levels_.push_back(std::move(level));
  }
}

template <class Real>
std::vector<typename BoxPairs<Real>::Task> BoxPairs<Real>::tasks() const {
  if (levels_.empty()) return {};
  auto level = static_cast<std::uint32_t>(levels_.size() - 1);
  std::vector<Task> tasks = {{level, 0, 0}};
  while (level > 0 && levels_[level].size() < kTaskBlocks) {
    std::vector<Task> below;
    // A pair of blocks is split into pairs of their parts, which are blocks of the level below; this ends one level
    // above the boxes.
    const auto add = [&](std::uint32_t a, std::uint32_t b) { below.push_back({level - 1, a, b}); };
    for (const Task& task : tasks) {
      const Block &of_a = levels_[level][task.a], &of_b = levels_[level][task.b];
      for (std::uint32_t i = 0; i < kParts; ++i) {
        std::uint32_t met = of_b.meeting(of_a, i);
        if (task.a == task.b) met = met >> i << i;
        for_each_bit(met, [&](std::uint32_t j) { add(kParts * task.a + i, kParts * task.b + j); });
      }
    }
    tasks = std::move(below);
    --level;
  }
  return tasks;
}

template class BoxPairs<float>;
template class BoxPairs<double>;

}  // namespace deliso

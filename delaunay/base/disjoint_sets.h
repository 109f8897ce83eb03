// Disjoint sets of numbers: union and find (Tarjan, Efficiency of a good but not linear set union algorithm, 1975),
// with path halving.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "delaunay/base/huge_pages.h"

namespace deliso {

// The representative of a set is its smallest member, so results do not depend on the order of the unions.
class DisjointSets {
 public:
  // Each number below `count` is a set of its own.
  explicit DisjointSets(std::size_t count = 0) { reset(count); }
  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // Returns whether i and j were in different sets.
  bool unite(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
    return i != j;
  }
  // Unites the set of a representative with that of j; returns the representative of both.
  std::uint32_t unite_representative(std::uint32_t representative, std::uint32_t j) {
    j = find(j);
    const std::uint32_t low = std::min(representative, j);
    parent_[std::max(representative, j)] = low;
    return low;
  }
  // A look at the parents alone: true tells that i and j are in one set, false tells nothing.
  [[nodiscard]] bool share_parent(std::uint32_t i, std::uint32_t j) const { return parent_[i] == parent_[j]; }

 private:
  LargeArray<std::uint32_t> parent_;
};

}  // namespace deliso

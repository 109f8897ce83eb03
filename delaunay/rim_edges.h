// Glues the tetrahedra of a star: for each directed edge of a cavity's rim, the facet that stands on it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "delaunay/ids.h"

namespace deliso {

// A map from pairs of small numbers to facets. Every pair is written before it is read, so nothing is ever cleared: a
// square table for the usual cavities, a hash table for the rare enormous ones.
class RimEdges {
 public:
  // Prepares for numbers below `numbers` and at most `edges` pairs.
  void start(std::uint32_t numbers, std::size_t edges) {
    is_square_ = numbers <= kLargestSquare;
    if (is_square_) {
      while ((1u << shift_) < numbers) ++shift_;
      if (square_.size() < std::size_t{1} << (2 * shift_)) square_.resize(std::size_t{1} << (2 * shift_));
    } else {
      std::size_t size = 1;
      while (size < 2 * edges) size *= 2;
      entries_.assign(size, Entry{});
    }
  }

  FacetId& at(std::uint32_t from, std::uint32_t to) {
    return is_square_ ? square_[(from << shift_) | to] : hashed(from, to);
  }

 private:
  static constexpr std::uint32_t kLargestSquare = 512;
  struct Entry {
    std::uint64_t key = 0;  // no pair is (0, 0)
    FacetId facet;
  };

  FacetId& hashed(std::uint32_t from, std::uint32_t to) {
    const std::uint64_t key = (static_cast<std::uint64_t>(from) << 32) | to;
    const std::size_t mask = entries_.size() - 1;
    std::size_t i = ((key * 0x9E3779B97F4A7C15ull) >> 24) & mask;
    while (entries_[i].key != key && entries_[i].key != 0) i = (i + 1) & mask;
    entries_[i].key = key;
    return entries_[i].facet;
  }

  bool is_square_ = true;
  unsigned shift_ = 5;
  std::vector<FacetId> square_;
  std::vector<Entry> entries_;
};

}  // namespace deliso

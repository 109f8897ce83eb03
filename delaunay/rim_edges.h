// Glues the tetrahedra of a star: for each directed edge of a cavity's rim, the new facet at this edge.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "delaunay/ids.h"

namespace deliso {

// A map from pairs of small numbers to facets, as a square table. Every pair is written before it is read, so nothing
// is ever cleared.
class SquareEdgeTable {
 public:
  static constexpr std::uint32_t kMostNumbers = 512;

  // Prepares for numbers below `numbers` <= kMostNumbers.
  void start(std::uint32_t numbers) {
    while ((1u << shift_) < numbers) ++shift_;
    if (table_.size() < std::size_t{1} << (2 * shift_)) table_.resize(std::size_t{1} << (2 * shift_));
  }
  FacetId& at(std::uint32_t from, std::uint32_t to) { return table_[(from << shift_) | to]; }

 private:
  unsigned shift_ = 5;
  std::vector<FacetId> table_;
};

// The same as a hash table, for the rare cavity that is too large for a square table.
class HashedEdgeTable {
 public:
  // Prepares for at most `edges` pairs.
  explicit HashedEdgeTable(std::size_t edges) : entries_(std::bit_ceil(2 * edges)) {}

  FacetId& at(std::uint32_t from, std::uint32_t to) {
    const std::uint64_t key = (static_cast<std::uint64_t>(from) << 32) | to;
    const std::size_t mask = entries_.size() - 1;
    std::size_t i = ((key * 0x9E3779B97F4A7C15ull) >> 24) & mask;
    while (entries_[i].key != key && entries_[i].key != 0) i = (i + 1) & mask;
    entries_[i].key = key;
    return entries_[i].facet;
  }

 private:
  struct Entry {
    std::uint64_t key = 0;  // no pair is (0, 0)
    FacetId facet;
  };
  std::vector<Entry> entries_;
};

}  // namespace deliso

// Glues the tetrahedra of a star: a small open-addressing table of the edges of a cavity's rim.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/ids.h"

namespace deliso {

// Every edge of the rim lies in exactly two facets of it, so every edge comes twice: the first time it is kept, the
// second time it finds its partner. The table is never cleared (its entries carry the number of the cavity) and fits in
// the first-level cache for all but enormous cavities.
class RimEdges {
 public:
  // Prepares for a cavity whose rim has `facets` facets (hence 3/2 as many edges).
  void start(std::size_t facets) {
    if (4 * facets > entries_.size()) {
      std::size_t size = 256;
      while (size < 4 * facets) size *= 2;
      entries_.assign(size, Entry{});
      shift_ = 64;
      while (size > 1) {
        size /= 2;
        --shift_;
      }
      cavity_ = 0;
    }
    if (++cavity_ == 0) {  // the numbers have come round
      std::fill(entries_.begin(), entries_.end(), Entry{});
      cavity_ = 1;
    }
  }

  // The facet that came with the edge {a, b} before, or none, and then keeps `facet` for it.
  FacetId match(VertexId a, VertexId b, FacetId facet) {
    const std::uint32_t low = std::min(a.value, b.value);
    const std::uint32_t high = std::max(a.value, b.value);
    const std::uint64_t key = (static_cast<std::uint64_t>(high) << 32) | low;
    const std::size_t mask = entries_.size() - 1;
    for (std::size_t i = (key * 0x9E3779B97F4A7C15ull) >> shift_;; i = (i + 1) & mask) {
      Entry& entry = entries_[i];
      if (entry.cavity != cavity_) {
        entry = {key, cavity_, facet};
        return FacetId();
      }
      if (entry.key == key) return entry.facet;
    }
  }

 private:
  struct Entry {
    std::uint64_t key = 0;
    std::uint32_t cavity = 0;
    FacetId facet;
  };
  std::vector<Entry> entries_;
  std::uint32_t cavity_ = 0;
  unsigned shift_ = 0;
};

}  // namespace deliso

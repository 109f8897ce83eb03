// The elements of a mesh that are left to refine, in both stages, in the order of their rank.
//
// The worst or largest element comes first. Elements whose numbers share a power of two come block by block (32 voxels
// on a side), blocks along a space-filling curve (Morton), and within a block the worst first. So refinement proceeds
// from coarse to fine everywhere, and consecutive insertions find their neighbourhoods in the caches.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "delaunay/base/vec3.h"

namespace deliso {

// Ranks by a non-negative number: its bits as a float, which compare like the number.
inline std::uint64_t plain_rank(double key) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return std::bit_cast<std::uint32_t>(static_cast<float>(std::min(std::max(0.0, key), kMost)));
}

// Ranks by the number's power of two, then by the block of a point in mesh space, then by the number. So the rank is
// the exponent of a float, then the block, then the other bits of the float.
inline std::uint64_t block_rank(double key, const Vec3& where) {
  // Eight bits of every coordinate, interleaved; points beyond count with the outermost block.
  constexpr double kSide = 32;
  constexpr double kLast = 255;
  std::uint64_t block = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::uint32_t c = static_cast<std::uint32_t>(std::min(std::max(0.0, where[axis] / kSide), kLast));
    c = (c | c << 8) & 0x0F00Fu;
    c = (c | c << 4) & 0xC30C3u;
    c = (c | c << 2) & 0x249249u;
    block |= std::uint64_t{c} << axis;
  }
  const std::uint64_t bits = plain_rank(key);
  return ((bits >> 23) << 56) | (block << 32) | bits;
}

// An element and its generation when it was queued. If the generation has changed, the entry is stale.
struct QueuedElement {
  std::uint32_t element = 0;
  std::uint32_t generation = 0;
};

struct RankedElement {
  std::uint64_t rank = 0;
  QueuedElement queued;
};

// Pops the highest rank first; or, if so constructed, first in, first out.
//
// Ranks with equal upper halves share a bucket, which becomes a heap when its turn comes. For block_rank() a bucket is
// the part of one block with one power of two, which is small enough for the cache.
class BucketQueue {
 public:
  void push(std::uint64_t rank, const QueuedElement& queued) {
    Bucket& bucket = bucket_at(static_cast<std::uint32_t>(rank >> 32));
    bucket.entries.push_back({static_cast<std::uint32_t>(rank), queued});
    if (bucket.is_heap) std::push_heap(bucket.entries.begin(), bucket.entries.end());
    ++size_;
  }
  void push_by_age(const QueuedElement& queued) { push(--next_age_, queued); }
  // Puts back what pop() or take_all() gave, of this queue or another one. The element keeps its rank and its age.
  void put_back(const RankedElement& element) {
    next_age_ = std::min(next_age_, element.rank);
    push(element.rank, element.queued);
  }

  std::optional<RankedElement> pop() {
    if (size_ == 0) return std::nullopt;
    --size_;
    Bucket& bucket = buckets_[places_.front().place];
    if (!bucket.is_heap) std::make_heap(bucket.entries.begin(), bucket.entries.end());
    bucket.is_heap = true;
    std::pop_heap(bucket.entries.begin(), bucket.entries.end());
    const RankedElement top = ranked(bucket, bucket.entries.back());
    bucket.entries.pop_back();
    if (bucket.entries.empty()) drop_first_bucket();
    return top;
  }
  // Empties the queue, in unspecified order.
  template <class Visit>
  void take_all(Visit&& visit) {
    for (const Bucket& bucket : buckets_) {
      for (const Entry& entry : bucket.entries) visit(ranked(bucket, entry));
    }
    buckets_.clear();
    free_.clear();
    place_of_.clear();
    places_.clear();
    latest_.fill(0);
    size_ = 0;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  // What pop() would give next, if that is known without work; for prefetching.
  [[nodiscard]] std::optional<std::uint32_t> next() const {
    if (size_ == 0) return std::nullopt;
    const Bucket& bucket = buckets_[places_.front().place];
    if (!bucket.is_heap) return std::nullopt;
    return bucket.entries.front().queued.element;
  }

 private:
  struct Entry {
    std::uint32_t rank;  // the lower half
    QueuedElement queued;
    // The standard heap pops the greatest. This is a total order, so every standard library pops in the same order.
    bool operator<(const Entry& b) const {
      if (rank != b.rank) return rank < b.rank;
      if (queued.element != b.queued.element) return queued.element > b.queued.element;
      return queued.generation < b.queued.generation;
    }
  };
  struct Place {
    std::uint32_t key = 0;
    std::uint32_t place = 0;
    bool operator<(const Place& b) const { return key < b.key; }
  };
  struct Bucket {
    std::uint32_t key = 0;  // the upper half of the ranks
    bool is_heap = false;
    std::vector<Entry> entries;  // entries; empty only while the bucket is free
  };

  static constexpr std::size_t kMostKept = 16;  // entries

  static RankedElement ranked(const Bucket& bucket, const Entry& entry) {
    return {std::uint64_t{bucket.key} << 32 | entry.rank, entry.queued};
  }
  Bucket& bucket_at(std::uint32_t key) {
    std::uint32_t& latest = latest_[key >> 24];
    if (latest < buckets_.size() && buckets_[latest].key == key && !buckets_[latest].entries.empty()) {
      return buckets_[latest];
    }
    const auto [at, is_new] = place_of_.try_emplace(key, static_cast<std::uint32_t>(buckets_.size()));
    if (is_new) {
      if (free_.empty()) {
        buckets_.emplace_back();
      } else {
        at->second = free_.back();
        free_.pop_back();
      }
      buckets_[at->second].key = key;
      places_.push_back({key, at->second});
      std::push_heap(places_.begin(), places_.end());
    }
    latest = at->second;
    return buckets_[latest];
  }
  void drop_first_bucket() {
    const auto [key, place] = places_.front();
    Bucket& bucket = buckets_[place];
    bucket.is_heap = false;
    // Otherwise the next bucket reuses the memory.
    if (bucket.entries.capacity() > kMostKept) bucket.entries = std::vector<Entry>();
    free_.push_back(place);
    place_of_.erase(key);
    std::pop_heap(places_.begin(), places_.end());
    places_.pop_back();
  }

  std::vector<Bucket> buckets_;
  std::vector<std::uint32_t> free_;                            // buckets
  std::unordered_map<std::uint32_t, std::uint32_t> place_of_;  // of the used buckets, by key
  std::vector<Place> places_;                                  // the keys of the used buckets, a heap
  std::array<std::uint32_t, 256> latest_{};                    // for each power of two: the bucket accessed last
  std::size_t size_ = 0;
  std::uint64_t next_age_ = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace deliso

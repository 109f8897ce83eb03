// Long rows of elements in blocks of one size, for several threads. The size never depends on how many threads there
// are, and blocks are joined in order; so results do not depend on it either.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <iterator>
#include <vector>

#include "delaunay/base/parallel.h"

namespace deliso {

inline constexpr std::size_t kBlockSize = 16384;

// Calls body(first, last) for each block of the elements below `count`. A body writes to the places of its elements
// only.
template <class Body>
void for_each_block(std::size_t count, int threads, Body&& body, std::size_t block_size = kBlockSize) {
  run_tasks((count + block_size - 1) / block_size, threads,
            [&](std::size_t block) { body(block * block_size, std::min(count, (block + 1) * block_size)); });
}

// One share of a row of elements per thread, of so many elements at least: for work whose cost depends on where the row
// is cut, but whose result does not.
class Shares {
 public:
  Shares(std::size_t elements, int threads, std::size_t fewest = kBlockSize)
      : elements_(elements),
        count_(std::clamp(elements / fewest, std::size_t{1}, static_cast<std::size_t>(std::max(threads, 1)))) {}
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t begin(std::size_t share) const { return share * elements_ / count_; }  // share <= count()

  // Calls body(share, first, last) for each share. A body writes to the places of its elements only.
  template <class Body>
  void for_each(int threads, Body&& body) const {
    run_tasks(count_, threads, [&](std::size_t share) { body(share, begin(share), begin(share + 1)); });
  }

 private:
  std::size_t elements_;
  std::size_t count_;
};

// Tasks of two steps: first(i) one after the other in order, second(i) after it, beside the steps of later tasks. When
// a step throws, its task ends; the others go on, and the exception of the lowest number is thrown on after all.
template <class First, class Second>
void run_in_turn(std::size_t count, int threads, First&& first, Second&& second) {
  std::atomic<std::size_t> turn{0};
  struct Pass {  // the turn on, whatever happens
    std::atomic<std::size_t>& turn;
    ~Pass() {
      ++turn;
      turn.notify_all();
    }
  };
  run_tasks(count, threads, [&](std::size_t i) {
    for (std::size_t now = turn; now != i; now = turn) turn.wait(now);
    {
      const Pass pass{turn};
      first(i);
    }
    second(i);
  });
}

// What append(element, items) appends for the elements below `count`, in their order.
template <class Item, class Append>
std::vector<Item> collect_in_blocks(std::size_t count, int threads, Append&& append) {
  std::vector<std::vector<Item>> found((count + kBlockSize - 1) / kBlockSize);
  for_each_block(count, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) append(i, found[first / kBlockSize]);
  });
  std::size_t total = 0;
  for (const std::vector<Item>& some : found) total += some.size();
  std::vector<Item> items;
  items.reserve(total);
  for (std::vector<Item>& some : found) {
    std::move(some.begin(), some.end(), std::back_inserter(items));
    std::vector<Item>().swap(some);
  }
  return items;
}

}  // namespace deliso

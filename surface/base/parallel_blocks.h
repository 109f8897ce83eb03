// Rows of elements in blocks of a fixed size, for several threads. The size does not depend on the number of threads,
// and blocks are joined in order; so results do not depend on the number of threads either.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <iterator>
#include <vector>

#include "delaunay/base/parallel.h"

namespace deliso {

inline constexpr std::size_t kBlockSize = 16384;

// Calls body(first, last) for each block of the elements below `count`. A body writes only to data of its own elements.
template <class Body>
void for_each_block(std::size_t count, int threads, Body&& body, std::size_t block_size = kBlockSize) {
  run_tasks((count + block_size - 1) / block_size, threads,
            [&](std::size_t block) { body(block * block_size, std::min(count, (block + 1) * block_size)); });
}

// Cuts a row of elements into one share per thread, each of at least so many elements. For work whose cost depends on
// the cuts, but whose result does not.
class Shares {
 public:
  Shares(std::size_t elements, int threads, std::size_t fewest = kBlockSize)
      : elements_(elements),
        count_(std::clamp(elements / fewest, std::size_t{1}, static_cast<std::size_t>(std::max(threads, 1)))) {}
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t begin(std::size_t share) const { return share * elements_ / count_; }  // share <= count()

  // Calls body(share, first, last) for each share. A body writes only to data of its own elements.
  template <class Body>
  void for_each(int threads, Body&& body) const {
    run_tasks(count_, threads, [&](std::size_t share) { body(share, begin(share), begin(share + 1)); });
  }

 private:
  std::size_t elements_;
  std::size_t count_;
};

// Lets tasks do one of their steps one after the other, in the order of their numbers.
class Turns {
 public:
  // Waits for the turn of a task, does its step, and passes the turn on, even if the step throws.
  template <class Step>
  void take(std::size_t task, const Step& step) {
    for (std::size_t now = turn_; now != task; now = turn_) turn_.wait(now);
    struct Pass {
      std::atomic<std::size_t>& turn;
      ~Pass() {
        ++turn;
        turn.notify_all();
      }
    } const pass{turn_};
    step();
  }

 private:
  std::atomic<std::size_t> turn_{0};
};

// Tasks of three steps, first(i), second(i) and last(i), in this order. All first steps run one after the other in the
// order of the tasks, and so do all second steps; apart from that, steps of different tasks run at the same time. When
// a step throws, its task ends. The other tasks go on, and then the exception of the lowest task is rethrown.
template <class First, class Second, class Last>
void run_in_turn(std::size_t count, int threads, First&& first, Second&& second, Last&& last) {
  Turns first_turns, second_turns;
  run_tasks(count, threads, [&](std::size_t i) {
    std::exception_ptr error;
    first_turns.take(i, [&] {
      try {
        first(i);
      } catch (...) {
        error = std::current_exception();
      }
    });
    second_turns.take(i, [&] {
      if (error != nullptr) std::rethrow_exception(error);
      second(i);
    });
    last(i);
  });
}

// Collects what append(element, items) appends for the elements below `count`, in their order.
template <class Item, class Append>
std::vector<Item> collect_in_blocks(std::size_t count, int threads, Append&& append,
                                    std::size_t block_size = kBlockSize) {
  std::vector<std::vector<Item>> found((count + block_size - 1) / block_size);
  const auto collect = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) append(i, found[first / block_size]);
  };
  for_each_block(count, threads, collect, block_size);
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

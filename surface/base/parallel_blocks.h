// Long rows of elements in blocks of one size, for several threads. The size never depends on how many threads there
// are, and blocks are joined in order; so results do not depend on it either.
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

// Tasks that take their turn at a step, in the order of their numbers.
class Turns {
 public:
  // Waits for the turn of a task, does its step, and passes the turn on, whatever happens.
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

// Tasks of three steps, first(i), second(i) and last(i) one after the other: first steps in the order of the tasks, and
// second steps, too, each beside any other steps of other tasks. When a step throws, its task ends; the others go on,
// and the exception of the lowest number is thrown on after all.
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

// What append(element, items) appends for the elements below `count`, in their order.
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

// Independent tasks on several threads. Results must not depend on who runs which task: a task writes to its own places
// only.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace deliso {

// Calls body(i) once for each i below `count`, on at most `threads` threads, this one among them; tasks begin in the
// order of their numbers. When bodies throw, the exception of the lowest number is thrown on, after all have ended.
template <class Body>
void run_tasks(std::size_t count, int threads, Body&& body) {
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> errors(count);
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> helpers;  // joined at the end of this block, whatever happens
    const std::size_t wanted = std::min(count, static_cast<std::size_t>(std::max(threads, 1)));
    try {
      while (helpers.size() + 1 < wanted) helpers.emplace_back(work);
    } catch (const std::exception&) {
      // No more threads to be had: those there are do the work.
    }
    work();
  }
  const auto first = std::find_if(errors.begin(), errors.end(), [](const auto& error) { return error != nullptr; });
  if (first != errors.end()) std::rethrow_exception(*first);
}

}  // namespace deliso

// Independent tasks on several threads. Results must not depend on which thread runs which task: a task writes only to
// elements of its own.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

namespace deliso {

// Who runs the tasks instead of threads, where a program sets one before it begins: tests/bench/bench_threads.cpp has
// them run one after the other, which tells what more threads would give. Without it no speed-up can be measured beyond
// the number of processors at hand.
using TaskRunner = std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;
inline TaskRunner& task_runner() {
  static TaskRunner runner;
  return runner;
}

// Calls body(i) once for each i below `count`, on at most `threads` threads including the caller's. Tasks begin in
// ascending order of i. If bodies throw, the exception of the lowest i is rethrown after all tasks have ended.
template <class Body>
void run_tasks(std::size_t count, int threads, Body&& body) {
  if (threads > 1 && task_runner()) return task_runner()(count, std::forward<Body>(body));
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
      // No more threads can be created: the existing ones do the work.
    }
    work();
  }
  const auto first = std::find_if(errors.begin(), errors.end(), [](const auto& error) { return error != nullptr; });
  if (first != errors.end()) std::rethrow_exception(*first);
}

}  // namespace deliso

// Runs side by side, each in a process of its own: so memory is that of a run alone, and one that ends a process, ends
// its own run.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "experiments/config/json.h"

namespace deliso {

// Makes run `index`; nothing when it was stopped from outside.
using MakeRun = std::function<std::optional<Json>(std::size_t index)>;

// What came of a run, told in the process that calls run_side_by_side: its record, or why there is none.
struct WorkerResult {
  std::size_t index = 0;
  std::optional<Json> record;
  bool is_stopped = false;
  std::string failure;  // of its process: "was ended by signal 9"
};

// Makes the runs 0 to count - 1, `jobs` of them at a time, and calls `done` for each as it ends. `begin` is called once
// in each process. `next_wanted` is asked before every run whether more are wanted. Precondition: this process has no
// other threads.
void run_side_by_side(std::size_t count, int jobs, const std::function<void()>& begin, const MakeRun& make,
                      const std::function<bool()>& next_wanted, const std::function<void(WorkerResult)>& done);

}  // namespace deliso

// How a caller watches and stops a run: the limits of the budget, the stop flag and the progress callback in one place.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string_view>
#include <thread>
#include <utility>

#include "delaunay/base/stopwatch.h"
#include "surface/base/parameters.h"

namespace deliso {

class Observer;

// What a caller may watch. Called now and then from the mesher's own thread.
struct Progress {
  std::string_view stage;     // "index", "initial", "recover", "repair", "refine", "shape", "certify"
  std::int64_t vertices = 0;  // so far, of the whole mesh or of the part at hand
  std::int64_t queued = 0;    // violations still waiting
};

class Controls {
 public:
  Controls(const BudgetParameters& budget, const std::atomic<bool>* stop, std::function<void(const Progress&)> progress)
      : budget_(budget), stop_(stop), progress_(std::move(progress)) {}

  // Who is told of the steps of repair; null: nobody.
  void set_observer(Observer* observer) { observer_ = observer; }
  [[nodiscard]] Observer* observer() const { return observer_; }

  // Announces that a stage begins.
  void enter(std::string_view stage) {
    stage_ = stage;
    report(stage, 0, 0);
  }
  // The stage in which the run had to stop; empty if it did not have to.
  [[nodiscard]] std::string_view stopped_in() const { return stopped_in_; }

  // Call before each attempted insertion. True when the run must end now; once true, it stays true.
  bool must_stop(std::string_view stage, std::size_t vertices, std::size_t queued) {
    if (stopped_) return true;
    if (budget_.max_vertices && static_cast<std::int64_t>(vertices) >= *budget_.max_vertices) return stop();
    if ((calls_++ & 255u) != 0) return false;
    if (poll()) return true;
    report(stage, vertices, queued);
    return false;
  }
  // The same between larger pieces of work without insertions: checks the clock and the stop flag.
  bool poll() { return stopped_ || (is_over() && stop()); }
  // Whether the next poll would say so; once true, it stays true, also of all parts, however the caller's flag changes.
  // For several threads at once, while none polls.
  [[nodiscard]] bool is_over() const {
    if (stopped_ || was_over_->load(std::memory_order_relaxed)) return true;
    const bool is_over = (stop_ != nullptr && stop_->load(std::memory_order_relaxed)) ||
                         (budget_.seconds && watch_.seconds() > *budget_.seconds);
    if (is_over) was_over_->store(true, std::memory_order_relaxed);
    return is_over;
  }
  void report(std::string_view stage, std::size_t vertices, std::size_t queued) const {
    if (progress_) progress_({stage, static_cast<std::int64_t>(vertices), static_cast<std::int64_t>(queued)});
  }
  [[nodiscard]] bool stopped() const { return stopped_; }

  // Controls for a part of the work, on any thread. They have the same limits, but only the fraction `share` of the
  // vertices still allowed beyond `vertices`; the part says with how many vertices it begins. They report progress only
  // from the thread that calls this.
  [[nodiscard]] Controls for_part(double share, std::size_t vertices) const {
    Controls part = *this;
    part.calls_ = 0;
    if (budget_.max_vertices) {
      const double left = std::max(static_cast<double>(*budget_.max_vertices) - static_cast<double>(vertices), 0.0);
      part.budget_.max_vertices = static_cast<std::int64_t>(share * left);
    }
    if (part.progress_) {
      part.progress_ = [report = progress_, thread = std::this_thread::get_id()](const Progress& progress) {
        if (std::this_thread::get_id() == thread) report(progress);
      };
    }
    return part;
  }
  // Call once on the result of for_part.
  void part_begins_with(std::size_t vertices) {
    if (budget_.max_vertices) *budget_.max_vertices += static_cast<std::int64_t>(vertices);
  }

 private:
  bool stop() {
    stopped_in_ = stage_;
    return stopped_ = true;
  }

  BudgetParameters budget_;
  const std::atomic<bool>* stop_;
  // Work that a check has left out is not known from an empty finding: whoever asks later must hear the same answer.
  std::shared_ptr<std::atomic<bool>> was_over_ = std::make_shared<std::atomic<bool>>(false);
  std::function<void(const Progress&)> progress_;
  Observer* observer_ = nullptr;
  Stopwatch watch_;
  std::uint32_t calls_ = 0;
  std::string_view stage_, stopped_in_;
  bool stopped_ = false;
};

}  // namespace deliso

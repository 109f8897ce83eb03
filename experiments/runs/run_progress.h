// The progress of an experiment, and an estimate of the time left.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include "delaunay/base/stopwatch.h"
#include "surface/base/controls.h"

namespace deliso {

// "45 s", "12 min", "3 h 20 min".
std::string duration_text(double seconds);

// The estimated seconds of the remaining runs, from the runs that have ended: a run takes the mean time of the runs of
// its data set or, if there are none yet, the mean time of all runs. Negative while no run has ended.
class RemainingTime {
 public:
  // `datasets` is the data set of each run, in their order.
  explicit RemainingTime(std::vector<std::size_t> datasets) : datasets_(std::move(datasets)) {}

  // The next run has ended.
  void finished(double seconds);
  [[nodiscard]] double seconds() const;

 private:
  struct Finished {
    std::size_t dataset;
    double seconds;
  };
  std::vector<std::size_t> datasets_;
  std::vector<Finished> finished_;
  std::size_t next_ = 0;
};

// On a terminal one line that is redrawn; elsewhere, if asked for, one line for every run that ends.
class RunProgress {
 public:
  enum class Style { kSilent, kBar, kLines };
  RunProgress(std::ostream& stream, Style style) : stream_(stream), style_(style) {}
  ~RunProgress() { wipe(); }
  RunProgress(const RunProgress&) = delete;
  RunProgress& operator=(const RunProgress&) = delete;

  // The data set of each run to come, in their order.
  void plan(std::vector<std::size_t> datasets);
  void begin(const std::string& run_name);
  void show(const Progress& progress);
  void finished(double seconds);
  // Removes the line, so that a message can be written.
  void wipe();

 private:
  [[nodiscard]] std::string position() const;

  std::ostream& stream_;
  Style style_;
  std::size_t count_ = 0;
  RemainingTime remaining_{{}};
  std::size_t number_ = 0;  // of the current run, from 1
  std::string name_;
  bool drawn_ = false;
  double last_seconds_ = -1;
  Stopwatch stopwatch_;
};

}  // namespace deliso

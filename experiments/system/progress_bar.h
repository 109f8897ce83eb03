// One line on a terminal that shows the mesher's progress.
#pragma once

#include <ostream>

#include "delaunay/base/stopwatch.h"
#include "surface/deliso.h"

namespace deliso {

// Draws at most ten times a second and wipes its line when destroyed.
class ProgressBar {
 public:
  // Nothing is drawn unless `visible`.
  ProgressBar(std::ostream& stream, bool visible) : stream_(stream), visible_(visible) {}
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);

 private:
  std::ostream& stream_;
  bool visible_;
  bool drawn_ = false;
  double last_seconds_ = -1;
  Stopwatch stopwatch_;
};

// Whether stderr is a terminal.
bool stderr_is_terminal();

}  // namespace deliso

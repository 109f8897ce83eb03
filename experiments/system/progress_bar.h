// One line on a terminal that shows how far a command is.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

#include "delaunay/base/stopwatch.h"
#include "surface/deliso.h"

namespace deliso {

// Draws as often as the interval lets it, and wipes its line when destroyed. What is shown never goes back: parts of
// the work that are done apart from each other count their own vertices.
class ProgressBar {
 public:
  // Nothing is drawn unless `visible`. `interval`: seconds between two drawings, at least.
  ProgressBar(std::ostream& stream, bool visible, double interval = 0.1)
      : stream_(stream), visible_(visible), interval_(interval) {}
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Of the mesher.
  void show(const Progress& progress);
  // Of any command: which fraction is done, and of what.
  void show(double share, std::string_view step);

 private:
  void draw(const std::string& text, double now);

  std::ostream& stream_;
  bool visible_;
  double interval_;
  bool drawn_ = false;
  double last_seconds_ = -1;
  double share_ = 0;  // the largest so far
  std::string stage_;
  std::int64_t vertices_ = 0;  // the most of this stage
  Stopwatch stopwatch_;
};

// The line: a bar with so much of it filled, and a text, cut at `width` columns. In a narrow terminal there is no bar.
std::string progress_line(double share, const std::string& text, std::size_t width);

// Columns of the terminal: by the variable COLUMNS, by the terminal itself, or else 80.
std::size_t terminal_width();

// Whether stderr is a terminal.
bool stderr_is_terminal();

}  // namespace deliso

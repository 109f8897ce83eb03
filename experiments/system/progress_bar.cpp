#include "experiments/system/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <iomanip>
#include <string>
#include <string_view>

namespace deliso {
namespace {

constexpr std::array<std::string_view, 7> kStages = {"index",  "initial", "recover", "repair",
                                                     "refine", "shape",   "certify"};
constexpr int kWidth = 28;

// The stages share the bar evenly. Within a stage, the fraction is vertices done over vertices done plus violations
// waiting. The number of violations still to come is unknown, so the bar may slow down, but it shows which stage is
// running.
double filled_share(const Progress& progress) {
  const auto stage = std::find(kStages.begin(), kStages.end(), progress.stage) - kStages.begin();
  const auto done = static_cast<double>(progress.vertices);
  const double all = done + static_cast<double>(progress.queued);
  const double within = progress.queued > 0 && all > 0 ? done / all : 0;
  return std::min(1.0, (static_cast<double>(stage) + within) / static_cast<double>(kStages.size()));
}

}  // namespace

ProgressBar::~ProgressBar() {
  if (drawn_) stream_ << "\r\033[K" << std::flush;
}

void ProgressBar::show(const Progress& progress) {
  const double now = stopwatch_.seconds();
  if (!visible_ || (drawn_ && now - last_seconds_ < 0.1)) return;
  const int filled = static_cast<int>(filled_share(progress) * kWidth);
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(kWidth, '.');
  stream_ << "\r\033[K[" << bar << "] " << progress.stage << "  " << progress.vertices << " vertices, "
          << progress.queued << " waiting, " << std::fixed << std::setprecision(1) << now << " s" << std::flush;
  last_seconds_ = now;
  drawn_ = true;
}

bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }

}  // namespace deliso

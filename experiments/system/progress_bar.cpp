#include "experiments/system/progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "surface/base/progress_share.h"

namespace deliso {

std::string progress_line(double share, const std::string& text, std::size_t width) {
  // The length depends on the width alone, so that the bar stays still while the text grows.
  constexpr std::size_t kLongestBar = 28, kShortestBar = 6;
  const std::size_t length = std::min(kLongestBar, width * 7 / 20);
  if (length < kShortestBar) return text.substr(0, width);
  std::string bar(static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(length)), '#');
  bar.resize(length, '.');
  return ("[" + bar + "] " + text).substr(0, width);
}

ProgressBar::~ProgressBar() {
  if (drawn_) stream_ << "\r\033[K" << std::flush;
}

void ProgressBar::show(const Progress& progress) {
  const double now = stopwatch_.seconds();
  // Stages do not come back, but for the shape of what was refined by distance: that is a part of refinement.
  const double share = share_of_run(progress);
  const bool is_back = share < share_ && progress.stage != stage_;
  if (!is_back && progress.stage != stage_) {
    stage_ = progress.stage;
    vertices_ = 0;
  }
  share_ = std::max(share_, share);
  vertices_ = std::max(vertices_, progress.vertices);
  if (!visible_ || (drawn_ && now - last_seconds_ < interval_)) return;
  draw(stage_ + "  " + std::to_string(vertices_) + " vertices, " + std::to_string(progress.queued) + " waiting", now);
}

void ProgressBar::show(double share, std::string_view step) {
  const double now = stopwatch_.seconds();
  share_ = std::max(share_, share);
  stage_ = step;
  if (!visible_ || (drawn_ && now - last_seconds_ < interval_)) return;
  draw(stage_, now);
}

void ProgressBar::draw(const std::string& text, double now) {
  std::array<char, 32> seconds{};
  std::snprintf(seconds.data(), seconds.size(), ", %.1f s", now);
  // The last column stays free: terminals go on to the next line after it.
  stream_ << "\r\033[K" << progress_line(share_, text + seconds.data(), terminal_width() - 1) << std::flush;
  last_seconds_ = now;
  drawn_ = true;
}

std::size_t terminal_width() {
  constexpr std::size_t kUsual = 80, kFewest = 2, kMost = 10000;
  if (const char* const columns = std::getenv("COLUMNS")) {
    const std::string_view text = columns;
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && value >= kFewest && value <= kMost) return value;
  }
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col >= kFewest) return size.ws_col;
  return kUsual;
}

bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }

}  // namespace deliso

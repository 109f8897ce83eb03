#include "experiments/runs/run_progress.h"

#include <cmath>
#include <cstdint>

namespace deliso {

std::string duration_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  if (whole < 90) return std::to_string(whole) + " s";
  const std::int64_t minutes = (whole + 30) / 60;
  if (minutes < 90) return std::to_string(minutes) + " min";
  return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

void RemainingTime::finished(double seconds) {
  finished_.push_back({datasets_[next_], seconds});
  ++next_;
}

double RemainingTime::seconds() const {
  if (finished_.empty()) return -1;
  double sum = 0;
  for (std::size_t i = next_; i < datasets_.size(); ++i) {
    double same_sum = 0;
    double all_sum = 0;
    int same = 0;
    for (const Finished& run : finished_) {
      all_sum += run.seconds;
      if (run.dataset != datasets_[i]) continue;
      same_sum += run.seconds;
      ++same;
    }
    sum += same > 0 ? same_sum / same : all_sum / static_cast<double>(finished_.size());
  }
  return sum;
}

std::string RunProgress::position() const {
  std::string text = "[" + std::to_string(number_) + "/" + std::to_string(count_) + "] " + name_;
  if (const double left = remaining_.seconds(); left >= 0) text += ", about " + duration_text(left) + " left";
  return text;
}

void RunProgress::plan(std::vector<std::size_t> datasets) {
  count_ = datasets.size();
  remaining_ = RemainingTime(std::move(datasets));
}

void RunProgress::begin(const std::string& run_name) {
  ++number_;
  name_ = run_name;
  last_seconds_ = -1;
  show({"index", 0, 0});
}

void RunProgress::show(const Progress& progress) {
  const double now = stopwatch_.seconds();
  if (style_ != Style::kBar || (last_seconds_ >= 0 && now - last_seconds_ < 0.1)) return;
  stream_ << "\r\033[K" << position() << ": " << progress.stage << ", " << progress.vertices << " vertices"
          << std::flush;
  last_seconds_ = now;
  drawn_ = true;
}

void RunProgress::finished(double seconds) {
  remaining_.finished(seconds);
  if (style_ == Style::kLines) stream_ << position() << " (took " << duration_text(seconds) << ")\n" << std::flush;
}

void RunProgress::wipe() {
  if (drawn_) stream_ << "\r\033[K" << std::flush;
  drawn_ = false;
}

}  // namespace deliso

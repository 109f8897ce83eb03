#include "experiments/results/plot_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace deliso {
namespace {

constexpr double kWantedTicks = 5;
constexpr double kManyDecades = 200;  // from this factor on, powers of ten alone are enough ticks
constexpr std::array<double, 3> kRoundDigits = {1, 2, 5};
constexpr std::array<double, 9> kAllDigits = {1, 2, 3, 4, 5, 6, 7, 8, 9};

// The round step that divides `range` into about kWantedTicks parts.
double round_step(double range) {
  const double rough = range / kWantedTicks;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double digit : kRoundDigits) {
    if (digit * power >= rough) return digit * power;
  }
  return 10 * power;
}

}  // namespace

double Axis::place(double value) const {
  if (scale == AxisScale::kLinear) return (value - low) / (high - low);
  return std::log(value / low) / std::log(high / low);
}

std::vector<double> Axis::ticks() const {
  std::vector<double> ticks;
  if (scale == AxisScale::kLinear) {
    const double step = round_step(high - low);
    for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) ticks.push_back(i * step);
    return ticks;
  }
  // The digits at which ticks are placed: powers of ten; if these are few, also 2 and 5 times them; if these are few,
  // all multiples.
  constexpr std::array<std::span<const double>, 3> kDigits = {std::span(kAllDigits).first(1), kRoundDigits, kAllDigits};
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  const int stride = std::max(1, static_cast<int>(std::ceil((last - first) / (2 * kWantedTicks))));
  for (std::size_t level = high / low > kManyDecades ? 0 : 1; level < kDigits.size() && ticks.size() < 2; ++level) {
    ticks.clear();
    for (int e = first; e <= last; e += stride) {
      for (const double digit : kDigits[level]) {
        const double value = digit * std::pow(10, e);
        if (value >= low && value <= high) ticks.push_back(value);
      }
    }
  }
  return ticks;
}

Axis linear_axis(std::span<const double> values, bool from_zero) {
  Axis axis;
  if (values.empty()) return axis;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  axis.low = from_zero ? std::min(0.0, *low) : *low;
  axis.high = from_zero ? std::max(0.0, *high) : *high;
  if (!(axis.high > axis.low)) axis.high = axis.low + std::max(1.0, std::abs(axis.low));
  const double step = round_step(axis.high - axis.low);
  axis.low = step * std::floor(axis.low / step + 1e-9);
  axis.high = step * std::ceil(axis.high / step - 1e-9);
  return axis;
}

Axis log_axis(std::span<const double> values) {
  constexpr double kRoom = 0.06;  // of the axis, at each end
  Axis axis{AxisScale::kLog, 1, 10};
  bool found = false;
  for (const double value : values) {
    if (!(value > 0)) continue;
    axis.low = found ? std::min(axis.low, value) : value;
    axis.high = found ? std::max(axis.high, value) : value;
    found = true;
  }
  // At least from half to twice, so that there is something to label.
  constexpr double kLeast = 4;
  const double widen = std::max(1.0, std::sqrt(kLeast * axis.low / axis.high));
  const double room = widen * std::pow(axis.high / axis.low, kRoom);
  return {AxisScale::kLog, axis.low / room, axis.high * room};
}

std::string tick_text(double value) {
  std::array<char, 40> buffer{};
  const double size = std::abs(value);
  if (size >= 1e6) {
    std::snprintf(buffer.data(), buffer.size(), "%.4gM", value / 1e6);
  } else if (size >= 1e4) {
    std::snprintf(buffer.data(), buffer.size(), "%.4gk", value / 1e3);
  } else {
    std::snprintf(buffer.data(), buffer.size(), "%.4g", size > 0 ? value : 0);
  }
  return buffer.data();
}

}  // namespace deliso

// An axis of a plot: the map from values to positions, and the values that are labelled.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace deliso {

enum class AxisScale { kLinear, kLog };

struct Axis {
  AxisScale scale = AxisScale::kLinear;
  double low = 0;  // of the values shown; on a logarithmic axis > 0
  double high = 1;

  // 0 at `low`, 1 at `high`. Precondition: on a logarithmic axis the value is > 0.
  [[nodiscard]] double place(double value) const;
  // The values to label, ascending: round ones within the axis.
  [[nodiscard]] std::vector<double> ticks() const;
};

// A linear axis over the values, ending at round ones; with zero on it when `from_zero`.
Axis linear_axis(std::span<const double> values, bool from_zero);

// A logarithmic axis over the positive ones among the values, with some room at both ends.
Axis log_axis(std::span<const double> values);

// "0.05", "20k", "3M".
std::string tick_text(double value);

}  // namespace deliso

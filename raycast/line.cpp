#include "raycast/line.h"

#include <algorithm>
#include <cmath>

namespace deliso {

IndexLine index_line(const Line& line, const Vec3& inverse_step, const Dims& dims) {
  constexpr double kFar = 64;                // in sizes of the box
  constexpr double kLargestInverse = 1e280;  // keeps crossings finite
  IndexLine result;
  result.base = axis_values(scaled(line.origin, inverse_step));
  result.direction = axis_values(scaled(line.direction, inverse_step));
  bool is_far = false;
  for (std::size_t a = 0; a < 3; ++a) {
    is_far |= std::abs(result.base[a]) > kFar * dims[a];
    if (result.direction[a] != 0)
      result.inverse[a] = std::clamp(1 / result.direction[a], -kLargestInverse, kLargestInverse);
  }
  if (!is_far) return result;
  // The point nearest to the middle of the box; the direction is first brought to unit size.
  double largest = 0;
  for (const double d : result.direction) largest = std::max(largest, std::abs(d));
  if (largest == 0) return result;
  double along = 0;
  double squared = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double d = result.direction[a] / largest;
    along += (0.5 * dims[a] - result.base[a]) * d;
    squared += d * d;
  }
  const double t = along / squared / largest;
  if (!std::isfinite(t) || !is_finite(line.at(t))) return result;
  result.t_origin = t;
  result.base = axis_values(scaled(line.at(t), inverse_step));
  return result;
}

}  // namespace deliso

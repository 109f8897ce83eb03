#include "volume/scalar_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "volume/not_finite.h"

namespace deliso {

namespace {

std::string text(const Dims& dims) {
  return std::to_string(dims[0]) + " x " + std::to_string(dims[1]) + " x " + std::to_string(dims[2]);
}

std::string text(const Vec3& v) {
  return "(" + shortest_text(v.x) + ", " + shortest_text(v.y) + ", " + shortest_text(v.z) + ")";
}

template <class Sample>
std::pair<double, double> range_of_finite(const SampleArray<Sample>& samples, const Dims& dims) {
  Sample low = samples.front();
  Sample high = samples.front();
  bool finite = true;
  for (const Sample s : samples) {
    low = s < low ? s : low;
    high = high < s ? s : high;
    if constexpr (std::is_floating_point_v<Sample>) finite &= std::abs(s) <= std::numeric_limits<Sample>::max();
  }
  if constexpr (std::is_floating_point_v<Sample>)
    if (!finite) throw InputError(first_not_finite_text(samples, dims) + ": every sample must be a finite number");
  return {static_cast<double>(low), static_cast<double>(high)};
}

// The largest value of the type that is not above `value`, or the smallest of the type when there is none.
template <class Sample>
Sample rounded_down(double value) {
  constexpr Sample kLowest = std::numeric_limits<Sample>::lowest();
  constexpr Sample kHighest = std::numeric_limits<Sample>::max();
  if (value <= static_cast<double>(kLowest)) return kLowest;
  if (value >= static_cast<double>(kHighest)) return kHighest;
  if constexpr (std::is_integral_v<Sample>) {
    return static_cast<Sample>(std::floor(value));
  } else {
    const auto nearest = static_cast<Sample>(value);
    return static_cast<double>(nearest) > value ? std::nextafter(nearest, kLowest) : nearest;
  }
}

template <class Sample>
std::vector<Sample> padded_samples(const SampleArray<Sample>& samples, const ScalarGrid& grid, const Dims& dims,
                                   Sample value) {
  std::vector<Sample> out(checked_sample_count(dims), value);
  const auto row = static_cast<std::size_t>(dims[0]);
  for (std::int32_t k = 0; k < grid.dims()[2]; ++k)
    for (std::int32_t j = 0; j < grid.dims()[1]; ++j) {
      const Sample* from = samples.data() + grid.index(0, j, k);
      const std::size_t line =
          static_cast<std::size_t>(j + 1) + static_cast<std::size_t>(dims[1]) * static_cast<std::size_t>(k + 1);
      std::copy_n(from, grid.dims()[0], out.data() + line * row + 1);
    }
  return out;
}

}  // namespace

std::size_t checked_sample_count(const Dims& dims) {
  for (const std::int32_t n : dims)
    if (n < 2) throw InputError("the volume's dimensions are " + text(dims) + ": each must be at least 2");
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max() / 2 / sizeof(double);
  const std::size_t slice = static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]);
  if (static_cast<std::size_t>(dims[2]) > kMost / slice)
    throw InputError("the volume's dimensions are " + text(dims) + ": more samples than memory can address");
  return slice * static_cast<std::size_t>(dims[2]);
}

ScalarGrid::ScalarGrid(Dims dims, Samples samples, Vec3 spacing, Vec3 origin)
    : dims_(dims), spacing_(spacing), origin_(origin), samples_(std::move(samples)) {
  const std::size_t expected = checked_sample_count(dims_);
  const std::size_t found = visit_samples(samples_, [](const auto& s) { return s.size(); });
  if (found != expected)
    throw InputError("the volume has " + std::to_string(found) + " samples, but its dimensions " + text(dims_) +
                     " need " + std::to_string(expected));
  check_places();
  range_ = visit_samples(samples_, [this](const auto& s) { return range_of_finite(s, dims_); });
}

// Volumes, and the exact determinants of a mesh's vertices, are products of lengths: these must stay in range.
void ScalarGrid::check_places() const {
  constexpr double kSmallest = 1e-100, kLargest = 1e100;
  // Up to this distance in smallest spacings a coordinate's rounding is below 1e-4 of one.
  constexpr double kFarthest = 0x1p40;
  const double smallest = std::min({spacing_.x, spacing_.y, spacing_.z});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(spacing_[axis] > 0)) throw InputError("the spacing is " + text(spacing_) + ": each must be positive");
    if (!(spacing_[axis] >= kSmallest && spacing_[axis] <= kLargest))
      throw InputError("the spacing is " + text(spacing_) + ": each must be from 1e-100 to 1e100");
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double farthest = std::max(std::abs(box().low[axis]), std::abs(box().high[axis]));
    if (!(farthest <= kFarthest * smallest))
      throw InputError(
          "the origin is " + text(origin_) + " and the spacing " + text(spacing_) +
          ": places must be within 1e12 of the smallest spacings of 0, coordinates cannot tell them apart beyond");
  }
}

std::string ScalarGrid::type_name() const {
  static constexpr std::array<const char*, 7> kNames{"u8", "i8", "u16", "i16", "i32", "f32", "f64"};
  return kNames.at(samples_.index());
}

Box3 ScalarGrid::box() const {
  const Vec3 last{static_cast<double>(dims_[0] - 1), static_cast<double>(dims_[1] - 1),
                  static_cast<double>(dims_[2] - 1)};
  return {origin_, origin_ + scaled(last, spacing_)};
}

ScalarGrid padded(const ScalarGrid& grid, double value) {
  if (std::isnan(value)) throw InputError("the value to pad a volume with is NaN: it must be a number");
  Dims dims = grid.dims();
  for (std::int32_t& n : dims) {
    if (n > std::numeric_limits<std::int32_t>::max() - 2)
      throw InputError("the volume's dimensions are " + text(grid.dims()) + ": too large to pad");
    n += 2;
  }
  Samples samples = visit_samples(grid.samples(), [&]<class Sample>(const SampleArray<Sample>& s) {
    return Samples(padded_samples(s, grid, dims, rounded_down<Sample>(value)));
  });
  return {dims, std::move(samples), grid.spacing(), grid.origin() - grid.spacing()};
}

}  // namespace deliso

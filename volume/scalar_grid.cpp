#include "volume/scalar_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "volume/not_finite.h"
#include "volume/sample_sides.h"

namespace deliso {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

// How the samples lie around a value.
struct Neighbors {
  bool equal = false;         // some sample equals the value
  double lower = -kInfinity;  // the largest sample below it
  double higher = kInfinity;  // the smallest sample above it
};

Neighbors find_neighbors(const ScalarGrid& grid, double value) {
  return visit_samples(grid.samples(), [value](const auto& samples) {
    Neighbors found;
    for (const auto sample : samples) {
      const auto s = static_cast<double>(sample);
      if (s == value) found.equal = true;
      if (s < value && s > found.lower) found.lower = s;
      if (s > value && s < found.higher) found.higher = s;
    }
    return found;
  });
}

// Where an isovalue is that equals a sample, as a fraction of the gap to the next lower sample value.
constexpr double kLowered = 0.01;
constexpr double kLoweredWhereThin = 0.382;  // far from the thirds, quarters and halves that saddles of integers have

// A sample equals an isovalue up to rounding that is so near to it, relative to it: a decimal fraction, rounded to a
// float or multiplied, is a few units in the last place off what people type. It has to be alone: samples with the same
// meaning are as near to each other as kSame, all others kApart away. Else samples hardly differ, and every digit
// counts.
constexpr double kRounding = 0x1p-22, kSame = 0x1p-48, kApart = 100 * kRounding;

bool has_integers(const ScalarGrid& grid) {
  return visit_samples(grid.samples(),
                       []<class Sample>(const SampleArray<Sample>&) { return std::is_integral_v<Sample>; });
}

// The lowest of the samples that an isovalue equals up to rounding; the isovalue itself, where there is none.
double sample_meant(const ScalarGrid& grid, double isovalue) {
  const double size = std::abs(isovalue);
  return visit_samples(grid.samples(), [&](const auto& samples) {
    double lowest = kInfinity, highest = -kInfinity, below = -kInfinity, above = kInfinity;
    for (const auto sample : samples) {
      const auto s = static_cast<double>(sample);
      if (s < isovalue - kRounding * size) {
        below = std::max(below, s);
      } else if (s > isovalue + kRounding * size) {
        above = std::min(above, s);
      } else {
        lowest = std::min(lowest, s);
        highest = std::max(highest, s);
      }
    }
    const bool is_alone =
        highest - lowest <= kSame * size && lowest - below > kApart * size && above - highest > kApart * size;
    return lowest <= highest && below > -kInfinity && is_alone ? lowest : isovalue;
  });
}

// Whether samples have the value, or its meaning, and along some axis lower ones on both sides: there two sheets of the
// isosurface meet, or leave a wall, a wire or a grain as thin as the isovalue is lowered.
bool is_thin_at(const ScalarGrid& grid, double value) {
  const double most = value + kSame * std::abs(value);
  return visit_samples(grid.samples(), [&](const auto& samples) {
    const std::array<std::size_t, 3> n = {static_cast<std::size_t>(grid.dims()[0]),
                                          static_cast<std::size_t>(grid.dims()[1]),
                                          static_cast<std::size_t>(grid.dims()[2])};
    const std::array<std::size_t, 3> stride = {1, n[0], n[0] * n[1]};
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (const auto s = static_cast<double>(samples[i]); s < value || s > most) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = i / stride.at(axis) % n.at(axis);
        if (at > 0 && at + 1 < n.at(axis) && static_cast<double>(samples[i - stride.at(axis)]) < value &&
            static_cast<double>(samples[i + stride.at(axis)]) < value) {
          return true;
        }
      }
    }
    return false;
  });
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
  // Up to this distance in spacings a coordinate's rounding is below 1e-4 of a spacing.
  constexpr double kFarthest = 0x1p40;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(spacing_[axis] > 0)) throw InputError("the spacing is " + text(spacing_) + ": each must be positive");
    if (!(spacing_[axis] >= kSmallest && spacing_[axis] <= kLargest))
      throw InputError("the spacing is " + text(spacing_) + ": each must be from 1e-100 to 1e100");
    const double farthest = std::max(std::abs(box().low[axis]), std::abs(box().high[axis]));
    if (!(farthest <= kFarthest * spacing_[axis]))
      throw InputError("the origin is " + text(origin_) + " and the spacing " + text(spacing_) +
                       ": places must be within 1e12 spacings of 0, coordinates cannot tell them apart beyond");
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

double regular_isovalue(const ScalarGrid& grid, double isovalue) {
  const double given = isovalue;
  const bool never_equal = visit_samples(grid.samples(), [given]<class Sample>(const SampleArray<Sample>&) {
    return SideTest<Sample>(given).never_equal();
  });
  if (!has_integers(grid)) isovalue = sample_meant(grid, given);
  if (never_equal && isovalue == given) return given;
  Neighbors near = find_neighbors(grid, isovalue);
  while (near.equal) {
    // In a gap of few doubles lowering by a fraction may round to nothing, so also try the middle of the gap.
    const bool has_lower = near.lower > -kInfinity;
    if (!has_lower && isovalue < given) {
      throw InputError(
          "a sample equals the isovalue " + shortest_text(given) +
          ", and from there down to the lowest sample every number is a sample: expected an isovalue above "
          "it, or samples less what they have in common");
    }
    const double gap = has_lower ? isovalue - near.lower : near.higher - isovalue;
    if (!has_lower && !(gap < kInfinity)) {
      // All samples are equal. Next to them nothing could be interpolated with what a closing layer has below them.
      const double lower = isovalue - kLowered * std::max(1.0, std::abs(isovalue));
      return std::isfinite(lower) ? lower : std::nextafter(isovalue, -kInfinity);
    }
    const double lowered = has_lower && is_thin_at(grid, isovalue) ? kLoweredWhereThin : kLowered;
    for (const double fraction : {lowered, 0.5}) {
      const double candidate = isovalue - fraction * gap;
      if (candidate < isovalue && candidate > near.lower) return candidate;
    }
    if (!has_lower) return std::nextafter(isovalue, -kInfinity);
    // The gap holds no double: continue with the gap below it.
    isovalue = near.lower;
    near = find_neighbors(grid, isovalue);
  }
  return isovalue;
}

std::pair<double, double> samples_around(const ScalarGrid& grid, double value) {
  const Neighbors found = find_neighbors(grid, value);
  return {found.lower, found.higher};
}

double lowered_isovalue(const ScalarGrid& grid, double isovalue) {
  const double lower = find_neighbors(grid, isovalue).lower;
  return lower > -kInfinity ? isovalue - kLowered * (isovalue - lower) : std::nextafter(isovalue, -kInfinity);
}

}  // namespace deliso

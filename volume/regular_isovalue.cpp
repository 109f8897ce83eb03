#include "volume/regular_isovalue.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "volume/sample_neighbors.h"
#include "volume/sample_sides.h"

namespace deliso {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Calls visit(sample) for the samples of the volume, without a layer around its walls: that is at one value far beyond
// all others, which its first sample has.
template <class Visit>
void for_each_sample(const ScalarGrid& grid, const Visit& visit) {
  visit_samples(grid.samples(), [&](const auto& samples) {
    if (!grid.walls()) {
      for (const auto sample : samples) visit(static_cast<double>(sample));
      return;
    }
    const auto layer = samples.front();
    for (const auto sample : samples) {
      if (sample != layer) visit(static_cast<double>(sample));
    }
  });
}

// Where an isovalue is that equals a sample, as a fraction of the gap to the next lower sample value.
constexpr double kLowered = 0.01;
constexpr double kLoweredWhereThin = 0.382;  // far from the thirds, quarters and halves that saddles of integers have

// Samples that an isovalue equals up to rounding, and those next to them.
struct SamplesMeant {
  double lowest = kInfinity;
  double highest = -kInfinity;
  double below = -kInfinity;
  double above = kInfinity;

  [[nodiscard]] bool is_empty() const { return !(lowest <= highest); }
};

// The samples up to a distance from the isovalue.
SamplesMeant samples_within(const ScalarGrid& grid, double isovalue, double distance) {
  SamplesMeant meant;
  for_each_sample(grid, [&](double s) {
    if (s < isovalue - distance) {
      meant.below = std::max(meant.below, s);
    } else if (s > isovalue + distance) {
      meant.above = std::min(meant.above, s);
    } else {
      meant.lowest = std::min(meant.lowest, s);
      meant.highest = std::max(meant.highest, s);
    }
  });
  return meant;
}

// A sample equals an isovalue up to rounding that is so near to it, relative to it: a decimal fraction, rounded to a
// float or multiplied, is a few units in the last place off what people type. It has to be alone: samples with the same
// meaning are as near to each other as kSame, all others kApart away. Else samples hardly differ, and every digit
// counts.
constexpr double kRounding = 0x1p-22, kSame = 0x1p-48, kApart = 100 * kRounding;

bool has_integers(const ScalarGrid& grid) {
  return visit_samples(grid.samples(),
                       []<class Sample>(const SampleArray<Sample>&) { return std::is_integral_v<Sample>; });
}

std::optional<SamplesMeant> steps_meant(const ScalarGrid& grid, double isovalue, const Neighbors& near) {
  const double size = std::abs(isovalue);
  if (!near.equal && near.lower < isovalue - kRounding * size && near.higher > isovalue + kRounding * size) {
    return std::nullopt;
  }
  const SamplesMeant meant = samples_within(grid, isovalue, kRounding * size);
  if (meant.is_empty() || meant.below == -kInfinity) return std::nullopt;
  const bool is_alone = meant.highest - meant.lowest <= kSame * size && meant.lowest - meant.below > kApart * size &&
                        meant.above - meant.highest > kApart * size;
  return is_alone ? std::optional(meant) : std::nullopt;
}

// Distances of samples from an isovalue, by their binary exponents.
class DistanceBins {
 public:
  void add(double distance) {
    const bool is_finite = distance < kInfinity;
    const int exponent = distance == 0 ? 0 : is_finite ? std::ilogb(distance) + kOffset : kBins - 1;
    Bin& bin = bins_.at(static_cast<std::size_t>(exponent));
    bin = {std::min(bin.least, distance), std::max(bin.most, distance)};
  }
  // The distances that all larger ones exceed by so many times, ascending.
  [[nodiscard]] std::vector<double> before_jumps(double factor) const {
    std::vector<double> found;
    double most = -1;
    for (const Bin& bin : bins_) {
      if (!(bin.least <= bin.most)) continue;
      if (most >= 0 && bin.least >= factor * most) found.push_back(most);
      most = bin.most;
    }
    return found;
  }

 private:
  static constexpr int kOffset = 1075, kBins = 2101;  // of the exponents of doubles, and one for 0
  struct Bin {
    double least = kInfinity;
    double most = -kInfinity;
  };
  std::array<Bin, kBins> bins_;
};

constexpr double kFarApart = 0x1p44, kFarthestApart = 0x1p57;  // are others from remainders

std::optional<SamplesMeant> remainders_within(const ScalarGrid& grid, double isovalue, double distance) {
  const SamplesMeant meant = samples_within(grid, isovalue, distance);
  const double farthest = std::max(meant.highest - isovalue, isovalue - meant.lowest);
  const double others = std::min(isovalue - meant.below, meant.above - isovalue);
  if (!(others < kInfinity) || others < kFarApart * farthest) return std::nullopt;
  const bool is_between = meant.below > -kInfinity && meant.above < kInfinity;
  const bool are_remainders = is_between && others <= kFarthestApart * farthest;
  return meant.lowest == meant.highest || are_remainders ? std::optional(meant) : std::nullopt;
}

// Samples so much nearer to the isovalue than all others that crossings with edges at them would be one point. They
// have one value, or are what is left where terms of the size of the others cancel, and products of such: that is not
// arbitrarily small, as samples that count are beside fill values.
std::optional<SamplesMeant> remainders_meant(const ScalarGrid& grid, double isovalue, const Neighbors& near) {
  const double nearest = std::min(isovalue - near.lower, near.higher - isovalue);
  if (!(kFarApart * nearest <= grid.range().second - grid.range().first)) return std::nullopt;
  DistanceBins distances;
  for_each_sample(grid, [&](double s) { distances.add(std::abs(s - isovalue)); });
  std::optional<SamplesMeant> largest;
  for (const double most : distances.before_jumps(kFarApart)) {
    const std::optional<SamplesMeant> meant = remainders_within(grid, isovalue, most);
    if (meant) largest = meant;
  }
  return largest;
}

// Whether samples have a value from `least` to `most`, and along some axis lower ones on both sides (or higher ones):
// there two sheets of the isosurface meet, or leave a wall, a wire or a grain as thin as the isovalue is moved.
enum class Beside { kLower, kHigher };
bool is_thin_at(const ScalarGrid& grid, double least, double most, Beside beside) {
  const auto is_beside = [&](double s) { return beside == Beside::kLower ? s < least : s > most; };
  return visit_samples(grid.samples(), [&](const auto& samples) {
    const std::array<std::size_t, 3> n = {static_cast<std::size_t>(grid.dims()[0]),
                                          static_cast<std::size_t>(grid.dims()[1]),
                                          static_cast<std::size_t>(grid.dims()[2])};
    const std::array<std::size_t, 3> stride = {1, n[0], n[0] * n[1]};
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (const auto s = static_cast<double>(samples[i]); s < least || s > most) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t at = i / stride.at(axis) % n.at(axis);
        if (at > 0 && at + 1 < n.at(axis) && is_beside(static_cast<double>(samples[i - stride.at(axis)])) &&
            is_beside(static_cast<double>(samples[i + stride.at(axis)]))) {
          return true;
        }
      }
    }
    return false;
  });
}

// Below a sample that equals the isovalue, and above the next lower one; of those that equal it up to rounding `most`
// is the highest.
double lowered_below_sample(const ScalarGrid& grid, double given, double sample, double most) {
  Neighbors near = find_neighbors(grid, sample);
  while (near.equal) {
    // In a gap of few doubles lowering by a fraction may round to nothing, so also try the middle of the gap.
    const bool has_lower = near.lower > -kInfinity;
    if (!has_lower && sample < given) {
      throw InputError(
          "a sample equals the isovalue " + shortest_text(given) +
          ", and from there down to the lowest sample every number is a sample: expected an isovalue above "
          "it, or samples less what they have in common");
    }
    const double gap = has_lower ? sample - near.lower : near.higher - sample;
    if (!has_lower && !(gap < kInfinity)) {
      // All samples are equal. Next to them nothing could be interpolated with what a closing layer has below them.
      const double lower = sample - kLowered * std::max(1.0, std::abs(sample));
      return std::isfinite(lower) ? lower : std::nextafter(sample, -kInfinity);
    }
    const double lowered = has_lower && is_thin_at(grid, sample, most, Beside::kLower) ? kLoweredWhereThin : kLowered;
    for (const double fraction : {lowered, 0.5}) {
      const double candidate = sample - fraction * gap;
      if (candidate < sample && candidate > near.lower) return candidate;
    }
    if (!has_lower) return std::nextafter(sample, -kInfinity);
    // The gap holds no double: continue with the gap below it.
    sample = near.lower;
    near = find_neighbors(grid, sample);
  }
  return sample;
}

constexpr double kNear = 1e-6;  // of an integer: no other number is meant

// Of integers, some of them a hair from the isovalue: away from them, on the side of them that it is on.
double away_from_integers(const ScalarGrid& grid, double isovalue, const Neighbors& near) {
  if (near.lower == -kInfinity || near.higher == kInfinity) return isovalue;
  if (near.higher - isovalue <= kNear) return lowered_below_sample(grid, isovalue, near.higher, near.higher);
  if (isovalue - near.lower > kNear) return isovalue;
  const double raised = is_thin_at(grid, near.lower, near.lower, Beside::kHigher) ? kLoweredWhereThin : kLowered;
  return near.lower + raised * (near.higher - near.lower);
}

// Whether no sample is so near to the isovalue that it might equal it, as its type alone tells.
bool is_surely_regular(const ScalarGrid& grid, double isovalue) {
  const bool never_equal = visit_samples(grid.samples(), [isovalue]<class Sample>(const SampleArray<Sample>&) {
    return SideTest<Sample>(isovalue).never_equal();
  });
  return never_equal && has_integers(grid) && std::abs(isovalue - std::round(isovalue)) > kNear;
}

}  // namespace

double regular_isovalue(const ScalarGrid& grid, double isovalue) {
  if (is_surely_regular(grid, isovalue)) return isovalue;
  const Neighbors near = find_neighbors(grid, isovalue);
  std::optional<SamplesMeant> meant = remainders_meant(grid, isovalue, near);
  if (!meant && !has_integers(grid)) meant = steps_meant(grid, isovalue, near);
  if (!meant) {
    const double most = isovalue + kSame * std::abs(isovalue);
    if (near.equal) return lowered_below_sample(grid, isovalue, isovalue, most);
    return has_integers(grid) ? away_from_integers(grid, isovalue, near) : isovalue;
  }
  if (meant->below == -kInfinity && meant->lowest < isovalue) {
    return meant->lowest + kLowered * (meant->above - meant->lowest);
  }
  // Of an isovalue at the lowest sample there is no surface, a little below it neither.
  if (meant->below == -kInfinity && !near.equal) return isovalue;
  const double most = std::max(meant->highest, meant->lowest + kSame * std::abs(meant->lowest));
  return lowered_below_sample(grid, isovalue, meant->lowest, most);
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

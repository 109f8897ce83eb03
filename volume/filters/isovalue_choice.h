// Isovalues found from the samples, which are finite: by name, and in the middle of a gap.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "volume/scalar_grid.h"

namespace deliso {

// The middle between two sample values that follow each other, so that the same samples lie above it as above or at
// `isovalue`; where that is all of them, or none, in the gap at that end. The value itself when all samples are equal.
// In a mask it is half-way between the two values, the only isovalue whose surface leans to neither side.
double middle_of_gap(const Samples& samples, double isovalue);

// The threshold that splits the samples into two classes with the largest variance between them (Otsu: A threshold
// selection method from gray-level histograms, 1979), in the middle of its gap. All thresholds are tried where the
// samples are whole numbers in a range of at most 65536; else those between 65536 bins.
double otsu_isovalue(const Samples& samples);
// The same for the mean of the samples, and for the median; of an even number of samples whose two in the middle differ
// the middle of these two.
double mean_isovalue(const Samples& samples);
double median_isovalue(const Samples& samples);

// What a name stands for: otsu, mean, median, or P%, which is that share of the way from the lowest sample to the
// highest. Nothing when the text is no name. Throws InputError when P is not between 0 and 100.
struct NamedIsovalue {
  enum class Kind { kOtsu, kMean, kMedian, kPercent };
  Kind kind = Kind::kOtsu;
  double percent = 0;
};
std::optional<NamedIsovalue> parse_isovalue_name(std::string_view text);
double isovalue_of(const Samples& samples, const NamedIsovalue& name);

}  // namespace deliso

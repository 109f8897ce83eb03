// Volumes of few whole numbers: masks, and maps of labels. Trilinear interpolation makes steps of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "volume/scalar_grid.h"

namespace deliso {

// All values of the samples in ascending order, or nothing when there are more than `most`.
std::optional<std::vector<double>> distinct_values(const ScalarGrid& grid, std::size_t most);

enum class SampleKind {
  kField,   // measured or computed values
  kMask,    // two whole numbers
  kLabels,  // few whole numbers in patches
};
struct SampleKinds {
  SampleKind kind = SampleKind::kField;
  std::vector<double> values;  // of a mask or of labels, ascending
};
// Labels are at most 64 values, most samples of which equal the next one along x. Where a sample differs from both of
// its neighbours and mostly lies between them, the values are those of a mask with soft edges, a field.
SampleKinds kind_of_samples(const ScalarGrid& grid);

// The isosurface of a label lies half-way between it and all others.
inline constexpr double kLabelIsovalue = 0.5;

// Throws InputError naming the values that there are when no sample is one of the labels.
void check_labels(const ScalarGrid& grid, const std::vector<std::int32_t>& labels);

// 1 where a sample is the label, else 0. Throws InputError naming the values that there are when no sample is.
ScalarGrid label_mask(const ScalarGrid& grid, std::int32_t label);

}  // namespace deliso

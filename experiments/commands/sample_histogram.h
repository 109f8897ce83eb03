// The distribution of a volume's samples, and suggested isovalues.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "volume/scalar_grid.h"

namespace deliso {

// Bins of equal width from low to high; the last one includes its upper end. For integer samples the bins begin and end
// half-way between integers.
struct SampleHistogram {
  double low = 0;
  double high = 0;
  std::vector<std::uint64_t> counts;

  [[nodiscard]] double bin_width() const { return (high - low) / static_cast<double>(counts.size()); }
};

// At most `bins` bins (fewer when there are fewer distinct integers). Preconditions: bins >= 1; finite samples.
SampleHistogram sample_histogram(const Samples& samples, std::int32_t bins = 256);

struct IsovalueSuggestion {
  double isovalue = 0;
  std::string reason;
  std::string name;  // that --isovalue takes for it; may be empty
};

// Thresholds that separate two and three classes of samples with the largest variance between the classes (Otsu: A
// threshold selection method from gray-level histograms, 1979; three by the bins alone). They lie in the middle between
// two sample values. Empty when all samples are equal.
std::vector<IsovalueSuggestion> suggested_isovalues(const Samples& samples, const SampleHistogram& histogram);

}  // namespace deliso

// Samples of the built-in fields: whole volumes, or slices of those that need not fit into memory.
#pragma once

#include <cstdint>
#include <string_view>

#include "volume/fields/analytic_fields.h"
#include "volume/sample_type.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The largest size that generate_field takes.
inline constexpr std::int32_t kLargestFieldSize = 2048;

// The field's volume of size^3 samples. Equal arguments give equal samples. Throws InputError when the name is unknown
// or the size is not between 2 and kLargestFieldSize.
ScalarGrid generate_field(std::string_view name, std::int32_t size, std::uint64_t seed = 1);

// The same volume a few slices (z = 0 first) at a time, for those that need not fit into memory.
class FieldSlices {
 public:
  // Throws InputError as generate_field does.
  FieldSlices(const AnalyticField& field, std::int32_t size, std::uint64_t seed = 1);

  [[nodiscard]] SampleType type() const { return type_; }
  // The samples of the next so many slices. Precondition: there are so many left.
  Samples next(std::int32_t slices = 1);

 private:
  template <class Sample>
  void append_next(std::vector<Sample>& samples);

  std::int32_t size_;
  SampleType type_;
  std::int32_t next_ = 0;
  FieldValues values_;
};

}  // namespace deliso

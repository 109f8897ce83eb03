#include "volume/io/base/sample_conversion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace deliso {

namespace {

// Whether a whole number is a double, too: beyond 2^53 only some are.
template <class Integer>
bool is_double(Integer value) {
  const auto rounded = static_cast<double>(value);
  // The next power of two above the type's range would overflow on the way back.
  if (rounded >= std::ldexp(1.0, std::numeric_limits<Integer>::digits)) return false;
  return static_cast<Integer>(rounded) == value;
}

template <class Integer>
std::optional<std::size_t> first_not_double(const LargeArray<Integer>& values) {
  const auto wrong = std::find_if(values.begin(), values.end(), [](Integer v) { return !is_double(v); });
  if (wrong == values.end()) return std::nullopt;
  return static_cast<std::size_t>(wrong - values.begin());
}

template <class Integer>
Samples narrowed_integers(const LargeArray<Integer>& values) {
  const auto fits = [](Integer v) { return std::in_range<std::int32_t>(v); };
  if (std::all_of(values.begin(), values.end(), fits)) {
    LargeArray<std::int32_t> kept;
    kept.reserve(values.size());
    for (const Integer v : values) kept.push_back(static_cast<std::int32_t>(v));
    return SampleArray<std::int32_t>(std::move(kept));
  }
  LargeArray<double> kept;
  kept.reserve(values.size());
  for (const Integer v : values) kept.push_back(static_cast<double>(v));
  return SampleArray<double>(std::move(kept));
}

template <class Integer>
Samples narrowed_in_file(const LargeArray<Integer>& values, const Dims& dims, bool is_z_fastest,
                         const ByteStream& file) {
  if (const auto wrong = first_not_double(values)) {
    std::size_t n = *wrong;
    std::array<std::size_t, 3> index{};
    for (std::size_t step = 0; step < 3; ++step) {
      const std::size_t axis = is_z_fastest ? 2 - step : step;
      index[axis] = n % static_cast<std::size_t>(dims[axis]);
      n /= static_cast<std::size_t>(dims[axis]);
    }
    file.fail("sample (" + std::to_string(index[0]) + ", " + std::to_string(index[1]) + ", " +
              std::to_string(index[2]) + ") is " + std::to_string(values[*wrong]) +
              ", which no double holds exactly: scale the samples, or store them as doubles");
  }
  return narrowed_integers(values);
}

// Reverses the order of the samples along an axis.
template <class Sample>
void reverse_axis(LargeArray<Sample>& samples, const Dims& dims, std::size_t axis) {
  std::size_t stride = 1;  // between neighbours along the axis: so many samples move together
  for (std::size_t n = 0; n < axis; ++n) stride *= static_cast<std::size_t>(dims[n]);
  const auto length = static_cast<std::size_t>(dims[axis]);
  for (std::size_t slab = 0; slab < samples.size(); slab += stride * length) {
    for (std::size_t n = 0; n < length / 2; ++n) {
      Sample* const from = samples.data() + slab + n * stride;
      std::swap_ranges(from, from + stride, samples.data() + slab + (length - 1 - n) * stride);
    }
  }
}

}  // namespace

float float_of_half(std::uint16_t bits) {
  constexpr int kFractionBits = 10, kBias = 15;
  const float sign = (bits & 0x8000u) != 0 ? -1.0f : 1.0f;
  const int exponent = (bits >> kFractionBits) & 0x1F;
  const auto fraction = static_cast<float>(bits & 0x3FFu);
  if (exponent == 0) return sign * std::ldexp(fraction, 1 - kBias - kFractionBits);
  if (exponent < 0x1F) return sign * std::ldexp(fraction + 1024.0f, exponent - kBias - kFractionBits);
  if (fraction != 0) return std::numeric_limits<float>::quiet_NaN();
  return sign * std::numeric_limits<float>::infinity();
}

Samples narrowed(const LargeArray<std::uint32_t>& values, const Dims& dims, bool is_z_fastest, const ByteStream& file) {
  return narrowed_in_file(values, dims, is_z_fastest, file);
}
Samples narrowed(const LargeArray<std::uint64_t>& values, const Dims& dims, bool is_z_fastest, const ByteStream& file) {
  return narrowed_in_file(values, dims, is_z_fastest, file);
}
Samples narrowed(const LargeArray<std::int64_t>& values, const Dims& dims, bool is_z_fastest, const ByteStream& file) {
  return narrowed_in_file(values, dims, is_z_fastest, file);
}

Samples narrowed(const LargeArray<std::uint32_t>& values) { return narrowed_integers(values); }
Samples narrowed(const LargeArray<std::uint64_t>& values) { return narrowed_integers(values); }
Samples narrowed(const LargeArray<std::int64_t>& values) { return narrowed_integers(values); }

std::optional<std::size_t> first_without_double(const LargeArray<std::uint32_t>& values) {
  return first_not_double(values);
}
std::optional<std::size_t> first_without_double(const LargeArray<std::uint64_t>& values) {
  return first_not_double(values);
}
std::optional<std::size_t> first_without_double(const LargeArray<std::int64_t>& values) {
  return first_not_double(values);
}

Samples rescaled(const Samples& samples, double factor, double offset) {
  return visit_samples(samples, [&](const auto& stored) -> Samples {
    LargeArray<double> out;
    out.reserve(stored.size());
    for (const auto s : stored) out.push_back(factor * static_cast<double>(s) + offset);
    return SampleArray<double>(std::move(out));
  });
}

Samples transposed(const Samples& samples, const Dims& dims) {
  return visit_samples(samples, [&]<class Sample>(const SampleArray<Sample>& from) -> Samples {
    const auto nx = static_cast<std::size_t>(dims[0]), ny = static_cast<std::size_t>(dims[1]);
    const auto nz = static_cast<std::size_t>(dims[2]);
    LargeArray<Sample> out(from.size());
    for (std::size_t j = 0; j < ny; ++j) {
      for (std::size_t k = 0; k < nz; ++k) {
        for (std::size_t i = 0; i < nx; ++i) out[i + nx * (j + ny * k)] = from[k + nz * (j + ny * i)];
      }
    }
    return SampleArray<Sample>(std::move(out));
  });
}

Samples flipped(const Samples& samples, const Dims& dims, const std::array<bool, 3>& axes) {
  return visit_samples(samples, [&]<class Sample>(const SampleArray<Sample>& from) -> Samples {
    LargeArray<Sample> out(from.begin(), from.end());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axes[axis]) reverse_axis(out, dims, axis);
    }
    return SampleArray<Sample>(std::move(out));
  });
}

}  // namespace deliso

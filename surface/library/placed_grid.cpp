#include "surface/library/placed_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/base/huge_pages.h"
#include "volume/io/base/sample_conversion.h"
#include "volume/not_finite.h"
#include "volume/placement.h"

namespace deliso {
namespace {

constexpr std::array<std::size_t, 12> kSizes = {1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8, 1};

// Samples with axes, from the fastest one on, all forwards.
struct StridedSamples {
  const std::byte* first = nullptr;
  ScalarType type{};
  Dims dims{};
  std::array<std::int64_t, 3> strides{};  // ascending
  std::array<std::size_t, 3> axes{};      // the caller's axis of each
  std::array<bool, 3> turned{};           // along which the caller counts the other way
  std::array<std::int32_t, 3> low{};      // the caller's lowest number along each
  Affine index_to_world;

  [[nodiscard]] std::size_t size() const { return kSizes.at(static_cast<std::size_t>(type)); }
};

Affine affine_of_rows(const std::array<std::array<double, 4>, 3>& rows) {
  Affine map;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) map.columns[column][row] = rows[row][column];
    map.offset[row] = rows[row][3];
  }
  return map;
}

// With strides in bytes, in the caller's axes.
StridedSamples as_given(const VolumeView& volume) {
  if (volume.samples == nullptr) throw InputError("the volume has no samples: expected a pointer to the first one");
  if (static_cast<std::size_t>(volume.type) >= kSizes.size())
    throw InputError("the volume's type is " + std::to_string(static_cast<int>(volume.type)) +
                     ", expected a ScalarType");
  StridedSamples given;
  given.first = static_cast<const std::byte*>(volume.samples);
  given.type = volume.type;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t n = volume.dims[axis];
    if (n > std::numeric_limits<std::int32_t>::max())
      throw InputError("the volume has " + std::to_string(n) + " samples along an axis, expected fewer than 2^31");
    given.dims[axis] = static_cast<std::int32_t>(std::max<std::int64_t>(n, std::numeric_limits<std::int32_t>::min()));
  }
  checked_sample_count(given.dims);
  given.strides = volume.strides;
  if (volume.strides == std::array<std::int64_t, 3>{}) {
    const auto size = static_cast<std::int64_t>(given.size());
    given.strides = {size, size * volume.dims[0], size * volume.dims[0] * volume.dims[1]};
  }
  given.axes = {0, 1, 2};
  given.index_to_world = affine_of_rows(volume.affine);
  return given;
}

// The part of a region alone. Throws InputError when the samples lack some of it.
void take_part(StridedSamples& samples, const SampleRegion& region) {
  const SamplePart part = part_of(samples.dims, region);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    samples.first += part.low[axis] * samples.strides[axis];
    samples.index_to_world.offset =
        samples.index_to_world.offset + part.low[axis] * samples.index_to_world.columns[axis];
  }
  samples.dims = part.dims;
  samples.low = part.low;
}

void turn_axes_forwards(StridedSamples& samples) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (samples.strides[axis] >= 0) continue;
    const std::int64_t last = samples.dims[axis] - 1;
    Vec3& column = samples.index_to_world.columns[axis];
    samples.first += last * samples.strides[axis];
    samples.strides[axis] = -samples.strides[axis];
    samples.index_to_world.offset = samples.index_to_world.offset + static_cast<double>(last) * column;
    column = -1.0 * column;
    samples.turned[axis] = true;
  }
}

StridedSamples in_order_of_memory(const StridedSamples& samples) {
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return samples.strides[a] < samples.strides[b]; });
  StridedSamples sorted = samples;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t from = order[axis];
    sorted.dims[axis] = samples.dims[from];
    sorted.strides[axis] = samples.strides[from];
    sorted.axes[axis] = samples.axes[from];
    sorted.turned[axis] = samples.turned[from];
    sorted.low[axis] = samples.low[from];
    sorted.index_to_world.columns[axis] = samples.index_to_world.columns[from];
  }
  return sorted;
}

bool is_packed(const StridedSamples& samples) {
  auto expected = static_cast<std::int64_t>(samples.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (samples.strides[axis] != expected) return false;
    expected *= samples.dims[axis];
  }
  return reinterpret_cast<std::uintptr_t>(samples.first) % samples.size() == 0;
}

// The samples as they are stored, packed; `Stored` has their size.
template <class Stored>
LargeArray<Stored> packed_copy(const StridedSamples& samples) {
  LargeArray<Stored> copy(checked_sample_count(samples.dims));
  Stored* to = copy.data();
  for (std::int32_t k = 0; k < samples.dims[2]; ++k) {
    for (std::int32_t j = 0; j < samples.dims[1]; ++j) {
      const std::byte* from = samples.first + j * samples.strides[1] + k * samples.strides[2];
      for (std::int32_t i = 0; i < samples.dims[0]; ++i, from += samples.strides[0]) {
        std::memcpy(to++, from, sizeof(Stored));
      }
    }
  }
  return copy;
}

struct TakenSamples {
  Samples samples;
  bool is_copied = false;
};

// Samples of a type that grids have.
template <class Stored>
TakenSamples taken(const StridedSamples& samples) {
  if (!is_packed(samples)) return {SampleArray<Stored>(packed_copy<Stored>(samples)), true};
  const std::span<const Stored> span(reinterpret_cast<const Stored*>(samples.first),
                                     checked_sample_count(samples.dims));
  // The caller keeps the memory.
  return {SampleArray<Stored>(std::shared_ptr<const void>(), span), false};
}

// The index of a sample as the caller counts it: "(i, j, k)".
std::string index_text(const StridedSamples& samples, std::size_t n) {
  std::array<std::size_t, 3> index{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto length = static_cast<std::size_t>(samples.dims[axis]), place = n % length;
    n /= length;
    index[samples.axes[axis]] =
        static_cast<std::size_t>(samples.low[axis]) + (samples.turned[axis] ? length - 1 - place : place);
  }
  return "(" + std::to_string(index[0]) + ", " + std::to_string(index[1]) + ", " + std::to_string(index[2]) + ")";
}

// Samples of the larger whole numbers.
template <class Stored>
TakenSamples narrowed_samples(const StridedSamples& samples) {
  const LargeArray<Stored> stored = packed_copy<Stored>(samples);
  if (const auto wrong = first_without_double(stored)) {
    throw InputError("sample " + index_text(samples, *wrong) + " is " + std::to_string(stored[*wrong]) +
                     ", which no double holds exactly: scale the samples, or store them as doubles");
  }
  return {narrowed(stored), true};
}

TakenSamples take(const StridedSamples& samples) {
  switch (samples.type) {
    case ScalarType::kUint8:
      return taken<std::uint8_t>(samples);
    case ScalarType::kInt8:
      return taken<std::int8_t>(samples);
    case ScalarType::kUint16:
      return taken<std::uint16_t>(samples);
    case ScalarType::kInt16:
      return taken<std::int16_t>(samples);
    case ScalarType::kInt32:
      return taken<std::int32_t>(samples);
    case ScalarType::kUint32:
      return narrowed_samples<std::uint32_t>(samples);
    case ScalarType::kUint64:
      return narrowed_samples<std::uint64_t>(samples);
    case ScalarType::kInt64:
      return narrowed_samples<std::int64_t>(samples);
    case ScalarType::kFloat16: {
      const LargeArray<std::uint16_t> bits = packed_copy<std::uint16_t>(samples);
      LargeArray<float> values(bits.size());
      std::transform(bits.begin(), bits.end(), values.begin(), float_of_half);
      return {SampleArray<float>(std::move(values)), true};
    }
    case ScalarType::kFloat32:
      return taken<float>(samples);
    case ScalarType::kFloat64:
      return taken<double>(samples);
    case ScalarType::kBool:
      return taken<std::uint8_t>(samples);
  }
  DELISO_CHECK(false, "every type is in the list");
}

// A sample that is no number, as the caller counts it.
void check_finite(const Samples& samples, const StridedSamples& described) {
  visit_samples(samples, [&](const auto& all) {
    const auto wrong =
        std::find_if(all.begin(), all.end(), [](auto v) { return !std::isfinite(static_cast<double>(v)); });
    if (wrong == all.end()) return;
    const auto value = static_cast<double>(*wrong);
    throw InputError("sample " + index_text(described, static_cast<std::size_t>(wrong - all.begin())) + " is " +
                     (std::isnan(value) ? "NaN"
                      : value > 0       ? "infinite"
                                        : "minus infinity") +
                     ": every sample must be a finite number");
  });
}

// The axis of the world that each column is parallel to, if all are.
std::optional<std::array<std::size_t, 3>> parallel_axes(const Affine& map) {
  std::array<std::size_t, 3> rows{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3& column = map.columns[axis];
    for (std::size_t row = 0; row < 3; ++row) {
      if (column[row] != 0) rows[axis] = row;
    }
    if (column[(rows[axis] + 1) % 3] != 0 || column[(rows[axis] + 2) % 3] != 0) return std::nullopt;
  }
  if (rows[0] == rows[1] || rows[1] == rows[2] || rows[0] == rows[2]) return std::nullopt;
  return rows;
}

// As frame_of; where the axes are those of the world in another order or turned, coordinates are only exchanged and
// change their signs.
SampleFrame frame_without_rounding(const Affine& map) {
  SampleFrame frame = frame_of(map);
  const auto rows = parallel_axes(map);
  if (!rows) return frame;
  frame.to_world = Affine();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t row = (*rows)[axis];
    const double sign = map.columns[axis][row] < 0 ? -1 : 1;
    frame.spacing[axis] = sign * map.columns[axis][row];
    frame.origin[axis] = sign * map.offset[row];
    frame.to_world.columns[axis] = {0, 0, 0};
    frame.to_world.columns[axis][row] = sign;
  }
  return frame;
}

}  // namespace

bool PlacedGrid::is_exact() const { return parallel_axes(to_world).has_value(); }

PlacedGrid placed_grid(const VolumeView& volume, const SampleRegion& region) {
  StridedSamples given = as_given(volume);
  static_cast<void>(frame_of(given.index_to_world));  // a mistake in it is told of in the caller's axes
  take_part(given, region);
  turn_axes_forwards(given);
  const StridedSamples samples = in_order_of_memory(given);
  TakenSamples own = take(samples);
  const SampleFrame frame = frame_without_rounding(samples.index_to_world);
  try {
    return {ScalarGrid(samples.dims, own.samples, frame.spacing, frame.origin), frame.to_world, own.is_copied};
  } catch (const InputError&) {
    check_finite(own.samples, samples);
    throw;
  }
}

PlainSamples samples_of(const VolumeView& volume, const SampleRegion& region) {
  StridedSamples given = as_given(volume);
  take_part(given, region);
  turn_axes_forwards(given);
  const StridedSamples samples = in_order_of_memory(given);
  return {take(samples).samples, samples.dims};
}

}  // namespace deliso

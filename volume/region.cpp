#include "volume/region.h"

#include <charconv>
#include <cstddef>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"

namespace deliso {

namespace {

constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

[[noreturn]] void refuse_region(const std::string& text, const std::string& source) {
  throw InputError(source + ": expected i0:i1,j0:j1,k0:k1, samples from 0 on of which the last is included (a number " +
                   "may be left out), found '" + text + "'");
}

template <class Sample>
Samples crop(const SampleArray<Sample>& samples, const Dims& of_all, const std::array<std::int32_t, 3>& low,
             const Dims& dims) {
  std::vector<Sample> kept;
  kept.reserve(checked_sample_count(dims));
  for (std::int32_t k = 0; k < dims[2]; ++k) {
    for (std::int32_t j = 0; j < dims[1]; ++j) {
      const auto at =
          static_cast<std::size_t>(low[1] + j) + std::size_t(of_all[1]) * static_cast<std::size_t>(low[2] + k);
      const Sample* const row = samples.data() + static_cast<std::size_t>(low[0]) + std::size_t(of_all[0]) * at;
      kept.insert(kept.end(), row, row + dims[0]);
    }
  }
  return SampleArray<Sample>(std::move(kept));
}

// The part as the grid counts its samples.
SamplePart part_of_grid(const ScalarGrid& grid, const SampleRegion& region) {
  SamplePart part = part_of(grid.dims(), region);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (grid.backwards()[axis]) part.low[axis] = grid.dims()[axis] - part.low[axis] - part.dims[axis];
  }
  return part;
}

}  // namespace

bool SampleRegion::is_all() const {
  bool is_so = true;
  for (std::size_t axis = 0; axis < 3; ++axis) is_so = is_so && !first[axis] && !last[axis];
  return is_so;
}

SampleRegion parse_region(const std::string& text, const std::string& source) {
  SampleRegion region;
  std::string_view left = text;
  const auto take = [&](char end, std::optional<std::int32_t>& bound) {
    const std::size_t at = end == '\0' ? left.size() : left.find(end);
    if (at == std::string_view::npos) refuse_region(text, source);
    const std::string_view number = left.substr(0, at);
    if (!number.empty()) {
      std::int32_t value = 0;
      const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), value);
      if (error != std::errc() || stop != number.data() + number.size() || value < 0) refuse_region(text, source);
      bound = value;
    }
    left.remove_prefix(end == '\0' ? at : at + 1);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    take(':', region.first[axis]);
    take(axis < 2 ? ',' : '\0', region.last[axis]);
  }
  return region;
}

std::string region_text(const SampleRegion& region) {
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto number = [](const std::optional<std::int32_t>& bound) { return bound ? std::to_string(*bound) : ""; };
    text += (axis > 0 ? "," : "") + number(region.first[axis]) + ":" + number(region.last[axis]);
  }
  return text;
}

SamplePart part_of(const Dims& all, const SampleRegion& region) {
  SamplePart part;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t end = all[axis] - 1, last = region.last[axis].value_or(end);
    part.low[axis] = region.first[axis].value_or(0);
    if (last > end || part.low[axis] >= last) {
      throw InputError("region: along " + std::string(kAxes[axis]) + " the volume has the samples 0 to " +
                       std::to_string(end) + ", expected at least two of them, found " +
                       std::to_string(part.low[axis]) + " to " + std::to_string(last));
    }
    part.dims[axis] = last - part.low[axis] + 1;
  }
  return part;
}

Samples cropped(const Samples& samples, const ScalarGrid& grid, const SampleRegion& region) {
  const SamplePart part = part_of_grid(grid, region);
  return visit_samples(samples, [&](const auto& all) { return crop(all, grid.dims(), part.low, part.dims); });
}

ScalarGrid cropped(const ScalarGrid& grid, const SampleRegion& region) {
  const SamplePart part = part_of_grid(grid, region);
  Vec3 origin = grid.origin();
  for (std::size_t axis = 0; axis < 3; ++axis) origin[axis] += part.low[axis] * grid.spacing()[axis];
  ScalarGrid kept(part.dims, cropped(grid.samples(), grid, region), grid.spacing(), origin);
  kept.set_backwards(grid.backwards());
  return kept;
}

}  // namespace deliso

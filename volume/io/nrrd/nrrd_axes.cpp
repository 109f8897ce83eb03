#include "volume/io/nrrd/nrrd_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "volume/io/base/volume.h"

namespace deliso {

namespace {

constexpr std::size_t kMostAxes = 16;  // of the format

std::vector<std::int64_t> read_sizes(const NrrdFields& fields) {
  const NrrdField& dimension = fields.required("dimension");
  const std::int64_t count = fields.integer(dimension, dimension.value);
  if (count < 3 || count > static_cast<std::int64_t>(kMostAxes))
    fields.fail_value(dimension, "3 (or more, when some axes count channels)");
  const NrrdField& field = fields.required("sizes");
  std::vector<std::int64_t> sizes;
  for (const std::string& word : fields.words(field, static_cast<std::size_t>(count))) {
    sizes.push_back(fields.integer(field, word));
    if (sizes.back() < 1) fields.fail_value(field, "at least one sample along each axis");
  }
  return sizes;
}

// Which axes have a direction, or a kind that says that they are of space; nothing when the header does not tell.
std::optional<std::vector<bool>> read_spatial_axes(const NrrdFields& fields, std::size_t count) {
  std::vector<bool> spatial;
  if (const NrrdField* field = fields.find("space directions")) {
    for (const std::optional<Vec3>& direction : fields.vectors(*field, count)) spatial.push_back(direction.has_value());
    if (count == 3 && std::count(spatial.begin(), spatial.end(), true) != 3)
      fields.fail_value(*field, "a direction for each axis of the volume");
    return spatial;
  }
  if (const NrrdField* field = fields.find("kinds")) {
    for (const std::string& kind : fields.words(*field, count)) {
      const std::string name = in_small_letters(kind);
      spatial.push_back(name == "domain" || name == "space");
    }
    if (std::count(spatial.begin(), spatial.end(), true) == 3) return spatial;
  }
  return std::nullopt;
}

// The first of the three axes that the header marks.
std::size_t first_marked(const NrrdFields& fields, const std::vector<std::int64_t>& sizes,
                         const std::vector<bool>& spatial) {
  std::vector<std::size_t> marked;
  for (std::size_t n = 0; n < spatial.size(); ++n) {
    if (spatial[n]) marked.push_back(n);
  }
  if (marked.size() == 3 && marked[2] == marked[0] + 2) return marked[0];
  const NrrdField* field = fields.find("space directions");
  fields.fail_value(field != nullptr ? *field : fields.required("kinds"),
                    "three axes of space that follow each other, of the " + std::to_string(sizes.size()) + " axes");
}

std::size_t first_axis(const NrrdFields& fields, const std::vector<std::int64_t>& sizes) {
  if (const auto spatial = read_spatial_axes(fields, sizes.size())) return first_marked(fields, sizes, *spatial);
  if (sizes.size() == 3) return 0;
  if (sizes.size() == 4) return sizes.back() == 1 || sizes.front() >= sizes.back() ? 0 : 1;
  fields.fail_value(fields.required("dimension"), "\"kinds\" or \"space directions\" that tell the axes of space");
}

// The numbers of a per-axis field for x, y and z; NaN where the file says NaN. `fallback` when the field is missing.
Vec3 read_per_axis(const NrrdFields& fields, const NrrdAxes& axes, const char* name, double fallback) {
  const NrrdField* field = fields.find(name);
  Vec3 out{fallback, fallback, fallback};
  if (field == nullptr) return out;
  const std::vector<std::string> words = fields.words(*field, axes.count);
  for (std::size_t n = 0; n < 3; ++n) {
    const std::string& word = words[axes.first + n];
    const bool unknown = word == "nan" || word == "NaN" || word == "NAN" || word == "???";
    out[n] = unknown ? fallback : fields.number(*field, word);
  }
  return out;
}

// Whether the samples of an axis are centers of cells or nodes of the grid.
enum class Centering { kUnknown, kCell, kNode };

std::array<Centering, 3> read_centerings(const NrrdFields& fields, const NrrdAxes& axes) {
  std::array<Centering, 3> centerings{};
  const NrrdField* field = fields.find("centers");
  if (field == nullptr) return centerings;
  const std::vector<std::string> words = fields.words(*field, axes.count);
  for (const std::string& word : words) {
    if (word != "cell" && word != "node" && word != "none" && word != "???") {
      fields.fail_value(*field, "cell, node, none or ??? for each axis");
    }
  }
  for (std::size_t n = 0; n < 3; ++n) {
    const std::string& word = words[axes.first + n];
    if (word == "cell") centerings[n] = Centering::kCell;
    if (word == "node") centerings[n] = Centering::kNode;
  }
  return centerings;
}

// Do the samples fill the range? Where their centering is unknown, either one may. Headers round their numbers.
bool fills(double range, double spacing, std::int32_t samples, Centering centering) {
  constexpr double kRounding = 1e-3;
  const auto agrees = [&](double intervals) { return std::abs(range - spacing * intervals) <= kRounding * range; };
  return (centering != Centering::kCell && agrees(samples - 1)) || (centering != Centering::kNode && agrees(samples));
}

// Spacing and origin from `spacings`, `axis mins` and `axis maxs`.
Affine read_axis_geometry(const NrrdFields& fields, const NrrdAxes& axes) {
  Vec3 spacing_of, origin;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const Vec3 spacings = read_per_axis(fields, axes, "spacings", kUnknown);
  const Vec3 mins = read_per_axis(fields, axes, "axis mins", kUnknown);
  const Vec3 maxs = read_per_axis(fields, axes, "axis maxs", kUnknown);
  const std::array<Centering, 3> centerings = read_centerings(fields, axes);
  for (std::size_t n = 0; n < 3; ++n) {
    const bool cell_centered = centerings[n] == Centering::kCell;
    const double intervals = axes.dims[n] - (cell_centered ? 0 : 1);
    double spacing = spacings[n];
    if (std::isnan(spacing)) spacing = (maxs[n] - mins[n]) / intervals;
    if (std::isnan(spacing)) spacing = 1;
    if (!(spacing > 0) || !std::isfinite(spacing)) {
      const NrrdField* field = fields.find("spacings");
      fields.fail_value(field != nullptr ? *field : fields.required("axis maxs"), "a positive spacing along each axis");
    }
    const double range = maxs[n] - mins[n];
    if (!std::isnan(range) && !fills(range, spacing, axes.dims[n], centerings[n])) {
      fields.fail_value(fields.required("axis maxs"), "maxima that agree with \"axis mins\" and \"spacings\"");
    }
    spacing_of[n] = spacing;
    if (!std::isnan(mins[n])) origin[n] = mins[n] + (cell_centered ? spacing / 2 : 0);
  }
  return affine_of(spacing_of, origin);
}

// Every axis of the volume has a direction, whatever it is.
Affine read_space_geometry(const NrrdFields& fields, const NrrdAxes& axes, const NrrdField& field) {
  Affine map;
  if (fields.find("spacings") != nullptr)
    fields.fail_value(field, "either \"space directions\" or \"spacings\", not both");
  const std::vector<std::optional<Vec3>> directions = fields.vectors(field, axes.count);
  for (std::size_t n = 0; n < 3; ++n) map.columns[n] = directions[axes.first + n].value_or(Vec3{});
  return map;
}

}  // namespace

NrrdAxes read_nrrd_axes(const NrrdFields& fields) {
  const std::vector<std::int64_t> sizes = read_sizes(fields);
  const NrrdField& field = fields.required("sizes");
  NrrdAxes axes;
  axes.count = sizes.size();
  axes.first = first_axis(fields, sizes);
  constexpr std::uint64_t kMostChannels = std::uint64_t{1} << 40;
  for (std::size_t n = 0; n < sizes.size(); ++n) {
    if (n >= axes.first && n < axes.first + 3) {
      if (sizes[n] < 2 || sizes[n] > std::numeric_limits<std::int32_t>::max() - 2)
        fields.fail_value(field, "at least 2 and less than 2^31 - 2 samples along each axis of the volume");
      axes.dims[n - axes.first] = static_cast<std::int32_t>(sizes[n]);
      continue;
    }
    std::uint64_t& channels = n < axes.first ? axes.components : axes.volumes;
    if (static_cast<std::uint64_t>(sizes[n]) > kMostChannels / channels)
      fields.fail_value(field, "fewer than 2^40 channels");
    channels *= static_cast<std::uint64_t>(sizes[n]);
  }
  return axes;
}

Affine read_nrrd_geometry(const NrrdFields& fields, const NrrdAxes& axes) {
  Affine map = read_axis_geometry(fields, axes);
  if (const NrrdField* field = fields.find("space directions")) {
    const Vec3 origin = map.offset;
    map = read_space_geometry(fields, axes, *field);
    map.offset = origin;
  }
  if (const NrrdField* origin = fields.find("space origin"))
    map.offset = fields.vectors(*origin, 1)[0].value_or(Vec3{});
  const NrrdField* field = fields.find("space directions");
  if (field == nullptr) return map;
  try {
    static_cast<void>(frame_of(map));
  } catch (const InputError& error) {
    fields.fail(field->line, error.what());
  }
  return map;
}

}  // namespace deliso

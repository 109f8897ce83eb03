#include "volume/io/nrrd_header.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "volume/io/nrrd_fields.h"

namespace deliso {

namespace {

// Which of the file's axes are the volume's x, y, z: all three, or three of four when one has a single sample.
struct Axes {
  std::size_t count = 0;                // axes in the file
  std::array<std::size_t, 3> of_xyz{};  // the file's axis of x, y and z
  Dims dims{};
};

Axes read_axes(const NrrdFields& fields) {
  const NrrdField& dimension = fields.required("dimension");
  const std::int64_t count = fields.integer(dimension, dimension.value);
  if (count != 3 && count != 4)
    fields.fail_value(dimension, "3 (or 4, when the first or the last axis has one sample)");
  Axes axes;
  axes.count = static_cast<std::size_t>(count);
  const NrrdField& field = fields.required("sizes");
  const std::vector<std::string> words = fields.words(field, axes.count);
  std::vector<std::int64_t> sizes;
  sizes.reserve(words.size());
  for (const std::string& word : words) sizes.push_back(fields.integer(field, word));

  // Of four axes leave out one with a single sample: the last (one time step) or the first (one component).
  std::size_t first = 0;
  if (axes.count == 4 && sizes[3] != 1) {
    if (sizes[0] != 1) fields.fail_value(field, "a scalar volume: the first or the last of four axes must have size 1");
    first = 1;
  }
  for (std::size_t n = 0; n < 3; ++n) {
    const std::int64_t size = sizes[first + n];
    if (size < 2 || size > std::numeric_limits<std::int32_t>::max() - 2)
      fields.fail_value(field, "at least 2 and less than 2^31 - 2 samples along each axis of the volume");
    axes.of_xyz[n] = first + n;
    axes.dims[n] = static_cast<std::int32_t>(size);
  }
  return axes;
}

SampleType read_type(const NrrdFields& fields) {
  const NrrdField& field = fields.required("type");
  const std::optional<SampleType> type = parse_sample_type(field.value);
  if (!type) fields.fail_value(field, supported_sample_types());
  return *type;
}

Compression read_encoding(const NrrdFields& fields) {
  const NrrdField& field = fields.required("encoding");
  if (field.value == "raw") return Compression::kNone;
  if (field.value == "gzip" || field.value == "gz") return Compression::kGzip;
  fields.fail_value(field, "raw or gzip");
}

// The byte order may be left out only for samples of one byte.
Endian read_endian(const NrrdFields& fields, SampleType type) {
  const NrrdField* field = fields.find("endian");
  if (field == nullptr) {
    if (sample_size(type) == 1) return kHostEndian;
    fields.fail("the header has no field \"endian\", which samples of more than one byte need");
  }
  if (field->value == "little") return Endian::kLittle;
  if (field->value == "big") return Endian::kBig;
  fields.fail_value(*field, "little or big");
}

// The numbers of a per-axis field for x, y and z; NaN where the file says NaN. `fallback` when the field is missing.
Vec3 read_per_axis(const NrrdFields& fields, const Axes& axes, const char* name, double fallback) {
  const NrrdField* field = fields.find(name);
  Vec3 out{fallback, fallback, fallback};
  if (field == nullptr) return out;
  const std::vector<std::string> words = fields.words(*field, axes.count);
  for (std::size_t n = 0; n < 3; ++n) {
    const std::string& word = words[axes.of_xyz[n]];
    const bool unknown = word == "nan" || word == "NaN" || word == "NAN" || word == "???";
    out[n] = unknown ? fallback : fields.number(*field, word);
  }
  return out;
}

// Whether the samples of an axis are centers of cells or nodes of the grid.
enum class Centering { kUnknown, kCell, kNode };

std::array<Centering, 3> read_centerings(const NrrdFields& fields, const Axes& axes) {
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
    const std::string& word = words[axes.of_xyz[n]];
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
void read_axis_geometry(const NrrdFields& fields, const Axes& axes, NrrdHeader& header) {
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
    header.spacing[n] = spacing;
    if (!std::isnan(mins[n])) header.origin[n] = mins[n] + (cell_centered ? spacing / 2 : 0);
  }
}

// Checks fields that we do not use; a wrong value there shows that the header is damaged.
void check_unused_fields(const NrrdFields& fields, const Axes& axes) {
  for (const char* name : {"kinds", "thicknesses"}) {
    if (const NrrdField* field = fields.find(name)) static_cast<void>(fields.words(*field, axes.count));
  }
  const NrrdField* dimension = fields.find("space dimension");
  if (dimension != nullptr && fields.integer(*dimension, dimension->value) != 3) {
    fields.fail_value(*dimension, "3, as the vectors of a volume have");
  }
}

// Spacing, origin and flips from `space directions` and `space origin`. Every direction must lie along its own axis.
void read_space_geometry(const NrrdFields& fields, const Axes& axes, NrrdHeader& header) {
  if (const NrrdField* origin = fields.find("space origin"))
    header.origin = fields.vectors(*origin, 1)[0].value_or(Vec3{});
  const NrrdField* field = fields.find("space directions");
  if (field == nullptr) return;
  if (fields.find("spacings") != nullptr)
    fields.fail_value(*field, "either \"space directions\" or \"spacings\", not both");
  const std::vector<std::optional<Vec3>> directions = fields.vectors(*field, axes.count);
  for (std::size_t n = 0; n < 3; ++n) {
    const std::optional<Vec3>& direction = directions[axes.of_xyz[n]];
    if (!direction) fields.fail_value(*field, "a direction for each axis of the volume");
    const double along = (*direction)[n];
    if (along == 0 || (*direction)[(n + 1) % 3] != 0 || (*direction)[(n + 2) % 3] != 0)
      fields.fail_value(
          *field, "directions along the axes x, y, z in this order (oblique and permuted volumes are not supported)");
    header.spacing[n] = std::abs(along);
    header.layout.flipped[n] = along < 0;
    if (header.layout.flipped[n]) header.origin[n] += along * (axes.dims[n] - 1);
  }
}

void read_place_of_data(const NrrdFields& fields, const InputFile& file, NrrdHeader& header) {
  if (const NrrdField* field = fields.find("data file")) {
    const std::string& name = field->value;
    if (name.empty()) fields.fail_value(*field, "a file name");
    if (name.rfind("LIST", 0) == 0 || name.find('%') != std::string::npos)
      fields.fail_value(*field, "one file name (data in several files are not supported)");
    header.data_file = file.path().parent_path() / name;
  } else if (file.path().extension() == ".nhdr") {
    fields.fail("the header has no field \"data file\"");
  } else if (!fields.ended_by_blank_line()) {
    fields.fail("the file ends within the header: no blank line and no data follow");
  }
  if (const NrrdField* field = fields.find("line skip")) {
    const std::int64_t lines = fields.integer(*field, field->value);
    if (lines < 0) fields.fail_value(*field, "0 or more");
    header.skipped_lines = static_cast<std::uint64_t>(lines);
  }
  if (const NrrdField* field = fields.find("byte skip")) {
    const std::int64_t bytes = fields.integer(*field, field->value);
    header.skip_from_end = bytes == -1 && header.layout.compression == Compression::kNone;
    if (bytes < 0 && !header.skip_from_end) fields.fail_value(*field, "0 or more (or -1 with the encoding raw)");
    header.layout.skipped_bytes = header.skip_from_end ? 0 : static_cast<std::uint64_t>(bytes);
  }
}

}  // namespace

NrrdHeader read_nrrd_header(InputFile& file) {
  const NrrdFields fields(file);
  const Axes axes = read_axes(fields);
  NrrdHeader header;
  header.layout.dims = axes.dims;
  header.layout.type = read_type(fields);
  header.layout.compression = read_encoding(fields);
  header.layout.endian = read_endian(fields, header.layout.type);
  check_unused_fields(fields, axes);
  read_axis_geometry(fields, axes, header);
  read_space_geometry(fields, axes, header);
  read_place_of_data(fields, file, header);
  return header;
}

}  // namespace deliso

#include "experiments/commands/command_line.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "experiments/system/files.h"
#include "experiments/system/parse_number.h"
#include "experiments/system/shrinking_input.h"
#include "experiments/system/standard_input.h"
#include "volume/io/base/input_file.h"
#include "volume/io/volume_file.h"
#include "volume/region.h"
#include "volume/regular_isovalue.h"
#include "volume/sample_type.h"

namespace deliso {
namespace {

// "256,256,98" as three texts.
std::vector<std::string> three_parts(const std::string& text, const std::string& option) {
  std::vector<std::string> parts;
  std::istringstream stream(text + ',');
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  if (parts.size() != 3) throw InputError(option + ": expected three numbers A,B,C, found '" + text + "'");
  return parts;
}

Vec3 parse_spacing(const std::string& text) {
  Vec3 spacing;
  const std::vector<std::string> parts = three_parts(text, "--spacing");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    spacing[axis] = parse_number(parts[axis], "--spacing", text);
    if (spacing[axis] <= 0) throw InputError("--spacing: expected numbers > 0, found '" + text + "'");
  }
  return spacing;
}

Dims parse_dims(const std::string& text) {
  Dims dims{};
  const std::vector<std::string> parts = three_parts(text, "--dims");
  constexpr std::uint64_t kLargest = std::numeric_limits<std::int32_t>::max();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    dims[axis] = static_cast<std::int32_t>(parse_count(parts[axis], "--dims", 2, kLargest));
  }
  return dims;
}

RawOptions raw_options(const VolumeOptions& options) {
  RawOptions raw;
  if (!options.dims.empty()) raw.dims = parse_dims(options.dims);
  if (!options.spacing.empty()) raw.spacing = parse_spacing(options.spacing);
  if (!options.skip.empty()) raw.header_bytes = parse_count(options.skip, "--skip", 0, std::uint64_t{1} << 62);
  raw.type = options.type;
  if (!raw.type.empty() && !parse_stored_type(raw.type)) {
    throw InputError("--type: expected " + supported_sample_types() + ", found '" + raw.type + "'");
  }
  if (options.endian == "big") raw.endian = Endian::kBig;
  if (!options.endian.empty() && options.endian != "big" && options.endian != "little") {
    throw InputError("--endian: expected little or big, found '" + options.endian + "'");
  }
  return raw;
}

// The format as typed, in letters of any case and perhaps with the .gz of a packed file.
std::string parse_volume_format(const std::string& text) {
  std::string format = text;
  std::transform(format.begin(), format.end(), format.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (format.ends_with(".gz")) format.resize(format.size() - 3);
  if (format.empty() || is_volume_format(format)) return format;
  std::string expected(kVolumeExtensions);
  std::erase(expected, '.');
  throw InputError("--volume-format: expected " + expected + ", found '" + text + "'");
}

// Messages call it by its own name, not by that of the file it is kept in.
Volume volume_of_standard_input(ReadOptions read, const std::string& format) {
  read.format = format;
  read.stands_alone = true;
  const std::string path = standard_input_file().string();
  try {
    return read_placed_volume(path, read);
  } catch (const InputError& error) {
    std::string text = error.what();
    for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path))
      text.replace(at, path.size(), "standard input");
    const std::string unknown = "has no extension";
    if (const std::size_t at = text.find(unknown); at != std::string::npos)
      text.replace(at, unknown.size(), "its beginning tells no format (--volume-format names one)");
    throw InputError(text);
  }
}

}  // namespace

void add_volume_options(Command& command, VolumeOptions& options) {
  command
      .add_option("VOLUME", options.path,
                  "The volume: " + std::string(kVolumeExtensions) + "; each may be packed (.gz); - is standard input")
      .type_name("")
      .required()
      .check(refuse_empty_name);
  command.add_option("--dims", options.dims, "Of a .raw file: samples along x,y,z (default: from its name)")
      .type_name("NX,NY,NZ")
      .check(refuse_empty_value);
  command
      .add_option("--type", options.type, "Of a .raw file: " + supported_sample_types() + " (default: from its name)")
      .type_name("T")
      .check(refuse_empty_value);
  command.add_option("--endian", options.endian, "Of a .raw file: little (default) or big")
      .type_name("ORDER")
      .check(refuse_empty_value);
  command.add_option("--spacing", options.spacing, "Of a .raw file: distances of samples along x,y,z (default 1,1,1)")
      .type_name("SX,SY,SZ")
      .check(refuse_empty_value);
  command.add_option("--skip", options.skip, "Of a .raw file: bytes before the first sample (default 0)")
      .type_name("BYTES")
      .check(refuse_empty_value);
  command
      .add_option("--channel", options.channel, "Of a file with several values a voxel, or several volumes: which one")
      .type_name("N")
      .check(refuse_empty_value);
  command
      .add_option("--volume-format", options.format,
                  "Of standard input: nrrd, nii, mha, npy, raw, ... (default: told by its beginning)")
      .type_name("F")
      .check(refuse_empty_value);
  command.add_option("--array", options.array, "Of a .vtk or .vti file with several arrays: which one")
      .type_name("NAME")
      .check(refuse_empty_value);
}

void add_region_option(Command& command, VolumeOptions& options) {
  command.add_option("--region", options.region, "The samples i0:i1,j0:j1,k0:k1 alone, the last ones included")
      .type_name("R")
      .check(refuse_empty_value);
}

namespace {

// The samples of a region alone, those that are not finite among them counted anew.
void crop(Volume& volume, const SampleRegion& region) {
  if (volume.as_read) {
    Samples kept = cropped(*volume.as_read, volume.grid, region);
    volume.not_finite = count_not_finite(kept);
    volume.as_read.reset();
    if (volume.not_finite.count() > 0) volume.as_read = std::move(kept);
  }
  volume.whole_origin = volume.grid.origin();
  volume.first = part_of(volume.grid.dims(), region).low;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Affine& map = volume.index_to_world;
    map.offset = map.offset + volume.first[axis] * map.columns[axis];
  }
  volume.grid = cropped(volume.grid, region);
  if (!volume.as_read) return;
  // What stands for NaN and infinities is taken from these samples alone.
  const auto [low, high] = finite_range(*volume.as_read);
  ScalarGrid finite(volume.grid.dims(), with_finite_samples(*volume.as_read, low, low, high), volume.grid.spacing(),
                    volume.grid.origin());
  finite.set_backwards(volume.grid.backwards());
  volume.grid = std::move(finite);
}

}  // namespace

Volume load_volume(const VolumeOptions& options) {
  const SampleRegion region = options.region.empty() ? SampleRegion() : parse_region(options.region, "--region");
  const bool described = !options.dims.empty() || !options.type.empty() || !options.endian.empty() ||
                         !options.spacing.empty() || !options.skip.empty();
  const bool is_stream = is_standard_stream(options.path);
  if (!options.format.empty() && !is_stream)
    throw InputError("--volume-format is that of standard input, but the volume is " + options.path);
  const std::string format = parse_volume_format(options.format);
  const std::string extension = is_stream ? "." + format : lower_case_extension(options.path);
  if (described && extension != ".raw") {
    throw InputError("--dims, --type, --endian, --spacing and --skip describe a .raw file, but the volume is " +
                     options.path);
  }
  if (!options.array.empty() && extension != ".vtk" && extension != ".vti" && extension != ".") {
    throw InputError("--array names an array of a .vtk or .vti file, but the volume is " + options.path);
  }
  ReadOptions read = raw_options(options);
  if (!options.channel.empty()) {
    read.channel = parse_count(options.channel, "--channel", 0, std::uint64_t{1} << 40);
    if (extension == ".raw") throw InputError("--channel: a .raw file has one value a voxel, " + options.path);
  }
  read.array = options.array;
  read.accepts_not_finite = true;
  if (!is_stream) end_where_input_shrinks(options.path);
  Volume volume = is_stream ? volume_of_standard_input(read, format) : read_placed_volume(options.path, read);
  if (!region.is_all()) crop(volume, region);
  return volume;
}

namespace {

bool has_sample_at(const ScalarGrid& grid, double value) {
  return samples_around(grid, std::nextafter(value, std::numeric_limits<double>::infinity())).first == value;
}

}  // namespace

void remark_isovalue(const ScalarGrid* grid, double isovalue, double used) {
  if (used == isovalue) return;
  const std::string at = grid == nullptr                                 ? "a sample or a saddle of the interpolant"
                         : regular_isovalue(*grid, isovalue) == isovalue ? "a saddle of the interpolant"
                         : has_sample_at(*grid, isovalue)                ? "a sample"
                                                                         : "up to rounding, a sample";
  // Few digits, unless they would be those of the isovalue itself.
  const std::string used_text = short_text(used) == short_text(isovalue) ? shortest_text(used) : short_text(used);
  std::cerr << "deliso: " << at << " equals the isovalue " << shortest_text(isovalue)
            << ", so the isosurface is singular; used " << used_text << " instead\n";
}

}  // namespace deliso

#include "volume/io/raw.h"

#include <charconv>
#include <limits>
#include <regex>

#include "delaunay/base/check.h"
#include "volume/io/atomic_file.h"
#include "volume/io/input_file.h"

namespace deliso {

namespace {

// Dims and type as written in a file name.
struct NamedLayout {
  Dims dims{};
  std::string type;
};

// name_256x256x98_uint8.raw; other words may follow the type.
std::optional<NamedLayout> layout_in_name(const std::filesystem::path& path) {
  const std::regex pattern("(?:^|_)([0-9]+)x([0-9]+)x([0-9]+)_([A-Za-z0-9]+)(?:_|\\.|$)");
  const std::string name = path.filename().string();
  std::smatch match;
  if (!std::regex_search(name, match, pattern)) return std::nullopt;
  NamedLayout layout;
  layout.type = match[4];
  for (std::size_t n = 0; n < 3; ++n) {
    const std::string digits = match[n + 1];
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), layout.dims[n]);
    if (error != std::errc()) layout.dims[n] = std::numeric_limits<std::int32_t>::max();
  }
  return layout;
}

std::string text(const Dims& dims, char between) {
  return std::to_string(dims[0]) + between + std::to_string(dims[1]) + between + std::to_string(dims[2]);
}

}  // namespace

ScalarGrid read_raw(const std::filesystem::path& path, const RawOptions& options) {
  InputFile file(path);
  const std::optional<NamedLayout> named = layout_in_name(path);
  if (!named && (!options.dims || options.type.empty()))
    file.fail("a raw file needs dimensions and a type: give them, or name the file like name_256x256x98_uint8.raw");
  const std::string type_name = options.type.empty() ? named->type : options.type;
  const std::optional<SampleType> type = parse_sample_type(type_name);
  if (!type) file.fail("the type is \"" + type_name + "\", expected " + supported_sample_types());
  SampleLayout layout;
  layout.type = *type;
  layout.dims = options.dims ? *options.dims : named->dims;
  layout.endian = options.endian;
  if (options.header_bytes > file.remaining())
    file.fail("the header should have " + std::to_string(options.header_bytes) + " bytes, but the file has " +
              std::to_string(file.remaining()));
  file.skip(options.header_bytes);
  Samples samples = read_samples(file, layout);
  return make_grid(file, layout.dims, std::move(samples), options.spacing, options.origin);
}

void write_raw(const ScalarGrid& grid, const std::filesystem::path& path) {
  // A raw file keeps no header: refuse what could not be read back.
  const SampleType type = sample_type(grid.samples());
  const std::optional<NamedLayout> named = layout_in_name(path);
  if (!named || named->dims != grid.dims() || parse_sample_type(named->type) != type)
    throw InputError(path.string() + ": the name of a raw file must end in _" + text(grid.dims(), 'x') + "_" +
                     nrrd_type_name(type) + ".raw, the only place that keeps its dimensions and type");
  if (grid.spacing() != Vec3{1, 1, 1} || grid.origin() != Vec3{0, 0, 0})
    throw InputError(path.string() + ": a raw file cannot keep a spacing or an origin, write .nrrd");
  AtomicFile file(path);
  if (kHostEndian == Endian::kLittle) {
    file.write(sample_bytes(grid.samples()));
  } else {
    Samples swapped = grid.samples();
    swap_bytes(swapped);
    file.write(sample_bytes(swapped));
  }
  file.commit();
}

}  // namespace deliso

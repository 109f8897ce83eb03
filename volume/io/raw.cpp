#include "volume/io/raw.h"

#include <charconv>
#include <limits>
#include <string_view>
#include <vector>

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

// 256x256x98, or nothing. Numbers beyond the range of Dims become its largest: they are refused later.
std::optional<Dims> parsed_dims(std::string_view word) {
  Dims dims{};
  for (std::size_t n = 0; n < 3; ++n) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), dims[n]);
    if (error == std::errc::invalid_argument || dims[n] < 0) return std::nullopt;
    if (error != std::errc()) dims[n] = std::numeric_limits<std::int32_t>::max();
    word.remove_prefix(static_cast<std::size_t>(end - word.data()));
    if (n == 2) break;
    if (word.empty() || word.front() != 'x') return std::nullopt;
    word.remove_prefix(1);
  }
  return word.empty() ? std::optional(dims) : std::nullopt;
}

// name_256x256x98_uint8.raw: the word after the dims is the type; other words may follow.
std::optional<NamedLayout> layout_in_name(const std::filesystem::path& path) {
  std::vector<std::string> words(1);
  for (const char c : path.stem().string()) {
    if (c == '_') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  for (std::size_t n = 0; n + 1 < words.size(); ++n)
    if (const std::optional<Dims> dims = parsed_dims(words[n])) return NamedLayout{*dims, words[n + 1]};
  return std::nullopt;
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

void write_raw(const VolumeHeader& header, const SampleSource& next, const std::filesystem::path& path) {
  // A raw file keeps no header: refuse what could not be read back.
  const std::optional<NamedLayout> named = layout_in_name(path);
  if (!named || named->dims != header.dims || parse_sample_type(named->type) != header.type)
    throw InputError(path.string() + ": the name of a raw file must end in _" + text(header.dims, 'x') + "_" +
                     nrrd_type_name(header.type) + ".raw, the only place that keeps its dimensions and type");
  if (header.spacing != Vec3{1, 1, 1} || header.origin != Vec3{0, 0, 0})
    throw InputError(path.string() + ": a raw file cannot keep a spacing or an origin, write .nrrd");
  AtomicFile file(path);
  for_each_piece(header, next, [&file](const Samples& samples) {
    const Samples little = little_endian(samples);
    file.write(sample_bytes(little));
  });
  file.commit();
}

}  // namespace deliso

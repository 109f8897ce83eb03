#include "volume/io/raw/raw.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>
#include <vector>

#include "delaunay/base/check.h"
#include "volume/io/base/atomic_file.h"
#include "volume/io/base/input_file.h"

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

// name_256x256x98_uint8.raw: dims are a word of the name, and the type is the word after it, or another word.
std::optional<NamedLayout> layout_in_name(const std::filesystem::path& path) {
  std::filesystem::path stem = path.stem();
  if (lower_case_extension(stem) == ".raw") stem = stem.stem();  // name.raw.gz
  std::vector<std::string> words(1);
  for (const char c : stem.string()) {
    if (c == '_' || c == '-' || c == ' ') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  for (std::size_t n = 0; n < words.size(); ++n) {
    const std::optional<Dims> dims = parsed_dims(words[n]);
    if (!dims) continue;
    const std::string next = n + 1 < words.size() ? words[n + 1] : "";
    if (parse_stored_type(next)) return NamedLayout{*dims, next};
    for (const std::string& word : words) {
      if (parse_stored_type(word)) return NamedLayout{*dims, word};
    }
    return NamedLayout{*dims, next};
  }
  return std::nullopt;
}

std::string text(const Dims& dims, char between) {
  return std::to_string(dims[0]) + between + std::to_string(dims[1]) + between + std::to_string(dims[2]);
}

}  // namespace

Volume read_raw(const std::filesystem::path& path, const RawOptions& options) {
  UnpackedFile unpacked(path);
  InputFile& file = unpacked.file();
  const std::optional<NamedLayout> named = layout_in_name(path);
  const std::string type_name = !options.type.empty() ? options.type : named ? named->type : "";
  if ((!named && !options.dims) || type_name.empty())
    file.fail("a raw file needs dimensions and a type: give them, or name the file like name_256x256x98_uint8.raw");
  const std::optional<StoredType> type = parse_stored_type(type_name);
  if (!type) file.fail("the type is \"" + type_name + "\", expected " + supported_sample_types());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(options.spacing[axis] > 0)) file.fail("the spacing must be positive along each axis");
  }
  VolumeDescription volume;
  volume.format = "raw";
  volume.index_to_world = affine_of(options.spacing, options.origin);
  volume.layout.type = *type;
  volume.layout.dims = options.dims ? *options.dims : named->dims;
  volume.layout.endian = options.endian;
  // Samples may begin as gzip does: the size tells.
  const std::uint64_t bytes = std::uint64_t{sample_count_of(file, volume.layout.dims)} * stored_size(*type);
  const bool is_packed = unpacked.is_packed() && file.size() - std::min(file.size(), options.header_bytes) != bytes;
  if (!is_packed && options.header_bytes > file.remaining())
    file.fail("the header should have " + std::to_string(options.header_bytes) + " bytes, but the file has " +
              std::to_string(file.remaining()));
  ByteStream& stream = is_packed ? unpacked.bytes() : file;
  stream.skip(options.header_bytes, "the first sample");
  return read_described(stream, volume, {}, is_packed ? nullptr : &file);
}

void write_raw(const VolumeHeader& header, const SampleSource& next, const std::filesystem::path& path) {
  // A raw file keeps no header: refuse what could not be read back.
  const std::optional<NamedLayout> named = layout_in_name(path);
  if (!named || named->dims != header.dims || parse_stored_type(named->type) != static_cast<StoredType>(header.type))
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

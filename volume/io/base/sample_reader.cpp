#include "volume/io/base/sample_reader.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "delaunay/base/check.h"
#include "delaunay/base/huge_pages.h"
#include "volume/io/base/mapped_file.h"
#include "volume/io/base/sample_conversion.h"

namespace deliso {

namespace {

constexpr std::size_t kSampleChunkBytes = std::size_t{1} << 20;

std::string bytes_text(std::uint64_t count) { return std::to_string(count) + " bytes"; }

// The bytes that a layout needs in all, checked against overflow.
struct NeededBytes {
  std::uint64_t one_volume = 0;
  std::uint64_t all = 0;
};

NeededBytes needed_bytes(const ByteStream& stream, const SampleLayout& layout, std::size_t count) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max() / 2;
  const std::uint64_t samples = std::uint64_t{count} * stored_size(layout.type);
  if (layout.components > kMost / samples || layout.volumes > kMost / (samples * layout.components))
    stream.fail("the dimensions, the type and the number of channels need more bytes than memory can address");
  return {samples * layout.components, samples * layout.components * layout.volumes};
}

[[noreturn]] void fail_too_short(const ByteStream& stream, std::uint64_t found, std::uint64_t expected) {
  stream.fail("the data end after " + bytes_text(found) + ", but the dimensions and the type need " +
              std::to_string(expected));
}

[[noreturn]] void fail_too_long(const ByteStream& stream, std::uint64_t expected) {
  stream.fail("the data go on after the " + bytes_text(expected) + " that the dimensions and the type need");
}

// One value of each place, chunk by chunk, so that memory is touched only as data really arrive. `before`: bytes that
// the volumes before took.
template <class Stored>
LargeArray<Stored> read_values(ByteStream& stream, const SampleLayout& layout, std::size_t count,
                               const NeededBytes& needed) {
  const std::uint64_t component = layout.channel % layout.components;
  const std::uint64_t before = layout.channel / layout.components * needed.one_volume;
  if (before > 0) stream.skip(before, "the channel");
  const std::uint64_t per_place = sizeof(Stored) * layout.components;
  const auto chunk = static_cast<std::size_t>(std::max<std::uint64_t>(1, kSampleChunkBytes / per_place));
  LargeArray<Stored> values;
  values.reserve(count);
  std::vector<Stored> places;
  while (values.size() < count) {
    const std::size_t done = values.size();
    const std::size_t wanted = std::min(chunk, count - done);
    std::span<Stored> into;
    if (layout.components == 1) {
      values.resize(done + wanted);
      into = std::span(values).subspan(done);
    } else {
      places.resize(wanted * static_cast<std::size_t>(layout.components));
      into = places;
    }
    const auto bytes = std::as_writable_bytes(into);
    const std::size_t found = stream.read(bytes);
    if (found < bytes.size()) fail_too_short(stream, before + done * per_place + found, needed.all);
    if (layout.components == 1) continue;
    for (std::size_t n = 0; n < wanted; ++n) values.push_back(places[n * layout.components + component]);
  }
  if (layout.endian != kHostEndian) swap_bytes(std::span(values));
  // What follows is read over: it must be there, and a compressed stream then checks its own sum.
  const std::uint64_t after = needed.all - before - needed.one_volume;
  if (after > 0) stream.skip(after, "the end of the last channel");
  return values;
}

Samples read_stored(ByteStream& stream, const SampleLayout& layout, std::size_t count, const NeededBytes& needed) {
  const auto values = [&]<class Stored>(Stored /*type*/) { return read_values<Stored>(stream, layout, count, needed); };
  switch (layout.type) {
    case StoredType::kU32:
      return narrowed(values(std::uint32_t{}), layout.dims, layout.is_z_fastest, stream);
    case StoredType::kU64:
      return narrowed(values(std::uint64_t{}), layout.dims, layout.is_z_fastest, stream);
    case StoredType::kI64:
      return narrowed(values(std::int64_t{}), layout.dims, layout.is_z_fastest, stream);
    case StoredType::kF16: {
      LargeArray<float> out;
      out.reserve(count);
      for (const std::uint16_t half : values(std::uint16_t{})) out.push_back(float_of_half(half));
      return SampleArray<float>(std::move(out));
    }
    case StoredType::kBool: {
      LargeArray<std::uint8_t> out = values(std::uint8_t{});
      for (std::uint8_t& v : out) v = v != 0 ? 1 : 0;
      return SampleArray<std::uint8_t>(std::move(out));
    }
    default:
      break;
  }
  return visit_samples(empty_samples(*kept_as(layout.type)),
                       [&]<class Sample>(const SampleArray<Sample>& /*empty*/) -> Samples {
                         return SampleArray<Sample>(values(Sample{}));
                       });
}

// The rest of the file as samples in mapped memory; nothing when they cannot be used as they lie there.
std::optional<Samples> map_samples(const InputFile& file, const SampleLayout& layout, std::size_t count) {
  const std::uint64_t offset = file.position();
  const std::size_t size = stored_size(layout.type);
  const std::optional<SampleType> type = kept_as(layout.type);
  if (!type || layout.compression != Compression::kNone || offset % size != 0) return std::nullopt;
  if (layout.components > 1 || layout.volumes > 1 || layout.is_z_fastest || layout.scale) return std::nullopt;
  if (layout.flipped[0] || layout.flipped[1] || layout.flipped[2]) return std::nullopt;
  if (layout.endian != kHostEndian && size > 1) return std::nullopt;
  const std::shared_ptr<const MappedFile> mapped = MappedFile::open(file.path(), file.size());
  if (!mapped) return std::nullopt;
  const std::span<const std::byte> bytes = mapped->bytes().subspan(static_cast<std::size_t>(offset), count * size);
  return visit_samples(empty_samples(*type), [&]<class Sample>(const SampleArray<Sample>& /*empty*/) -> Samples {
    return SampleArray<Sample>(mapped, std::span(reinterpret_cast<const Sample*>(bytes.data()), count));
  });
}

// The samples in our order and scale.
Samples arranged(Samples samples, const SampleLayout& layout) {
  if (layout.is_z_fastest) samples = transposed(samples, layout.dims);
  const auto& [x, y, z] = layout.flipped;
  if (x || y || z) samples = flipped(samples, layout.dims, layout.flipped);
  if (layout.scale) samples = rescaled(samples, layout.scale->first, layout.scale->second);
  return samples;
}

}  // namespace

Samples read_samples(ByteStream& stream, const SampleLayout& layout, const InputFile* file, std::uint64_t mapped_from) {
  std::optional<GzipReader> gzip;
  if (layout.compression == Compression::kGzip) gzip.emplace(stream);
  ByteStream& bytes = gzip ? static_cast<ByteStream&>(*gzip) : stream;
  bytes.skip(layout.skipped_bytes, "the first sample");
  // Compare the size that the header claims with what the stream can hold, before any allocation.
  const std::size_t count = sample_count_of(stream, layout.dims);
  const NeededBytes needed = needed_bytes(stream, layout, count);
  const bool is_plain = file != nullptr && !gzip;
  if (needed.all > bytes.bound()) {
    if (is_plain) fail_too_short(stream, bytes.bound(), needed.all);
    stream.fail("the dimensions and the type need " + bytes_text(needed.all) + ", but the data can hold at most " +
                std::to_string(bytes.bound()));
  }
  if (is_plain && !layout.may_go_on && needed.all < file->remaining()) fail_too_long(stream, needed.all);
  if (is_plain && file->size() >= mapped_from) {
    if (std::optional<Samples> mapped = map_samples(*file, layout, count)) return std::move(*mapped);
  }
  try {
    Samples samples = read_stored(bytes, layout, count, needed);
    // Reading one byte further also lets a compressed stream check its own sum.
    std::byte extra{};
    if (bytes.read(std::span(&extra, 1)) != 0 && !layout.may_go_on) fail_too_long(stream, needed.all);
    return arranged(std::move(samples), layout);
  } catch (const std::bad_alloc&) {
    stream.fail("the samples need " + bytes_text(needed.all) + " of memory, more than there is");
  }
}

std::size_t sample_count_of(const ByteStream& file, const Dims& dims) {
  try {
    return checked_sample_count(dims);
  } catch (const InputError& error) {
    file.fail(error.what());
  }
}

}  // namespace deliso

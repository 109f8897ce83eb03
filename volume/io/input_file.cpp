#include "volume/io/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/base/huge_pages.h"
#include "volume/io/gzip_stream.h"
#include "volume/io/mapped_file.h"

namespace deliso {

namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;
constexpr std::size_t kLongestLine = std::size_t{1} << 20;

std::string counted(std::uint64_t count, const char* unit) { return std::to_string(count) + " " + unit; }

// One interface for plain and compressed bytes.
class ByteReader {
 public:
  ByteReader(InputFile& file, Compression compression) : file_(file) {
    if (compression == Compression::kGzip) gzip_.emplace(file);
  }
  // The most bytes that can still come.
  [[nodiscard]] std::uint64_t bound() const {
    constexpr std::uint64_t kDeflateLimit = 1032;
    return gzip_ ? (file_.remaining() + 1) * kDeflateLimit : file_.remaining();
  }
  std::size_t read(std::span<std::byte> out) { return gzip_ ? gzip_->read(out) : file_.read(out); }

 private:
  InputFile& file_;
  std::optional<GzipReader> gzip_;
};

[[noreturn]] void fail_truncated(const InputFile& file, std::uint64_t found, std::uint64_t expected) {
  file.fail("the data end after " + counted(found, "bytes") + ", but the dimensions and the type need " +
            std::to_string(expected));
}

void skip_bytes(ByteReader& reader, const InputFile& file, std::uint64_t count) {
  std::vector<std::byte> sink(static_cast<std::size_t>(std::min<std::uint64_t>(count, kChunkBytes)));
  for (std::uint64_t done = 0; done < count;) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count - done, sink.size()));
    const std::size_t found = reader.read(std::span(sink).first(wanted));
    done += found;
    if (found < wanted)
      file.fail("the data end after " + counted(done, "bytes") + ", but " + counted(count, "bytes") +
                " should be skipped before the first sample");
  }
}

// Reverses the order of the samples along an axis.
template <class Sample>
void reverse_axis(std::span<Sample> samples, const Dims& dims, std::size_t axis) {
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

// Reads chunk by chunk, so that memory is touched only as data really arrive.
template <class Sample>
LargeArray<Sample> read_all(ByteReader& reader, const InputFile& file, const SampleLayout& layout, std::size_t count) {
  LargeArray<Sample> samples;
  samples.reserve(count);
  constexpr std::size_t kChunk = kChunkBytes / sizeof(Sample);
  while (samples.size() < count) {
    const std::size_t before = samples.size();
    const std::size_t wanted = std::min(kChunk, count - before);
    samples.resize(before + wanted);
    const auto bytes = std::as_writable_bytes(std::span(samples).subspan(before));
    const std::size_t found = reader.read(bytes);
    if (found < bytes.size()) fail_truncated(file, before * sizeof(Sample) + found, count * sizeof(Sample));
  }
  if (layout.endian != kHostEndian) swap_bytes(std::span(samples));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (layout.flipped[axis]) reverse_axis(std::span(samples), layout.dims, axis);
  }
  return samples;
}

[[noreturn]] void fail_too_long(const InputFile& file, std::uint64_t expected) {
  file.fail("the data go on after the " + counted(expected, "bytes") + " that the dimensions and the type need");
}

// The rest of the file as samples in mapped memory; nothing when they cannot be used as they lie there.
std::optional<Samples> map_samples(const InputFile& file, const SampleLayout& layout, std::size_t count) {
  const std::uint64_t offset = file.size() - file.remaining();
  const bool is_flipped = layout.flipped[0] || layout.flipped[1] || layout.flipped[2];
  const std::size_t size = sample_size(layout.type);
  if (layout.compression != Compression::kNone || is_flipped || offset % size != 0) return std::nullopt;
  if (layout.endian != kHostEndian && size > 1) return std::nullopt;
  const std::shared_ptr<const MappedFile> mapped = MappedFile::open(file.path(), file.size());
  if (!mapped) return std::nullopt;
  const std::span<const std::byte> bytes = mapped->bytes().subspan(static_cast<std::size_t>(offset), count * size);
  return visit_samples(empty_samples(layout.type), [&]<class Sample>(const SampleArray<Sample>& /*empty*/) -> Samples {
    return SampleArray<Sample>(mapped, std::span(reinterpret_cast<const Sample*>(bytes.data()), count));
  });
}

}  // namespace

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  const auto status = std::filesystem::status(path_, error);
  if (status.type() == std::filesystem::file_type::not_found) fail("there is no such file");
  if (error) fail("the file cannot be read: " + error.message());
  if (!std::filesystem::is_regular_file(status)) fail("this is not a regular file");
  size_ = std::filesystem::file_size(path_, error);
  if (error) fail("the file cannot be read: " + error.message());
  errno = 0;
  stream_.open(path_, std::ios::binary);
  if (!stream_) fail(std::string("the file cannot be opened: ") + std::strerror(errno));
}

std::size_t InputFile::read(std::span<std::byte> out) {
  stream_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
  if (stream_.bad()) fail("reading the file failed at byte " + std::to_string(position_));
  const auto found = static_cast<std::size_t>(stream_.gcount());
  stream_.clear();
  position_ += found;
  return found;
}

std::optional<std::string> InputFile::read_line() {
  std::string line;
  for (int c = stream_.get(); c != std::ifstream::traits_type::eof(); c = stream_.get()) {
    ++position_;
    if (c == '\n') {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      return line;
    }
    if (line.size() == kLongestLine) fail("a header line is longer than 1 MiB: this is no text");
    line += static_cast<char>(c);
  }
  stream_.clear();
  if (line.empty()) return std::nullopt;
  return line;
}

void InputFile::skip(std::uint64_t count) {
  DELISO_CHECK(count <= remaining(), "skips stay inside the file");
  position_ += count;
  stream_.seekg(static_cast<std::streamoff>(position_));
}

void InputFile::fail(const std::string& sentence) const { throw InputError(path_.string() + ": " + sentence); }

Samples read_samples(InputFile& file, const SampleLayout& layout, std::uint64_t mapped_from) {
  ByteReader reader(file, layout.compression);
  skip_bytes(reader, file, layout.skipped_bytes);
  // Compare the size that the header claims with what the file can hold, before any allocation.
  const std::size_t count = sample_count_of(file, layout.dims);
  const std::uint64_t expected = static_cast<std::uint64_t>(count) * sample_size(layout.type);
  if (expected > reader.bound()) {
    if (layout.compression == Compression::kNone) fail_truncated(file, reader.bound(), expected);
    file.fail("the dimensions and the type need " + counted(expected, "bytes") +
              ", but the compressed data can hold at most " + std::to_string(reader.bound()));
  }
  if (layout.compression == Compression::kNone && expected < file.remaining()) fail_too_long(file, expected);
  if (file.size() >= mapped_from) {
    if (std::optional<Samples> mapped = map_samples(file, layout, count)) return std::move(*mapped);
  }
  Samples samples = empty_samples(layout.type);
  try {
    samples = visit_samples(samples, [&]<class Sample>(const SampleArray<Sample>& /*empty*/) -> Samples {
      return read_all<Sample>(reader, file, layout, count);
    });
  } catch (const std::bad_alloc&) {
    file.fail("the samples need " + counted(expected, "bytes") + " of memory, more than there is");
  }
  // Reading one byte further also lets a compressed stream check its own sum.
  std::byte extra{};
  if (reader.read(std::span(&extra, 1)) != 0) fail_too_long(file, expected);
  return samples;
}

std::size_t sample_count_of(const InputFile& file, const Dims& dims) {
  try {
    return checked_sample_count(dims);
  } catch (const InputError& error) {
    file.fail(error.what());
  }
}

ScalarGrid make_grid(const InputFile& file, const Dims& dims, Samples samples, const Vec3& spacing,
                     const Vec3& origin) {
  try {
    return {dims, std::move(samples), spacing, origin};
  } catch (const InputError& error) {
    file.fail(error.what());
  }
}

}  // namespace deliso

#include "volume/io/base/gzip_stream.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"

namespace deliso {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
constexpr int kWindowBits = 15;
constexpr int kGzipOrZlib = 32;  // added to the window bits: zlib finds out which of the two it reads
constexpr int kGzip = 16;        // added to the window bits: zlib writes gzip
constexpr int kMemoryLevel = 8;

Bytef* as_zlib(std::byte* bytes) { return reinterpret_cast<Bytef*>(bytes); }

// zlib counts bytes in 32 bits: the size of the next piece.
uInt piece(std::size_t size) {
  return static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<uInt>::max()));
}

}  // namespace

struct GzipReader::State {
  explicit State(ByteStream& input) : file(input), buffer(kBufferBytes) {
    if (inflateInit2(&stream, kWindowBits + kGzipOrZlib) != Z_OK) throw std::bad_alloc();
  }
  ~State() { inflateEnd(&stream); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void refill() {
    stream.next_in = as_zlib(buffer.data());
    stream.avail_in = static_cast<uInt>(file.read(buffer));
  }
  // After the end of a member: starts the next one, or notes the end of the data.
  void next_member() {
    if (stream.avail_in == 0) refill();
    if (stream.avail_in == 0) {
      at_end = true;
      return;
    }
    constexpr Bytef kGzipMagic = 0x1f;
    if (*stream.next_in != kGzipMagic) file.fail("the compressed data are followed by bytes that are not gzip");
    if (inflateReset(&stream) != Z_OK) throw std::bad_alloc();
  }

  ByteStream& file;
  std::vector<std::byte> buffer;
  z_stream stream{};
  bool at_end = false;
};

GzipReader::GzipReader(ByteStream& file) : state_(std::make_unique<State>(file)) {}
GzipReader::~GzipReader() = default;

std::uint64_t GzipReader::bound() const {
  constexpr std::uint64_t kDeflateLimit = 1032, kLargest = std::uint64_t{1} << 62;
  const std::uint64_t left = state_->file.bound() + state_->stream.avail_in + 1;
  return left > kLargest / kDeflateLimit ? kLargest : left * kDeflateLimit;
}

std::string GzipReader::name() const { return state_->file.name(); }

std::size_t GzipReader::read(std::span<std::byte> out) {
  State& s = *state_;
  std::size_t done = 0;
  while (done < out.size() && !s.at_end) {
    if (s.stream.avail_in == 0) s.refill();
    if (s.stream.avail_in == 0) s.file.fail("the compressed data end early: the file is cut off");
    const uInt wanted = piece(out.size() - done);
    s.stream.next_out = as_zlib(out.data() + done);
    s.stream.avail_out = wanted;
    const int result = inflate(&s.stream, Z_NO_FLUSH);
    done += wanted - s.stream.avail_out;
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result == Z_STREAM_END) {
      s.next_member();
    } else if (result != Z_OK) {
      s.file.fail(std::string("the compressed data are corrupt (zlib: ") +
                  (s.stream.msg != nullptr ? s.stream.msg : "unknown error") + ")");
    }
  }
  return done;
}

struct GzipWriter::State {
  explicit State(Sink to) : sink(std::move(to)), buffer(kBufferBytes) {
    constexpr int kMethod = Z_DEFLATED;
    if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, kMethod, kWindowBits + kGzip, kMemoryLevel, Z_DEFAULT_STRATEGY) !=
        Z_OK)
      throw std::bad_alloc();
  }
  ~State() { deflateEnd(&stream); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  // Compresses what is in next_in until zlib asks for more (or, when finishing, has nothing left).
  void drain(int flush) {
    do {
      stream.next_out = as_zlib(buffer.data());
      stream.avail_out = static_cast<uInt>(buffer.size());
      const int result = deflate(&stream, flush);
      DELISO_CHECK(result != Z_STREAM_ERROR, "zlib's state is consistent");
      sink(std::span<const std::byte>(buffer).first(buffer.size() - stream.avail_out));
    } while (stream.avail_out == 0);
  }

  Sink sink;
  std::vector<std::byte> buffer;
  z_stream stream{};
};

GzipWriter::GzipWriter(Sink sink) : state_(std::make_unique<State>(std::move(sink))) {}
GzipWriter::~GzipWriter() = default;

void GzipWriter::write(std::span<const std::byte> bytes) {
  State& s = *state_;
  while (!bytes.empty()) {
    const uInt size = piece(bytes.size());
    // zlib promises not to write through next_in; its C interface only lacks the const.
    s.stream.next_in = as_zlib(const_cast<std::byte*>(bytes.data()));
    s.stream.avail_in = size;
    s.drain(Z_NO_FLUSH);
    bytes = bytes.subspan(size);
  }
}

void GzipWriter::finish() { state_->drain(Z_FINISH); }

}  // namespace deliso

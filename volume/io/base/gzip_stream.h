// Streams through zlib (gzip, RFC 1952).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "volume/io/base/byte_stream.h"

namespace deliso {

// Decompresses the rest of a stream: gzip (any number of members one after another) or zlib.
class GzipReader : public ByteStream {
 public:
  explicit GzipReader(ByteStream& file);
  ~GzipReader() override;

  // Fills `out`; returns the number of bytes, fewer only at the end of the compressed data. Throws InputError when the
  // data are corrupt, end early, or are followed by anything but another member.
  std::size_t read(std::span<std::byte> out) override;
  // Deflate expands at most 1032 to 1.
  [[nodiscard]] std::uint64_t bound() const override;
  [[nodiscard]] std::string name() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Compresses bytes and hands the result on, piece by piece.
class GzipWriter {
 public:
  using Sink = std::function<void(std::span<const std::byte>)>;
  explicit GzipWriter(Sink sink);
  ~GzipWriter();
  GzipWriter(const GzipWriter&) = delete;
  GzipWriter& operator=(const GzipWriter&) = delete;

  void write(std::span<const std::byte> bytes);
  // Ends the stream. Call it once, after the last write.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace deliso

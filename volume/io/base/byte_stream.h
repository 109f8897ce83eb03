// Bytes that come one after another: from a file, from what a file holds compressed, or from memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"

namespace deliso {

class ByteStream {
 public:
  ByteStream() = default;
  virtual ~ByteStream() = default;
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  // Fills `out`; returns the number of bytes, fewer only at the end. Throws InputError when reading fails.
  virtual std::size_t read(std::span<std::byte> out) = 0;
  // The most bytes that can still come: nothing larger is worth an allocation.
  [[nodiscard]] virtual std::uint64_t bound() const = 0;
  // The name of the file, for errors.
  [[nodiscard]] virtual std::string name() const = 0;
  // Throws InputError: "<name>: <sentence>".
  [[noreturn]] void fail(const std::string& sentence) const { throw InputError(name() + ": " + sentence); }

  // The next line without its line end (\n or \r\n), or nothing at the end. Throws InputError when a line is longer
  // than 1 MiB: the file is then no text.
  virtual std::optional<std::string> read_line();
  // Goes `count` bytes on. Throws InputError when the data end before: "... should be skipped before <what>".
  virtual void skip(std::uint64_t count, const std::string& what);
  // The next `count` bytes; `what` names them in the error when the data end before. Allocates no more than come.
  std::vector<std::byte> take(std::uint64_t count, const std::string& what);
  // All bytes that are left.
  std::string take_rest();
};

// Bytes in memory. `file` gives its name to errors.
class MemoryStream : public ByteStream {
 public:
  MemoryStream(const ByteStream& file, std::string bytes) : file_(file), bytes_(std::move(bytes)) {}
  std::size_t read(std::span<std::byte> out) override {
    const std::size_t count = std::min(out.size(), bytes_.size() - position_);
    if (count > 0) std::memcpy(out.data(), bytes_.data() + position_, count);
    position_ += count;
    return count;
  }
  [[nodiscard]] std::uint64_t bound() const override { return bytes_.size() - position_; }
  [[nodiscard]] std::string name() const override { return file_.name(); }

 private:
  const ByteStream& file_;
  std::string bytes_;
  std::size_t position_ = 0;
};

// The text in quotes for a message: no control characters, not too long.
std::string in_quotes(std::string_view text);

}  // namespace deliso

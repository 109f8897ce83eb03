#include "volume/io/base/byte_stream.h"

namespace deliso {

namespace {

constexpr std::size_t kStreamChunkBytes = std::size_t{1} << 20;
constexpr std::size_t kLongestLine = std::size_t{1} << 20;

}  // namespace

std::optional<std::string> ByteStream::read_line() {
  std::string line;
  for (std::byte byte{}; read(std::span(&byte, 1)) == 1;) {
    const char c = static_cast<char>(byte);
    if (c == '\n') {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      return line;
    }
    if (line.size() == kLongestLine) fail("a header line is longer than 1 MiB: this is no text");
    line += c;
  }
  if (line.empty()) return std::nullopt;
  return line;
}

void ByteStream::skip(std::uint64_t count, const std::string& what) {
  std::vector<std::byte> sink(static_cast<std::size_t>(std::min<std::uint64_t>(count, kStreamChunkBytes)));
  for (std::uint64_t done = 0; done < count;) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count - done, sink.size()));
    const std::size_t found = read(std::span(sink).first(wanted));
    done += found;
    if (found < wanted) {
      fail("the data end after " + std::to_string(done) + " bytes, but " + std::to_string(count) +
           " bytes should be skipped before " + what);
    }
  }
}

std::vector<std::byte> ByteStream::take(std::uint64_t count, const std::string& what) {
  std::vector<std::byte> out;
  while (out.size() < count) {
    const std::size_t before = out.size();
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count - before, kStreamChunkBytes));
    out.resize(before + wanted);
    const std::size_t found = read(std::span(out).subspan(before));
    if (found < wanted) {
      fail("the data end after " + std::to_string(before + found) + " of the " + std::to_string(count) + " bytes of " +
           what);
    }
  }
  return out;
}

std::string ByteStream::take_rest() {
  std::string out;
  while (true) {
    const std::size_t before = out.size();
    // One more than there may be, which tells the end. A small file does not take the memory of a large one.
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(kStreamChunkBytes - 1, bound())) + 1;
    out.resize(before + wanted);
    const std::size_t found = read(std::as_writable_bytes(std::span(out).subspan(before)));
    out.resize(before + found);
    if (found < wanted) return out;
  }
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongestQuote = 60;
  std::string out = "\"";
  for (const char c : text.substr(0, kLongestQuote)) out += (c >= ' ' && c <= '~') ? c : '?';
  return out + (text.size() > kLongestQuote ? "...\"" : "\"");
}

}  // namespace deliso

#include "volume/io/base/input_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "delaunay/base/check.h"

namespace deliso {

namespace {

constexpr std::size_t kLongestFileLine = std::size_t{1} << 20;

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
    if (line.size() == kLongestFileLine) fail("a header line is longer than 1 MiB: this is no text");
    line += static_cast<char>(c);
  }
  stream_.clear();
  if (line.empty()) return std::nullopt;
  return line;
}

void InputFile::skip(std::uint64_t count, const std::string& what) {
  if (count > remaining()) ByteStream::skip(count, what);  // says where the data end
  seek(position_ + count);
}

void InputFile::seek(std::uint64_t position) {
  DELISO_CHECK(position <= size_, "places are inside the file");
  position_ = position;
  stream_.seekg(static_cast<std::streamoff>(position));
}

UnpackedFile::UnpackedFile(std::filesystem::path path, bool stands_alone)
    : file_(std::move(path)), stands_alone_(stands_alone) {
  rewind();
}

void UnpackedFile::require_folder() {
  if (!stands_alone_) return;
  file_.fail(
      "the header has its samples in another file, which is looked for beside the header's: give the name of the "
      "header's file");
}

void UnpackedFile::rewind() {
  // Two bytes of magic and the only method that gzip knows.
  constexpr std::array<std::byte, 3> kGzipStart{std::byte{0x1f}, std::byte{0x8b}, std::byte{8}};
  gzip_.reset();
  file_.seek(0);
  std::array<std::byte, 3> start{};
  const bool is_gzip = file_.read(start) == start.size() && start == kGzipStart;
  file_.seek(0);
  if (is_gzip) gzip_.emplace(file_);
}

std::string lower_case_extension(const std::filesystem::path& path) {
  const auto lower = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return text;
  };
  const std::string extension = lower(path.extension().string());
  return extension == ".gz" ? lower(path.stem().extension().string()) : extension;
}

}  // namespace deliso

#include "volume/io/nrrd/nrrd_data.h"

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "volume/io/base/text_samples.h"

namespace deliso {

namespace {

// How many bytes come until the end.
std::uint64_t length_of(ByteStream& stream) {
  std::vector<std::byte> sink(std::size_t{1} << 18);
  std::uint64_t length = 0;
  for (std::size_t found = sink.size(); found == sink.size();) {
    found = stream.read(sink);
    length += found;
  }
  return length;
}

// Goes to the last `count` bytes.
std::unique_ptr<ByteStream> last_bytes(InputFile& file, NrrdData encoding, std::uint64_t count) {
  if (encoding == NrrdData::kRaw) {
    if (count <= file.remaining()) file.seek(file.size() - count);
    return nullptr;
  }
  // What lies before the data is known only once all is decompressed.
  const std::uint64_t start = file.position();
  GzipReader whole(file);
  const std::uint64_t length = length_of(whole);
  file.seek(start);
  auto gzip = std::make_unique<GzipReader>(file);
  if (length > count) gzip->skip(length - count, "the last samples");
  return gzip;
}

std::string bytes_of_hex(ByteStream& stream, std::uint64_t count) {
  std::string out;
  int high = -1;
  for (const char c : stream.take_rest()) {
    if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
    const int digit = c >= '0' && c <= '9'   ? c - '0'
                      : c >= 'a' && c <= 'f' ? c - 'a' + 10
                      : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                             : -1;
    if (digit < 0) stream.fail("the data have the character " + in_quotes({&c, 1}) + ", expected hexadecimal digits");
    if (high < 0) {
      high = digit;
      continue;
    }
    out += static_cast<char>(16 * high + digit);
    high = -1;
  }
  if (high >= 0)
    stream.fail("the data have " + std::to_string(2 * out.size() + 1) +
                " hexadecimal digits, an odd number, but a byte " + "has two: expected " + std::to_string(2 * count) +
                " digits");
  if (out.size() != count)
    stream.fail("the data have " + std::to_string(out.size()) + " bytes in hexadecimal, but the dimensions and the " +
                "type need " + std::to_string(count));
  return out;
}

}  // namespace

std::uint64_t nrrd_data_bytes(const ByteStream& stream, const SampleLayout& layout) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max() / 2;
  const std::uint64_t volume = std::uint64_t{sample_count_of(stream, layout.dims)} * stored_size(layout.type);
  if (layout.components * layout.volumes > kMost / volume)
    stream.fail("the dimensions and the type need more bytes than memory can address");
  return volume * layout.components * layout.volumes;
}

std::unique_ptr<ByteStream> nrrd_data(ByteStream& bytes, InputFile* file, const NrrdHeader& header,
                                      std::uint64_t count) {
  for (std::uint64_t n = 0; n < header.skipped_lines; ++n) {
    if (bytes.read_line()) continue;
    bytes.fail("the data end after " + std::to_string(n) + " lines, but \"line skip\" is " +
               std::to_string(header.skipped_lines));
  }
  if (header.skip_from_end) {
    if (file == nullptr) bytes.fail("\"byte skip\" is -1 in a file that is packed as a whole: unpack it");
    return last_bytes(*file, header.encoding, count);
  }
  std::unique_ptr<ByteStream> decoded;
  if (header.encoding == NrrdData::kGzip) decoded = std::make_unique<GzipReader>(bytes);
  ByteStream& plain = decoded ? *decoded : bytes;
  plain.skip(header.skipped_bytes, "the first sample");
  const StoredType type = header.volume.layout.type;
  if (header.encoding == NrrdData::kText)
    return std::make_unique<MemoryStream>(bytes, bytes_of_numbers(bytes, type, count / stored_size(type)));
  if (header.encoding == NrrdData::kHex) return std::make_unique<MemoryStream>(bytes, bytes_of_hex(bytes, count));
  return decoded;
}

NrrdFileRow::NrrdFileRow(const NrrdHeader& header, const ByteStream& owner) : header_(header), owner_(owner) {
  const std::uint64_t all = nrrd_data_bytes(owner, header.volume.layout);
  const std::uint64_t files = header.data_files.size();
  if (all % files != 0 || all / files % stored_size(header.volume.layout.type) != 0)
    owner.fail("the samples cannot be shared by the " + std::to_string(files) + " files of \"data file\"");
  share_ = all / files;
  // All files must be there, and large enough, before anything is allocated.
  constexpr std::uint64_t kDeflateLimit = 1032, kLargest = std::uint64_t{1} << 50;
  for (const std::filesystem::path& path : header.data_files) {
    try {
      const InputFile file(path);
      const std::uint64_t size = std::min(file.size() + 1, kLargest);
      bound_ += std::min(share_, header.encoding == NrrdData::kGzip ? size * kDeflateLimit : size);
    } catch (const InputError& error) {
      owner.fail(std::string("the data file ") + error.what());
    }
  }
}

void NrrdFileRow::open_next() {
  decoded_.reset();
  file_.emplace(header_.data_files[next_]);
  decoded_ = nrrd_data(*file_, &*file_, header_, share_);
  left_ = share_;
  ++next_;
}

std::size_t NrrdFileRow::read(std::span<std::byte> out) {
  std::size_t done = 0;
  while (done < out.size()) {
    if (left_ == 0) {
      std::byte extra{};
      if (file_ && (decoded_ ? *decoded_ : static_cast<ByteStream&>(*file_)).read(std::span(&extra, 1)) != 0)
        file_->fail("the data go on after the " + std::to_string(share_) + " bytes that are its share");
      if (next_ == header_.data_files.size()) break;
      open_next();
    }
    ByteStream& bytes = decoded_ ? *decoded_ : *file_;
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(left_, out.size() - done));
    const std::size_t found = bytes.read(out.subspan(done, wanted));
    if (found < wanted)
      file_->fail("the data end after " + std::to_string(share_ - left_ + found) + " bytes, but the file's share is " +
                  std::to_string(share_));
    done += found;
    left_ -= found;
  }
  bound_ -= std::min<std::uint64_t>(bound_, done);
  return done;
}

}  // namespace deliso

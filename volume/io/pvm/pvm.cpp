#include "volume/io/pvm/pvm.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "volume/io/base/header_bytes.h"
#include "volume/io/base/text_samples.h"
#include "volume/io/pvm/dds.h"

namespace deliso {

namespace {

// The numbers of the next line of the header; lines that begin with # are comments.
std::vector<double> read_numbers(ByteStream& file, std::size_t count, const char* what) {
  std::string line = file.read_line().value_or("");
  while (line.starts_with('#')) line = file.read_line().value_or("");
  std::vector<double> numbers;
  std::string word;
  for (const char c : line + ' ') {
    if (c != ' ' && c != '\t') {
      word += c;
      continue;
    }
    double number = 0;
    if (word.empty()) continue;
    if (!parse_word(word, number)) break;
    numbers.push_back(number);
    word.clear();
  }
  if (numbers.size() != count || !word.empty())
    file.fail("the header has the line " + in_quotes(line) + ", expected " + what);
  return numbers;
}

std::int64_t whole(const ByteStream& file, double number) {
  constexpr double kLargest = 0x1p40;
  if (!(number >= 1 && number <= kLargest) || number != static_cast<double>(static_cast<std::int64_t>(number)))
    file.fail("the header's dimensions and components must be whole numbers from 1 on");
  return static_cast<std::int64_t>(number);
}

Volume read_plain_pvm(ByteStream& file, const std::string& magic, const ChannelChoice& choice,
                      const InputFile* mappable) {
  VolumeDescription volume;
  volume.format = magic;
  SampleLayout& layout = volume.layout;
  const std::vector<double> dims = read_numbers(file, 3, "three dimensions");
  for (std::size_t n = 0; n < 3; ++n)
    layout.dims.at(n) = dimension_of(file, along_axis("the dimension", n), whole(file, dims[n]));
  if (magic != "PVM") {
    const std::vector<double> spacing = read_numbers(file, 3, "the spacing along x, y and z");
    for (const double s : spacing) {
      if (!(s > 0)) file.fail("the header's spacing must be positive along each axis");
    }
    volume.index_to_world = affine_of({spacing[0], spacing[1], spacing[2]}, {});
  }
  const auto components = static_cast<std::uint64_t>(whole(file, read_numbers(file, 1, "the bytes of a voxel")[0]));
  layout.endian = Endian::kBig;
  layout.type = components == 2 ? StoredType::kU16 : StoredType::kU8;
  if (components > 2) layout.components = components;
  layout.may_go_on = magic == "PVM3";  // descriptions follow
  return read_described(file, volume, choice, mappable);
}

std::optional<std::string> pvm_magic(const std::string& line) {
  if (line == "PVM" || line == "PVM2" || line == "PVM3") return line;
  return std::nullopt;
}

}  // namespace

Volume read_pvm(UnpackedFile& file, const ChannelChoice& choice) {
  ByteStream& bytes = file.bytes();
  const std::string first = bytes.read_line().value_or("");
  if (const auto magic = pvm_magic(first)) return read_plain_pvm(bytes, *magic, choice, file.mappable());
  const bool is_blocked = first + '\n' == kDdsBlockMagic;
  if (!is_blocked && first + '\n' != kDdsMagic)
    bytes.fail("the file starts with " + in_quotes(first) + ", expected PVM, PVM2, PVM3 or DDS v3d");
  MemoryStream unpacked(bytes, unpack_dds(bytes, bytes.take_rest(), is_blocked));
  const std::string inner = unpacked.read_line().value_or("");
  const auto magic = pvm_magic(inner);
  if (!magic) bytes.fail("the packed data start with " + in_quotes(inner) + ", expected PVM, PVM2 or PVM3");
  return read_plain_pvm(unpacked, *magic, choice, nullptr);
}

}  // namespace deliso

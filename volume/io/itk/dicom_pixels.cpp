#ifdef DELISO_HAS_ITK

#include "volume/io/itk/dicom_pixels.h"

#include <gdcmReader.h>
#include <gdcmTag.h>
#include <gdcmTransferSyntax.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>

namespace deliso {

namespace {

constexpr std::uint32_t kUndefinedLength = 0xFFFFFFFF;
constexpr std::size_t kItemHeader = 8;  // tag and length

// Numbers of a file in its byte order.
class DicomNumbers {
 public:
  DicomNumbers(std::ifstream& file, bool is_big_endian) : file_(file), is_big_endian_(is_big_endian) {}

  // The number in the next `count` bytes; the file is not good any more where they are missing.
  std::uint32_t next(std::size_t count) {
    std::array<char, 4> bytes{};
    file_.read(bytes.data(), static_cast<std::streamsize>(count));
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto byte = static_cast<unsigned char>(bytes.at(is_big_endian_ ? i : count - 1 - i));
      number = number << 8u | byte;
    }
    return number;
  }

 private:
  std::ifstream& file_;
  bool is_big_endian_;
};

// Whether there is an item for each piece of compressed pixels, up to the one that says that it is the last.
bool has_all_items(std::ifstream& file, DicomNumbers& numbers, std::uint64_t file_size) {
  constexpr std::uint32_t kItemGroup = 0xFFFE, kLastItem = 0xE0DD;
  for (auto place = static_cast<std::uint64_t>(file.tellg()); place + kItemHeader <= file_size;) {
    file.seekg(static_cast<std::streamoff>(place));
    const std::uint32_t group = numbers.next(2), element = numbers.next(2), length = numbers.next(4);
    if (group != kItemGroup) return false;
    if (element == kLastItem) return true;
    place += kItemHeader + length;
  }
  return false;
}

}  // namespace

bool holds_all_pixels(const std::filesystem::path& path) {
  const gdcm::Tag pixel_data(0x7fe0, 0x0010);
  gdcm::Reader reader;
  reader.SetFileName(path.c_str());
  // The tag is skipped, so the reader stops behind its header, which ends with the length.
  if (!reader.ReadUpToTag(pixel_data, {pixel_data})) return false;
  const gdcm::TransferSyntax& syntax = reader.GetFile().GetHeader().GetDataSetTransferSyntax();
  if (syntax == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian) return true;
  const std::uint64_t begin = reader.GetStreamCurrentPosition(), size = std::filesystem::file_size(path);
  constexpr std::uint64_t kLengthBytes = 4;
  if (begin < kLengthBytes || begin > size) return false;
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(begin - kLengthBytes));
  DicomNumbers numbers(file, syntax.GetSwapCode() == gdcm::SwapCode::BigEndian);
  const std::uint32_t length = numbers.next(kLengthBytes);
  return length == kUndefinedLength ? has_all_items(file, numbers, size) : begin + length <= size;
}

}  // namespace deliso

#endif

#include "volume/io/vtk/vti.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "volume/io/base/header_bytes.h"
#include "volume/io/base/text_samples.h"
#include "volume/io/vtk/array_choice.h"
#include "volume/io/vtk/vti_data.h"
#include "volume/io/vtk/vtk_types.h"
#include "volume/io/vtk/xml_tags.h"

namespace deliso {

namespace {

// What the tags of a file say.
struct VtiFile {
  VtiEncoding encoding;
  XmlTag image, piece;
  std::vector<XmlTag> arrays;  // of the point data
  std::string appended;        // its encoding
  std::size_t data = 0;        // the place behind the underscore that begins appended data; 0 when there are none
};

template <std::size_t kCount>
std::array<double, kCount> numbers_of(const ByteStream& file, const XmlTag& tag, const std::string& key,
                                      const std::string& fallback) {
  std::array<double, kCount> out{};
  std::size_t count = 0;
  std::string word;
  const std::string value = tag.value(key, fallback);
  bool is_good = true;
  for (const char c : value + ' ') {
    if (c != ' ' && c != '\n' && c != '\t' && c != '\r') {
      word += c;
      continue;
    }
    if (word.empty()) continue;
    double number = 0;
    is_good = is_good && count < kCount && parse_word(word, number) && std::isfinite(number);
    if (is_good) out.at(count++) = number;
    word.clear();
  }
  if (!is_good || count != kCount)
    file.fail("the attribute " + key + " is " + in_quotes(value) + ", expected " + std::to_string(kCount) +
              " finite numbers");
  return out;
}

void take_encoding(const ByteStream& file, const XmlTag& tag, VtiEncoding& encoding) {
  if (tag.value("type") != "ImageData")
    file.fail("the file's type is " + in_quotes(tag.value("type")) +
              ", expected ImageData: other grids are no volumes");
  const std::string order = tag.value("byte_order", "LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian")
    file.fail("byte_order is " + in_quotes(order) + ", expected LittleEndian or BigEndian");
  encoding.endian = order == "BigEndian" ? Endian::kBig : Endian::kLittle;
  const std::string header = tag.value("header_type", "UInt32");
  if (header != "UInt32" && header != "UInt64")
    file.fail("header_type is " + in_quotes(header) + ", expected UInt32 or UInt64");
  encoding.has_wide_headers = header == "UInt64";
  const std::string compressor = tag.value("compressor");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    file.fail("compressor is " + in_quotes(compressor) + ", expected vtkZLibDataCompressor, or none");
  encoding.is_packed = !compressor.empty();
}

VtiFile read_tags(const ByteStream& file, std::string_view text) {
  VtiFile vti;
  bool is_of_points = false;
  std::size_t position = 0;
  while (const std::optional<XmlTag> tag = next_xml_tag(file, text, position)) {
    position = tag->end;
    if (tag->name == "VTKFile") take_encoding(file, *tag, vti.encoding);
    if (tag->name == "ImageData") vti.image = *tag;
    if (tag->name == "Piece") {
      if (!vti.piece.name.empty()) file.fail("the file has several pieces, expected one: save it as one piece");
      vti.piece = *tag;
    }
    if (tag->name == "PointData") is_of_points = !tag->is_closed;
    if (tag->name == "/PointData") is_of_points = false;
    if (tag->name == "DataArray" && is_of_points) vti.arrays.push_back(*tag);
    if (tag->name != "AppendedData") continue;
    vti.appended = tag->value("encoding", "base64");
    const std::size_t underscore = text.find('_', tag->end);
    if (underscore == std::string_view::npos) file.fail("the appended data do not begin with an underscore");
    vti.data = underscore + 1;
    break;
  }
  if (vti.image.name.empty()) file.fail("the file has no element ImageData, expected a VTK file of image data");
  if (vti.piece.name.empty()) file.fail("the file has no element Piece");
  return vti;
}

void take_extent(const ByteStream& file, const VtiFile& vti, VolumeDescription& volume) {
  const auto whole = numbers_of<6>(file, vti.image, "WholeExtent", "");
  const auto extent = numbers_of<6>(file, vti.piece, "Extent", vti.image.value("WholeExtent"));
  if (whole != extent)
    file.fail("the piece has the extent " + in_quotes(vti.piece.value("Extent")) + ", expected the whole one, " +
              in_quotes(vti.image.value("WholeExtent")));
  const auto spacing = numbers_of<3>(file, vti.image, "Spacing", "1 1 1");
  const auto origin = numbers_of<3>(file, vti.image, "Origin", "0 0 0");
  const auto rows = numbers_of<9>(file, vti.image, "Direction", "1 0 0 0 1 0 0 0 1");
  Affine& map = volume.index_to_world;
  map.offset = {origin[0], origin[1], origin[2]};
  for (std::size_t n = 0; n < 3; ++n) {
    const double size = extent.at(2 * n + 1) - extent.at(2 * n) + 1;
    constexpr double kLargest = 0x1p40;
    if (!(std::abs(size) < kLargest)) file.fail("WholeExtent has a side of more than 2^40 samples");
    volume.layout.dims.at(n) =
        dimension_of(file, along_axis("the size of WholeExtent", n), static_cast<std::int64_t>(size));
    map.columns.at(n) = spacing.at(n) * Vec3{rows.at(n), rows.at(3 + n), rows.at(6 + n)};
    map.offset += extent.at(2 * n) * map.columns.at(n);
  }
}

// The bytes of an array's samples, in the byte order of the file (text: of this machine).
std::string array_bytes(ByteStream& file, std::string_view text, const VtiFile& vti, const XmlTag& array,
                        VolumeDescription& volume, std::uint64_t values) {
  const std::uint64_t count = values * stored_size(volume.layout.type);
  const std::string format = array.value("format", "ascii");
  if (format == "appended") {
    std::int64_t offset = 0;
    if (!parse_word(array.value("offset"), offset) || offset < 0 || vti.data == 0 ||
        static_cast<std::uint64_t>(offset) > text.size() - vti.data)
      file.fail("the array's offset is " + in_quotes(array.value("offset")) +
                ", expected a place in the appended data");
    const std::string_view data = text.substr(vti.data + static_cast<std::size_t>(offset));
    if (vti.appended == "raw") return vti_data(file, data, vti.encoding, count);
    if (vti.appended == "base64") return vti_data_of_base64(file, data.substr(0, data.find('<')), vti.encoding, count);
    file.fail("the appended data have the encoding " + in_quotes(vti.appended) + ", expected raw or base64");
  }
  const std::string_view content = text.substr(array.end, text.find('<', array.end) - array.end);
  if (format == "binary") return vti_data_of_base64(file, content, vti.encoding, count);
  if (format != "ascii")
    file.fail("the array has the format " + in_quotes(format) + ", expected ascii, binary or appended");
  volume.layout.endian = kHostEndian;
  MemoryStream numbers(file, std::string(content));
  return bytes_of_numbers(numbers, volume.layout.type, values);
}

}  // namespace

Volume read_vti(UnpackedFile& file, const ChannelChoice& choice, const std::string& array) {
  ByteStream& stream = file.bytes();
  const std::string text = stream.take_rest();
  const VtiFile vti = read_tags(stream, text);
  VolumeDescription volume;
  volume.format = "VTI";
  volume.layout.endian = vti.encoding.endian;
  take_extent(stream, vti, volume);
  std::vector<std::string> names;
  for (const XmlTag& each : vti.arrays) names.push_back(each.value("Name"));
  const XmlTag& chosen = vti.arrays[choose_array(stream, names, array)];
  const std::optional<StoredType> type = xml_vtk_type(chosen.value("type"));
  if (!type) stream.fail("the array's type is " + in_quotes(chosen.value("type")) + ", expected UInt8, Float32, ...");
  volume.layout.type = *type;
  std::int64_t components = 1;
  if (!parse_word(chosen.value("NumberOfComponents", "1"), components) || components < 1 || components > 1 << 20)
    stream.fail("NumberOfComponents is " + in_quotes(chosen.value("NumberOfComponents")) + ", expected 1 or more");
  volume.layout.components = static_cast<std::uint64_t>(components);
  choose_channel(stream, choice, volume.layout);
  const std::uint64_t samples = sample_count_of(stream, volume.layout.dims);
  constexpr std::uint64_t kMost = std::uint64_t{1} << 40;
  if (samples > kMost) stream.fail("the extent has more than 2^40 samples");
  MemoryStream data(stream, array_bytes(stream, text, vti, chosen, volume, samples * volume.layout.components));
  return read_described(data, volume, choice);
}

}  // namespace deliso

// Reads PolyData of VTK's XML format: all pieces; arrays as text, as base64 or appended, packed by zlib or not.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "delaunay/base/check.h"
#include "surface/mesh/io/bytes.h"
#include "surface/mesh/io/formats.h"
#include "surface/mesh/io/polygon_lists.h"
#include "surface/mesh/io/text.h"
#include "surface/mesh/io/vtk_numbers.h"
#include "volume/io/base/byte_stream.h"
#include "volume/io/vtk/vti_data.h"
#include "volume/io/vtk/vtk_types.h"
#include "volume/io/vtk/xml_tags.h"

namespace deliso {

namespace {

// What the readers of volumes want of a file: its name, for errors.
class NamedStream : public ByteStream {
 public:
  explicit NamedStream(std::string name) : name_(std::move(name)) {}
  std::size_t read(std::span<std::byte>) override { return 0; }
  [[nodiscard]] std::uint64_t bound() const override { return 0; }
  [[nodiscard]] std::string name() const override { return name_; }

 private:
  std::string name_;
};

constexpr std::array<std::string_view, 5> kSections{"Points", "Polys", "Strips", "CellData", "FieldData"};

struct VtpPiece {
  XmlTag tag;
  std::optional<XmlTag> points, connectivity, offsets, strip_connectivity, strip_offsets, labels;
};

class VtpParser {
 public:
  VtpParser(std::string_view text, const std::string& file, MeshComments* comments)
      : text_(text), file_(file), comments_(comments) {}

  TriangleMesh parse() {
    read_tags();
    for (const VtpPiece& piece : pieces_) read_piece(piece);
    if (!mesh_.labels.empty()) mesh_.labels.resize(mesh_.triangles.size(), 0);  // a last piece without
    return std::move(mesh_);
  }

 private:
  void read_tags() {
    std::string section;
    std::size_t position = 0;
    bool is_poly_data = false;
    while (const std::optional<XmlTag> tag = next_xml_tag(file_, text_, position)) {
      position = tag->end;
      if (tag->name == "VTKFile") {
        take_encoding(*tag);
        is_poly_data = true;
      } else if (tag->name == "Piece") {
        pieces_.push_back({*tag, {}, {}, {}, {}, {}, {}});
      } else if (std::find(kSections.begin(), kSections.end(), tag->name) != kSections.end()) {
        section = tag->is_closed ? "" : tag->name;
      } else if (tag->name.starts_with('/') && tag->name.substr(1) == section) {
        section.clear();
      } else if (tag->name == "DataArray" || tag->name == "Array") {
        take_array(section, *tag);
      } else if (tag->name == "AppendedData") {
        appended_ = tag->value("encoding", "base64");
        const std::size_t underscore = text_.find('_', tag->end);
        if (underscore == std::string_view::npos) file_.fail("the appended data do not begin with an underscore");
        data_ = underscore + 1;
        break;
      }
    }
    if (!is_poly_data) file_.fail("the file has no element VTKFile, expected a VTK file of PolyData");
  }

  void take_encoding(const XmlTag& tag) {
    if (tag.value("type") != "PolyData")
      file_.fail("the file's type is " + in_quotes(tag.value("type")) +
                 ", expected PolyData: other data sets are no triangle meshes");
    const std::string order = tag.value("byte_order", "LittleEndian"), header = tag.value("header_type", "UInt32");
    const std::string compressor = tag.value("compressor");
    if (order != "LittleEndian" && order != "BigEndian")
      file_.fail("byte_order is " + in_quotes(order) + ", expected LittleEndian or BigEndian");
    if (header != "UInt32" && header != "UInt64")
      file_.fail("header_type is " + in_quotes(header) + ", expected UInt32 or UInt64");
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
      file_.fail("compressor is " + in_quotes(compressor) + ", expected vtkZLibDataCompressor, or none");
    encoding_ = {order == "BigEndian" ? Endian::kBig : Endian::kLittle, header == "UInt64", !compressor.empty()};
  }

  void take_array(const std::string& section, const XmlTag& tag) {
    const std::string name = tag.value("Name");
    if (section == "FieldData" && name == "comments" && tag.value("type") == "String") return take_comments(tag);
    if (pieces_.empty()) return;
    VtpPiece& piece = pieces_.back();
    if (section == "Points") piece.points = tag;
    if (section == "Polys" && name == "connectivity") piece.connectivity = tag;
    if (section == "Polys" && name == "offsets") piece.offsets = tag;
    if (section == "Strips" && name == "connectivity") piece.strip_connectivity = tag;
    if (section == "Strips" && name == "offsets") piece.strip_offsets = tag;
    if (section == "CellData" && name == kLabelArray && tag.value("NumberOfComponents", "1") == "1") piece.labels = tag;
  }

  // Only texts as text: comments are no reason to refuse a file.
  void take_comments(const XmlTag& tag) {
    if (comments_ == nullptr || tag.value("format") != "ascii" || tag.is_closed) return;
    TextScanner in(content_of(tag), file_.name());
    std::string text;
    for (std::string_view word = in.word(); !word.empty(); word = in.word()) {
      std::int64_t letter = 0;
      if (!parse_integer(word, letter) || letter < 0 || letter > 255) return;
      if (letter != 0) {
        text += static_cast<char>(static_cast<unsigned char>(letter));
      } else {
        comments_->push_back(std::exchange(text, {}));
      }
    }
  }

  [[nodiscard]] std::string_view content_of(const XmlTag& tag) const {
    return text_.substr(tag.end, text_.find('<', tag.end) - tag.end);
  }

  std::uint64_t count_of(const XmlTag& tag, const std::string& key) const {
    constexpr std::int64_t kMost = std::int64_t{1} << 40;
    std::int64_t count = 0;
    const std::string value = tag.value(key, "0");
    if (!parse_integer(value, count) || count < 0 || count > kMost)
      file_.fail(key + " is " + in_quotes(value) + ", expected a whole number from 0 to 2^40");
    return static_cast<std::uint64_t>(count);
  }

  // The numbers of an array.
  std::vector<double> numbers_of(const XmlTag& tag, std::uint64_t count) const {
    std::vector<double> numbers;
    const std::string format = tag.value("format", "ascii");
    if (format == "ascii") {
      TextScanner in(tag.is_closed ? std::string_view() : content_of(tag), file_.name());
      numbers.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(count, in.remaining() / 2 + 1)));
      for (std::uint64_t i = 0; i < count; ++i) {
        const std::string_view word = in.word();
        double value = 0;
        if (!parse_number(word, value)) file_.fail("the array has " + in_quotes(word) + ", expected a number");
        numbers.push_back(value);
      }
      return numbers;
    }
    const std::optional<StoredType> type = xml_vtk_type(tag.value("type"));
    if (!type) file_.fail("the array's type is " + in_quotes(tag.value("type")) + ", expected Float32, Int64, ...");
    const std::string bytes = array_bytes(tag, format, count * stored_size(*type));
    ByteReader in(bytes, file_.name(), encoding_.endian == Endian::kBig ? std::endian::big : std::endian::little);
    numbers.reserve(static_cast<std::size_t>(count));
    for (std::uint64_t i = 0; i < count; ++i) numbers.push_back(number_of_type(in, *type));
    return numbers;
  }

  std::string array_bytes(const XmlTag& tag, const std::string& format, std::uint64_t count) const {
    if (format == "binary") return vti_data_of_base64(file_, tag.is_closed ? "" : content_of(tag), encoding_, count);
    if (format != "appended")
      file_.fail("the array has the format " + in_quotes(format) + ", expected ascii, binary or appended");
    const std::uint64_t offset = count_of(tag, "offset");
    if (data_ == 0 || offset > text_.size() - data_)
      file_.fail("the array's offset is " + in_quotes(tag.value("offset")) + ", expected a place in the appended data");
    const std::string_view data = text_.substr(data_ + static_cast<std::size_t>(offset));
    if (appended_ == "raw") return vti_data(file_, data, encoding_, count);
    if (appended_ == "base64") return vti_data_of_base64(file_, data.substr(0, data.find('<')), encoding_, count);
    file_.fail("the appended data have the encoding " + in_quotes(appended_) + ", expected raw or base64");
  }

  void read_piece(const VtpPiece& piece) {
    const std::uint64_t points = count_of(piece.tag, "NumberOfPoints");
    const std::size_t before = mesh_.points.size();
    if (points + before >= std::numeric_limits<std::uint32_t>::max()) file_.fail("expected fewer than 2^32 - 1 points");
    if (points > 0 && !piece.points) file_.fail("a piece has no element Points with an array");
    if (points > 0) {
      if (count_of(*piece.points, "NumberOfComponents") != 3)
        file_.fail("NumberOfComponents of the points is " + in_quotes(piece.points->value("NumberOfComponents")) +
                   ", expected 3");
      const std::vector<double> numbers = numbers_of(*piece.points, 3 * points);
      for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
        mesh_.points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
        if (!is_finite(mesh_.points.back())) file_.fail("a point has a coordinate that is no finite number");
      }
    }
    const std::uint64_t polygons = count_of(piece.tag, "NumberOfPolys"), strips = count_of(piece.tag, "NumberOfStrips");
    CellNumbers cells;
    cells.before =
        static_cast<std::size_t>(count_of(piece.tag, "NumberOfVerts") + count_of(piece.tag, "NumberOfLines"));
    read_cells(polygons, piece.connectivity, piece.offsets, false, before, cells);
    read_cells(strips, piece.strip_connectivity, piece.strip_offsets, true, before, cells);
    if (piece.labels) append_labels(cells, numbers_of(*piece.labels, cells.before + polygons + strips), mesh_);
  }

  std::vector<std::int64_t> whole_numbers_of(const XmlTag& tag, std::uint64_t count) const {
    std::vector<std::int64_t> whole;
    for (const double value : numbers_of(tag, count)) {
      if (!(value >= 0 && value <= 0x1p40 && value == std::floor(value)))
        file_.fail("an array of corners has " + std::to_string(value) + ", expected a whole number from 0 to 2^40");
      whole.push_back(static_cast<std::int64_t>(value));
    }
    return whole;
  }

  void read_cells(std::uint64_t cells, const std::optional<XmlTag>& connectivity, const std::optional<XmlTag>& offsets,
                  bool are_strips, std::size_t base, CellNumbers& cell_numbers) {
    if (cells == 0) return;
    if (!connectivity || !offsets) file_.fail("a piece has polygons but no arrays 'connectivity' and 'offsets'");
    const std::vector<std::int64_t> ends = whole_numbers_of(*offsets, cells);
    const std::vector<std::int64_t> corners = whole_numbers_of(*connectivity, static_cast<std::uint64_t>(ends.back()));
    append_polygons(
        corners, ends, are_strips, static_cast<std::int64_t>(base),
        static_cast<std::int64_t>(mesh_.points.size() - base),
        [this](const std::string& expected, std::int64_t found) {
          file_.fail("expected " + expected + ", found " + std::to_string(found));
        },
        mesh_, cell_numbers);
  }

  std::string_view text_;
  NamedStream file_;
  MeshComments* comments_;
  VtiEncoding encoding_;
  std::vector<VtpPiece> pieces_;
  std::string appended_;  // the encoding of appended data
  std::size_t data_ = 0;  // the place behind the underscore that begins them; 0 when there are none
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh parse_vtp(std::string_view bytes, const std::string& file, MeshComments* comments) {
  return VtpParser(bytes, file, comments).parse();
}

}  // namespace deliso

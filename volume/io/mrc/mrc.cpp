#include "volume/io/mrc/mrc.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "delaunay/base/shortest_text.h"
#include "volume/io/base/header_bytes.h"

namespace deliso {

namespace {

constexpr std::size_t kMrcHeader = 1024;

using Three = std::array<std::int32_t, 3>;

Three three_integers(const HeaderBytes& bytes, std::size_t place) {
  return {bytes.at<std::int32_t>(place), bytes.at<std::int32_t>(place + 4), bytes.at<std::int32_t>(place + 8)};
}
Vec3 three_floats(const HeaderBytes& bytes, std::size_t place) {
  return {static_cast<double>(bytes.at<float>(place)), static_cast<double>(bytes.at<float>(place + 4)),
          static_cast<double>(bytes.at<float>(place + 8))};
}

// MAPC, MAPR, MAPS: which axis of the cell is that of columns, rows and sections, from 1 on. All 0 in old files.
Three cell_axes(const ByteStream& file, const HeaderBytes& bytes) {
  Three axes = three_integers(bytes, 64);
  if (axes == Three{}) axes = {1, 2, 3};
  std::array<bool, 3> seen{};
  for (std::int32_t& axis : axes) {
    if (axis < 1 || axis > 3 || seen.at(static_cast<std::size_t>(axis - 1)))
      file.fail("MAPC, MAPR, MAPS are " + std::to_string(axes[0]) + ", " + std::to_string(axes[1]) + ", " +
                std::to_string(axes[2]) + ", expected 1, 2 and 3 in some order");
    seen.at(static_cast<std::size_t>(axis - 1)) = true;
  }
  for (std::int32_t& axis : axes) --axis;
  return axes;
}

// The machine stamp tells the byte order; without one, the order in which the first dimension is small.
void find_endian(HeaderBytes& bytes) {
  const auto stamp = bytes.at<std::uint8_t>(212);
  constexpr std::uint8_t kLittle = 0x44, kBig = 0x11;
  bytes.set_endian(Endian::kLittle);
  const std::int32_t mode = bytes.at<std::int32_t>(12);
  constexpr std::int32_t kMostModes = 200;
  const bool is_little = stamp == kLittle || (stamp != kBig && mode >= 0 && mode < kMostModes);
  bytes.set_endian(is_little ? Endian::kLittle : Endian::kBig);
}

StoredType read_mode(const ByteStream& file, const HeaderBytes& bytes) {
  constexpr std::int32_t kImod = 1146047817;  // IMOD's stamp; bit 0 of its flags says that bytes are signed
  const auto mode = bytes.at<std::int32_t>(12);
  switch (mode) {
    case 0:
      return bytes.at<std::int32_t>(152) == kImod && (bytes.at<std::int32_t>(156) & 1) == 0 ? StoredType::kU8
                                                                                            : StoredType::kI8;
    case 1:
      return StoredType::kI16;
    case 2:
      return StoredType::kF32;
    case 6:
      return StoredType::kU16;
    case 12:
      return StoredType::kF16;
    default:
      file.fail("MODE is " + std::to_string(mode) + ", expected 0, 1, 2, 6 or 12");
  }
}

// The edges of the cell as vectors: the first along x, the second in the plane of x and y.
std::array<Vec3, 3> cell_edges(const ByteStream& file, const Vec3& lengths, Vec3 degrees) {
  if (degrees == Vec3{}) degrees = {90, 90, 90};
  if (degrees == Vec3{90, 90, 90}) return {Vec3{lengths.x, 0, 0}, Vec3{0, lengths.y, 0}, Vec3{0, 0, lengths.z}};
  constexpr double kDegree = 0.017453292519943295;
  const double ca = std::cos(degrees.x * kDegree), cb = std::cos(degrees.y * kDegree);
  const double cg = std::cos(degrees.z * kDegree), sg = std::sin(degrees.z * kDegree);
  const double y = (ca - cb * cg) / sg, z = 1 - cb * cb - y * y;
  if (!(z > 0)) file.fail("the angles of the cell make no cell, expected 90 degrees each or another cell");
  return {Vec3{lengths.x, 0, 0}, lengths.y * Vec3{cg, sg, 0}, lengths.z * Vec3{cb, y, std::sqrt(z)}};
}

Affine read_mrc_geometry(const ByteStream& file, const HeaderBytes& bytes, const Three& axes) {
  const Three intervals = three_integers(bytes, 28), start = three_integers(bytes, 16);
  Vec3 lengths = three_floats(bytes, 40);
  // Files without a cell have a spacing of 1.
  if (lengths == Vec3{} || intervals == Three{}) {
    lengths = {1, 1, 1};
  } else {
    for (std::size_t n = 0; n < 3; ++n) {
      if (intervals.at(n) < 1) file.fail("MX, MY, MZ must be 1 or more, found " + std::to_string(intervals.at(n)));
      if (!(lengths[n] > 0))
        file.fail("CELLA: the cell is " + shortest_text(lengths[n]) + " long along " + "xyz"[n] +
                  ", expected a length above 0 (or 0 along all three axes, for a spacing of 1)");
      lengths[n] /= intervals.at(n);
    }
  }
  const std::array<Vec3, 3> edges = cell_edges(file, lengths, three_floats(bytes, 52));
  Affine map;
  Vec3 first;  // by the starts, which belong to columns, rows and sections
  for (std::size_t n = 0; n < 3; ++n) {
    map.columns.at(n) = edges.at(static_cast<std::size_t>(axes.at(n)));
    first += static_cast<double>(start.at(n)) * map.columns.at(n);
  }
  const Vec3 origin = three_floats(bytes, 196);
  map.offset = origin == Vec3{} ? first : origin;
  return map;
}

}  // namespace

Volume read_mrc(UnpackedFile& file, const ChannelChoice& choice) {
  ByteStream& stream = file.bytes();
  HeaderBytes bytes(stream.take(kMrcHeader, "the header"));
  find_endian(bytes);
  VolumeDescription volume;
  volume.format = "MRC";
  volume.units = "angstrom";
  SampleLayout& layout = volume.layout;
  layout.endian = bytes.endian();
  layout.may_go_on = true;
  layout.type = read_mode(stream, bytes);
  Three sizes = three_integers(bytes, 0);
  // A space group from 401 on says that MZ sections make a volume.
  constexpr std::int32_t kStacks = 401;
  const std::int32_t sections = bytes.at<std::int32_t>(36);
  if (bytes.at<std::int32_t>(88) >= kStacks && sections > 0 && sizes[2] > 0 && sizes[2] % sections == 0) {
    layout.volumes = static_cast<std::uint64_t>(sizes[2] / sections);
    sizes[2] = sections;
  }
  constexpr std::array<const char*, 3> kSizeNames{"NX", "NY", "NZ"};
  for (std::size_t n = 0; n < 3; ++n) layout.dims.at(n) = dimension_of(stream, kSizeNames.at(n), sizes.at(n));
  volume.index_to_world = read_mrc_geometry(stream, bytes, cell_axes(stream, bytes));
  const auto extended = bytes.at<std::int32_t>(92);
  if (extended < 0) stream.fail("NSYMBT is " + std::to_string(extended) + ", expected the bytes of an extended header");
  layout.skipped_bytes = static_cast<std::uint64_t>(extended);
  return read_described(stream, volume, choice, file.mappable());
}

}  // namespace deliso

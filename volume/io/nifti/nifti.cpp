#include "volume/io/nifti/nifti.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "volume/io/base/header_bytes.h"

namespace deliso {

namespace {

constexpr std::int32_t kSize1 = 348, kSize2 = 540;  // of the headers of both versions

// What both versions say, in one layout.
struct NiftiHeader {
  int version = 1;
  Endian endian = kHostEndian;
  std::string magic;
  std::int32_t datatype = 0;
  std::array<std::int64_t, 8> dim{};
  std::array<double, 8> pixdim{};
  double data_offset = 0;
  double slope = 0, intercept = 0;
  std::int32_t units = 0;
  std::int32_t qform = 0, sform = 0;
  Vec3 quaternion, quaternion_offset;
  std::array<std::array<double, 4>, 3> rows{};  // of sform
};

template <class Real>
Vec3 three(const HeaderBytes& bytes, std::size_t place) {
  return {static_cast<double>(bytes.at<Real>(place)), static_cast<double>(bytes.at<Real>(place + sizeof(Real))),
          static_cast<double>(bytes.at<Real>(place + 2 * sizeof(Real)))};
}

// `Size`: the type of dimensions; the places are those of the fields in the two headers.
template <class Size, class Real>
void take_fields(const HeaderBytes& bytes, std::size_t dim, std::size_t pixdim, std::size_t scale, std::size_t quatern,
                 std::size_t rows, NiftiHeader& header) {
  for (std::size_t n = 0; n < 8; ++n) {
    header.dim.at(n) = static_cast<std::int64_t>(bytes.at<Size>(dim + n * sizeof(Size)));
    header.pixdim.at(n) = static_cast<double>(bytes.at<Real>(pixdim + n * sizeof(Real)));
  }
  header.slope = static_cast<double>(bytes.at<Real>(scale));
  header.intercept = static_cast<double>(bytes.at<Real>(scale + sizeof(Real)));
  header.quaternion = three<Real>(bytes, quatern);
  header.quaternion_offset = three<Real>(bytes, quatern + 3 * sizeof(Real));
  for (std::size_t n = 0; n < 12; ++n)
    header.rows.at(n / 4).at(n % 4) = static_cast<double>(bytes.at<Real>(rows + n * sizeof(Real)));
}

NiftiHeader read_header_1(const HeaderBytes& bytes) {
  NiftiHeader header;
  take_fields<std::int16_t, float>(bytes, 40, 76, 112, 256, 280, header);
  header.magic = bytes.text(344, 4);
  header.datatype = bytes.at<std::int16_t>(70);
  header.data_offset = static_cast<double>(bytes.at<float>(108));
  header.units = bytes.at<std::uint8_t>(123);
  header.qform = bytes.at<std::int16_t>(252);
  header.sform = bytes.at<std::int16_t>(254);
  return header;
}

NiftiHeader read_header_2(const HeaderBytes& bytes) {
  NiftiHeader header;
  header.version = 2;
  take_fields<std::int64_t, double>(bytes, 16, 104, 176, 352, 400, header);
  header.magic = bytes.text(4, 4);
  header.datatype = bytes.at<std::int16_t>(12);
  header.data_offset = static_cast<double>(bytes.at<std::int64_t>(168));
  header.units = bytes.at<std::int32_t>(500);
  header.qform = bytes.at<std::int32_t>(344);
  header.sform = bytes.at<std::int32_t>(348);
  return header;
}

NiftiHeader read_header(ByteStream& file) {
  std::vector<std::byte> start = file.take(kSize1, "the header");
  HeaderBytes bytes(start);
  for (const Endian endian : {Endian::kLittle, Endian::kBig}) {
    bytes.set_endian(endian);
    const auto size = bytes.at<std::int32_t>(0);
    if (size != kSize1 && size != kSize2) continue;
    if (size == kSize2) {
      const std::vector<std::byte> rest = file.take(kSize2 - kSize1, "the header of NIfTI-2");
      start.insert(start.end(), rest.begin(), rest.end());
      bytes = HeaderBytes(start);
      bytes.set_endian(endian);
    }
    NiftiHeader header = size == kSize1 ? read_header_1(bytes) : read_header_2(bytes);
    header.endian = endian;
    return header;
  }
  file.fail("the file starts with the number " + std::to_string(bytes.at<std::int32_t>(0)) +
            ", expected the size of a NIfTI header, 348 or 540");
}

// Type and number of values of a voxel.
void take_type(const ByteStream& file, const NiftiHeader& header, SampleLayout& layout) {
  struct Datatype {
    std::int32_t code;
    StoredType type;
    std::uint64_t components;
  };
  static constexpr std::array<Datatype, 14> kDatatypes{{{2, StoredType::kU8, 1},
                                                        {4, StoredType::kI16, 1},
                                                        {8, StoredType::kI32, 1},
                                                        {16, StoredType::kF32, 1},
                                                        {64, StoredType::kF64, 1},
                                                        {256, StoredType::kI8, 1},
                                                        {512, StoredType::kU16, 1},
                                                        {768, StoredType::kU32, 1},
                                                        {1024, StoredType::kI64, 1},
                                                        {1280, StoredType::kU64, 1},
                                                        {128, StoredType::kU8, 3},
                                                        {2304, StoredType::kU8, 4},
                                                        {32, StoredType::kF32, 2},
                                                        {1792, StoredType::kF64, 2}}};
  for (const Datatype& known : kDatatypes) {
    if (known.code != header.datatype) continue;
    layout.type = known.type;
    layout.components = known.components;
    return;
  }
  file.fail("\"datatype\" is " + std::to_string(header.datatype) + ", expected one of 2, 4, 8, 16, 32, 64, 128, 256, " +
            "512, 768, 1024, 1280, 1792 or 2304");
}

void take_dims(const ByteStream& file, const NiftiHeader& header, SampleLayout& layout) {
  const std::int64_t count = header.dim[0];
  if (count < 3 || count > 7)
    file.fail("\"dim\" says that the file has " + std::to_string(count) + " axes, expected 3 to 7");
  const auto size_at = [&](std::size_t n) {
    return dimension_of(file, "\"dim[" + std::to_string(n) + "]\"", header.dim.at(n));
  };
  for (std::size_t n = 0; n < 3; ++n) layout.dims[n] = size_at(n + 1);
  for (std::size_t n = 4; n <= static_cast<std::size_t>(count); ++n) {
    const auto size = static_cast<std::uint64_t>(size_at(n));
    constexpr std::uint64_t kMost = std::uint64_t{1} << 40;
    if (size > kMost / layout.volumes) file.fail("\"dim\" has more than 2^40 volumes");
    layout.volumes *= size;
  }
}

void take_scale(const ByteStream& file, const NiftiHeader& header, SampleLayout& layout) {
  if (header.slope == 0 || !std::isfinite(header.slope)) return;
  if (!std::isfinite(header.intercept)) file.fail("\"scl_inter\" is not finite, expected a number");
  if (layout.components == 1 && (header.slope != 1 || header.intercept != 0))
    layout.scale = {header.slope, header.intercept};
}

// The standard wants them above 0; some programs write a sign there. What mirrors the volume is pixdim[0] or the sform.
Vec3 voxel_sizes(const NiftiHeader& header) {
  return {std::abs(header.pixdim[1]), std::abs(header.pixdim[2]), std::abs(header.pixdim[3])};
}

// The rotation of a unit quaternion whose first part is left out (nifti1.h, method 2).
Affine quaternion_map(const NiftiHeader& header) {
  const auto& [b, c, d] = header.quaternion;
  double a = 1 - (b * b + c * c + d * d);
  Vec3 v = header.quaternion;
  if (a < 1e-7) {  // rounding: the vector part alone is a unit
    v = v / norm(v);
    a = 0;
  } else {
    a = std::sqrt(a);
  }
  const double x = v.x, y = v.y, z = v.z;
  const double handed = header.pixdim[0] < 0 ? -1 : 1;
  Affine map;
  const Vec3 sizes = voxel_sizes(header);
  map.columns[0] = sizes.x * Vec3{a * a + x * x - y * y - z * z, 2 * (x * y + a * z), 2 * (x * z - a * y)};
  map.columns[1] = sizes.y * Vec3{2 * (x * y - a * z), a * a + y * y - x * x - z * z, 2 * (y * z + a * x)};
  map.columns[2] = handed * sizes.z * Vec3{2 * (x * z + a * y), 2 * (y * z - a * x), a * a + z * z - y * y - x * x};
  map.offset = header.quaternion_offset;
  return map;
}

void take_geometry(const NiftiHeader& header, VolumeDescription& volume) {
  static constexpr std::array<const char*, 4> kUnits{"", "m", "mm", "um"};
  const auto unit = static_cast<std::uint32_t>(header.units) & 7u;
  if (unit < kUnits.size()) volume.units = kUnits.at(unit);
  if (header.sform <= 0 && header.qform <= 0) {
    volume.index_to_world = affine_of(voxel_sizes(header), {});
    return;
  }
  volume.space = space_name("RAS");
  if (header.sform <= 0) {
    volume.index_to_world = quaternion_map(header);
    return;
  }
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      volume.index_to_world.columns.at(column)[row] = header.rows.at(row).at(column);
    volume.index_to_world.offset[row] = header.rows.at(row)[3];
  }
}

// The file of the samples beside a header: .img, or .img.gz.
std::filesystem::path image_beside(const std::filesystem::path& header) {
  std::filesystem::path stem = header;
  if (stem.extension() == ".gz" || stem.extension() == ".GZ") stem.replace_extension();
  for (const char* const extension : {".img", ".IMG", ".img.gz"}) {
    std::filesystem::path path = stem.replace_extension(extension);
    if (std::filesystem::exists(path)) return path;
    if (stem.extension() == ".gz") stem.replace_extension();
  }
  return stem.replace_extension(".img");
}

}  // namespace

Volume read_nifti(UnpackedFile& file, const ChannelChoice& choice) {
  ByteStream& bytes = file.bytes();
  const NiftiHeader header = read_header(bytes);
  const std::string version = std::to_string(header.version);
  const bool is_pair = header.magic == "ni" + version + std::string(1, '\0');
  if (!is_pair && header.magic != "n+" + version + std::string(1, '\0'))
    bytes.fail("the magic is " + in_quotes(header.magic) + ", expected \"n+" + version + "\" or \"ni" + version +
               "\" (an Analyze file does not tell its orientation: save it as NIfTI)");
  VolumeDescription volume;
  volume.format = "NIfTI-" + version;
  SampleLayout& layout = volume.layout;
  layout.endian = header.endian;
  layout.may_go_on = true;
  take_type(bytes, header, layout);
  take_dims(bytes, header, layout);
  take_scale(bytes, header, layout);
  take_geometry(header, volume);
  const double header_size = is_pair ? 0 : header.version == 1 ? kSize1 : kSize2;
  double offset = header.data_offset;
  if (offset == 0 && !is_pair) offset = header_size + 4;  // the size of a header without extensions
  constexpr double kFarthest = 0x1p53;
  if (!(offset >= header_size && offset <= kFarthest) || offset != std::floor(offset))
    bytes.fail("\"vox_offset\" is " + std::to_string(offset) + ", expected the byte at which the samples begin");
  layout.skipped_bytes = static_cast<std::uint64_t>(offset - header_size);
  if (!is_pair) return read_described(bytes, volume, choice, file.mappable());
  file.require_folder();
  check_geometry(bytes, volume);
  choose_channel(bytes, choice, layout);
  std::optional<UnpackedFile> image;
  try {
    image.emplace(image_beside(file.file().path()));
  } catch (const InputError& error) {
    bytes.fail(std::string("the data file ") + error.what());
  }
  Volume read = read_described(image->bytes(), volume, choice, image->mappable());
  read.data_files = {image->file().path()};
  return read;
}

}  // namespace deliso

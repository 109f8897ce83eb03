#include "volume/io/nrrd/nrrd.h"

#include <optional>
#include <string>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "volume/io/base/atomic_file.h"
#include "volume/io/base/gzip_stream.h"
#include "volume/io/base/input_file.h"
#include "volume/io/nrrd/nrrd_data.h"
#include "volume/io/nrrd/nrrd_header.h"

namespace deliso {

namespace {

std::string header_text(const VolumeHeader& header, NrrdEncoding encoding) {
  const Dims& n = header.dims;
  const Vec3& s = header.spacing;
  const Vec3& o = header.origin;
  std::string out = "NRRD0004\n";
  out += "type: " + nrrd_type_name(header.type) + "\n";
  out += "dimension: 3\n";
  out += "sizes: " + std::to_string(n[0]) + " " + std::to_string(n[1]) + " " + std::to_string(n[2]) + "\n";
  out += "space dimension: 3\n";
  out += "space directions: (" + shortest_text(s.x) + ",0,0) (0," + shortest_text(s.y) + ",0) (0,0," +
         shortest_text(s.z) + ")\n";
  out += "space origin: (" + shortest_text(o.x) + "," + shortest_text(o.y) + "," + shortest_text(o.z) + ")\n";
  out += std::string("endian: ") + (kHostEndian == Endian::kLittle ? "little" : "big") + "\n";
  out += std::string("encoding: ") + (encoding == NrrdEncoding::kRaw ? "raw" : "gzip") + "\n";
  // A comment that puts raw samples on a multiple of their size, so that they can be mapped.
  if (encoding == NrrdEncoding::kRaw) {
    constexpr std::size_t kAlignment = 8;
    const std::size_t past = (out.size() + 3) % kAlignment;  // with "#", its line end and the blank line
    out += "#" + std::string((kAlignment - past) % kAlignment, '-') + "\n";
  }
  return out + "\n";
}

}  // namespace

Volume read_nrrd(UnpackedFile& file, const ChannelChoice& choice) {
  const std::filesystem::path& path = file.file().path();
  NrrdHeader header = read_nrrd_header(file.bytes(), path);
  if (!header.data_files.empty()) file.require_folder();
  VolumeDescription& volume = header.volume;
  choose_channel(file.bytes(), choice, volume.layout);
  turn_forwards(volume);
  Samples samples = [&] {
    if (header.data_files.size() > 1) {
      NrrdFileRow row(header, file.bytes());
      return read_samples(row, volume.layout);
    }
    std::optional<InputFile> detached;
    try {
      if (!header.data_files.empty()) detached.emplace(header.data_files[0]);
    } catch (const InputError& error) {
      file.bytes().fail(std::string("the data file ") + error.what());
    }
    ByteStream& bytes = detached ? *detached : file.bytes();
    const InputFile* mappable = detached ? &*detached : file.mappable();
    const auto decoded = nrrd_data(bytes,
                                   detached           ? &*detached
                                   : file.is_packed() ? nullptr
                                                      : &file.file(),
                                   header, nrrd_data_bytes(bytes, volume.layout));
    return decoded ? read_samples(*decoded, volume.layout) : read_samples(bytes, volume.layout, mappable);
  }();
  Volume read = make_volume(file.bytes(), volume, std::move(samples));
  read.data_files = std::move(header.data_files);
  return read;
}

ScalarGrid read_nrrd(const std::filesystem::path& path) {
  UnpackedFile file(path);
  return read_nrrd(file, {}).grid;
}

void write_nrrd(const ScalarGrid& grid, const std::filesystem::path& path, NrrdEncoding encoding) {
  write_nrrd(
      header_of(grid), [&grid] { return grid.samples(); }, path, encoding);
}

void write_nrrd(const VolumeHeader& header, const SampleSource& next, const std::filesystem::path& path,
                NrrdEncoding encoding) {
  AtomicFile file(path);
  file.write(header_text(header, encoding));
  if (encoding == NrrdEncoding::kRaw) {
    for_each_piece(header, next, [&file](const Samples& samples) { file.write(sample_bytes(samples)); });
  } else {
    GzipWriter gzip([&file](std::span<const std::byte> piece) { file.write(piece); });
    for_each_piece(header, next, [&gzip](const Samples& samples) { gzip.write(sample_bytes(samples)); });
    gzip.finish();
  }
  file.commit();
}

}  // namespace deliso

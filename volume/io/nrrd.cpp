#include "volume/io/nrrd.h"

#include <algorithm>

#include "delaunay/base/check.h"
#include "delaunay/base/shortest_text.h"
#include "volume/io/atomic_file.h"
#include "volume/io/gzip_stream.h"
#include "volume/io/input_file.h"
#include "volume/io/nrrd_header.h"

namespace deliso {

namespace {

// Goes over the lines and bytes that precede the samples.
void skip_to_data(InputFile& file, const NrrdHeader& header) {
  for (std::uint64_t n = 0; n < header.skipped_lines; ++n)
    if (!file.read_line())
      file.fail("the data end after " + std::to_string(n) + " lines, but \"line skip\" is " +
                std::to_string(header.skipped_lines));
  if (!header.skip_from_end) return;
  const std::uint64_t bytes = sample_count_of(file, header.layout.dims) * sample_size(header.layout.type);
  if (bytes <= file.remaining()) file.skip(file.remaining() - bytes);
}

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

ScalarGrid read_nrrd(const std::filesystem::path& path) {
  InputFile file(path);
  const NrrdHeader header = read_nrrd_header(file);
  std::optional<InputFile> detached;
  try {
    if (!header.data_file.empty()) detached.emplace(header.data_file);
  } catch (const InputError& error) {
    file.fail(std::string("the data file ") + error.what());
  }
  InputFile& data = detached ? *detached : file;
  skip_to_data(data, header);
  Samples samples = read_samples(data, header.layout);
  return make_grid(file, header.layout.dims, std::move(samples), header.spacing, header.origin);
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

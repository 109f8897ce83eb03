#include "volume/io/nrrd.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "delaunay/base/check.h"
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

// Reverses the order of the samples along an axis.
void reverse_axis(Samples& samples, const Dims& dims, std::size_t axis) {
  std::size_t stride = 1;  // between neighbours along the axis: so many samples move together
  for (std::size_t n = 0; n < axis; ++n) stride *= static_cast<std::size_t>(dims[n]);
  const auto length = static_cast<std::size_t>(dims[axis]);
  std::visit(
      [=](auto& s) {
        for (std::size_t slab = 0; slab < s.size(); slab += stride * length)
          for (std::size_t n = 0; n < length / 2; ++n) {
            auto* from = s.data() + slab + n * stride;
            std::swap_ranges(from, from + stride, s.data() + slab + (length - 1 - n) * stride);
          }
      },
      samples);
}

// The shortest text that reads back as the same double.
std::string text(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  DELISO_CHECK(error == std::errc(), "32 characters hold any double");
  return {buffer.data(), end};
}

std::string header_text(const ScalarGrid& grid, NrrdEncoding encoding) {
  const Dims& n = grid.dims();
  const Vec3& s = grid.spacing();
  const Vec3& o = grid.origin();
  std::string out = "NRRD0004\n";
  out += "type: " + nrrd_type_name(sample_type(grid.samples())) + "\n";
  out += "dimension: 3\n";
  out += "sizes: " + std::to_string(n[0]) + " " + std::to_string(n[1]) + " " + std::to_string(n[2]) + "\n";
  out += "space dimension: 3\n";
  out += "space directions: (" + text(s.x) + ",0,0) (0," + text(s.y) + ",0) (0,0," + text(s.z) + ")\n";
  out += "space origin: (" + text(o.x) + "," + text(o.y) + "," + text(o.z) + ")\n";
  out += std::string("endian: ") + (kHostEndian == Endian::kLittle ? "little" : "big") + "\n";
  out += std::string("encoding: ") + (encoding == NrrdEncoding::kRaw ? "raw" : "gzip") + "\n\n";
  return out;
}

}  // namespace

ScalarGrid read_nrrd(const std::filesystem::path& path) {
  InputFile file(path);
  NrrdHeader header = read_nrrd_header(file);
  std::optional<InputFile> detached;
  try {
    if (!header.data_file.empty()) detached.emplace(header.data_file);
  } catch (const InputError& error) {
    file.fail(std::string("the data file ") + error.what());
  }
  InputFile& data = detached ? *detached : file;
  skip_to_data(data, header);
  Samples samples = read_samples(data, header.layout);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (header.flipped[axis]) reverse_axis(samples, header.layout.dims, axis);
  return make_grid(file, header.layout.dims, std::move(samples), header.spacing, header.origin);
}

void write_nrrd(const ScalarGrid& grid, const std::filesystem::path& path, NrrdEncoding encoding) {
  AtomicFile file(path);
  file.write(header_text(grid, encoding));
  const std::span<const std::byte> bytes = sample_bytes(grid.samples());
  if (encoding == NrrdEncoding::kRaw) {
    file.write(bytes);
  } else {
    GzipWriter gzip([&file](std::span<const std::byte> piece) { file.write(piece); });
    gzip.write(bytes);
    gzip.finish();
  }
  file.commit();
}

}  // namespace deliso

#include "volume/io/volume_file.h"

#include <algorithm>

#include "delaunay/base/check.h"
#include "volume/io/nrrd.h"
#include "volume/io/raw.h"

namespace deliso {

namespace {

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

}  // namespace

ScalarGrid read_volume(const std::filesystem::path& path, const RawOptions& options) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".nrrd" || extension == ".nhdr") return read_nrrd(path);
  if (extension == ".raw") return read_raw(path, options);
  const std::string found = extension.empty() ? "has no extension" : "has the extension \"" + extension + "\"";
  throw InputError(path.string() + ": " + found + ", a volume is read from .nrrd, .nhdr or .raw");
}

VolumeHeader header_of(const ScalarGrid& grid) {
  return {grid.dims(), sample_type(grid.samples()), grid.spacing(), grid.origin()};
}

void for_each_piece(const VolumeHeader& header, const SampleSource& next,
                    const std::function<void(const Samples&)>& f) {
  const std::size_t count = checked_sample_count(header.dims);
  for (std::size_t done = 0; done < count;) {
    const Samples piece = next();
    const std::size_t size = visit_samples(piece, [](const auto& samples) { return samples.size(); });
    DELISO_CHECK(sample_type(piece) == header.type && size > 0 && size <= count - done,
                 "the pieces of a volume have its type and add up to it");
    f(piece);
    done += size;
  }
}

void write_volume(const ScalarGrid& grid, const std::filesystem::path& path, NrrdEncoding encoding) {
  write_volume(
      header_of(grid), [&grid] { return grid.samples(); }, path, encoding);
}

void write_volume(const VolumeHeader& header, const SampleSource& next, const std::filesystem::path& path,
                  NrrdEncoding encoding) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".nrrd") return write_nrrd(header, next, path, encoding);
  if (extension == ".raw") return write_raw(header, next, path);
  throw InputError(path.string() + ": the extension is \"" + extension + "\", a volume is written to .nrrd or .raw");
}

}  // namespace deliso

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
  throw InputError(path.string() + ": the extension is \"" + extension +
                   "\", a volume is read from .nrrd, .nhdr or .raw");
}

void write_volume(const ScalarGrid& grid, const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".nrrd") return write_nrrd(grid, path);
  if (extension == ".raw") return write_raw(grid, path);
  throw InputError(path.string() + ": the extension is \"" + extension + "\", a volume is written to .nrrd or .raw");
}

}  // namespace deliso

// Volumes in NRRD files: attached (.nrrd) and detached (.nhdr and a data file).
#pragma once

#include <filesystem>

#include "volume/io/volume_file.h"
#include "volume/scalar_grid.h"

namespace deliso {

// Reads encodings raw and gzip, both byte orders, the seven types of ScalarGrid in all spellings of the format; the
// geometry from `spacings`, `axis mins` and `axis maxs`, or from `space directions` along the axes and `space origin`
// (an axis that runs backwards is reversed, so that world positions stay true). Throws InputError with one sentence
// that names the file, the line, the value found and what was expected.
ScalarGrid read_nrrd(const std::filesystem::path& path);

// Writes an attached file, whole or not at all. Reading it back gives the same samples, spacing and origin bit for bit.
// Throws InputError when the file cannot be written.
void write_nrrd(const ScalarGrid& grid, const std::filesystem::path& path, NrrdEncoding encoding = NrrdEncoding::kGzip);
void write_nrrd(const VolumeHeader& header, const SampleSource& next, const std::filesystem::path& path,
                NrrdEncoding encoding);

}  // namespace deliso

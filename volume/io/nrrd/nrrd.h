// Volumes in NRRD files: attached (.nrrd) and detached (.nhdr and a data file).
#pragma once

#include <filesystem>

#include "volume/io/base/volume.h"
#include "volume/io/base/volume_header.h"
#include "volume/scalar_grid.h"

namespace deliso {

// Reads encodings raw, gzip, text and hex, both byte orders and all types of StoredType; data in the file, in another,
// or in several; the geometry from `spacings`, `axis mins` and `axis maxs`, or from `space directions` of any direction
// and `space origin`. Axes beyond three count channels. Throws InputError with one sentence that names the file, the
// line, the value found and what was expected.
Volume read_nrrd(UnpackedFile& file, const ChannelChoice& choice);
// The grid alone, of a file of one channel.
ScalarGrid read_nrrd(const std::filesystem::path& path);

// Writes an attached file, whole or not at all. Reading it back gives the same samples, spacing and origin bit for bit.
// Throws InputError when the file cannot be written.
void write_nrrd(const ScalarGrid& grid, const std::filesystem::path& path, NrrdEncoding encoding = NrrdEncoding::kGzip);
void write_nrrd(const VolumeHeader& header, const SampleSource& next, const std::filesystem::path& path,
                NrrdEncoding encoding);

}  // namespace deliso

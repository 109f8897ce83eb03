// The header of an NRRD file, read field by field (format: teem.sourceforge.net/nrrd/format.html, versions 1 to 5).
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "volume/io/base/input_file.h"
#include "volume/io/base/volume.h"

namespace deliso {

enum class NrrdData { kRaw, kGzip, kText, kHex };

// What a header says about a volume, in our terms.
struct NrrdHeader {
  VolumeDescription volume;  // the layout is that of the data behind what is skipped, uncompressed
  NrrdData encoding = NrrdData::kRaw;
  std::vector<std::filesystem::path> data_files;  // beside the header; empty when the data follow in the same file
  std::uint64_t skipped_lines = 0;                // `line skip`
  std::uint64_t skipped_bytes = 0;                // `byte skip`, after decompression
  bool skip_from_end = false;                     // `byte skip: -1`: the data are the last bytes of the file
};

// Reads the header and leaves `bytes` at the byte after it. Comments, key/value pairs and descriptive fields are
// tolerated. Throws InputError naming the line, the value found and what is expected when a line is no header line, a
// field is missing, given twice or malformed, or the file is of a kind that is not supported (blocks, bzip2, axes of
// the volume that others part).
NrrdHeader read_nrrd_header(ByteStream& bytes, const std::filesystem::path& path);

}  // namespace deliso

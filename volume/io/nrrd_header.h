// The header of an NRRD file, read field by field (format: teem.sourceforge.net/nrrd/format.html, versions 1 to 5).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "volume/io/input_file.h"

namespace deliso {

// What a header says about a volume, in our terms.
struct NrrdHeader {
  SampleLayout layout;  // skipped_bytes is `byte skip`, unless skip_from_end; flipped: against the world's direction
  Vec3 spacing{1, 1, 1};
  Vec3 origin{0, 0, 0};             // of sample (0, 0, 0) after the flips
  std::filesystem::path data_file;  // beside the header; empty when the data follow in the same file
  std::uint64_t skipped_lines = 0;  // `line skip`
  bool skip_from_end = false;       // `byte skip: -1`: the data are the last bytes of the file
};

// Reads the header and leaves `file` at the byte after it. Comments, key/value pairs and descriptive fields are
// tolerated. Throws InputError naming the line, the value found and what is expected when a line is no header line, a
// field is missing, given twice or malformed, or the file is of a kind that is not supported (other types and
// encodings, oblique or permuted axes, more than three axes longer than one sample, data in several files).
NrrdHeader read_nrrd_header(InputFile& file);

}  // namespace deliso

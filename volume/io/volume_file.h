// Reading and writing volumes: the format is chosen by the file's extension.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "volume/io/sample_type.h"
#include "volume/scalar_grid.h"

namespace deliso {

// What a headerless .raw file does not say. The collection at klacansky.com/open-scivis-datasets puts dims and type
// into the file name (`engine_256x256x256_uint8.raw`); what is given here goes before the name.
struct RawOptions {
  std::optional<Dims> dims;         // default: from the file name
  std::string type;                 // any spelling of parse_sample_type; default (empty): from the file name
  Endian endian = Endian::kLittle;  // byte order of the samples
  Vec3 spacing{1, 1, 1};            // positive and finite
  Vec3 origin{0, 0, 0};             // finite
  std::uint64_t header_bytes = 0;   // bytes before the first sample
};

// Reads .nrrd, .nhdr or .raw (the options are for .raw alone). Throws InputError with one sentence that names the file,
// the place, the value found and what was expected.
ScalarGrid read_volume(const std::filesystem::path& path, const RawOptions& options = {});

// Writes .nrrd (gzip) or .raw (little endian, dims and type must be in the name, spacing 1 and origin 0), whole or not
// at all. Throws InputError when the file cannot be written or could not be read back.
void write_volume(const ScalarGrid& grid, const std::filesystem::path& path);

}  // namespace deliso

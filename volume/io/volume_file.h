// Reading and writing volumes: the format is chosen by the file's extension.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "volume/sample_type.h"
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

// How the samples of an .nrrd file are stored. Raw ones can be mapped into memory when they are read.
enum class NrrdEncoding { kRaw, kGzip };

// What a file says about a volume besides its samples.
struct VolumeHeader {
  Dims dims{};
  SampleType type = SampleType::kU8;
  Vec3 spacing{1, 1, 1};
  Vec3 origin{0, 0, 0};
};
VolumeHeader header_of(const ScalarGrid& grid);

// Gives the next samples of a volume in their order, some more at every call, until all are there.
using SampleSource = std::function<Samples()>;

// Calls `f` with every piece. Throws InternalError when the pieces are of another type or do not add up to the header's
// dimensions.
void for_each_piece(const VolumeHeader& header, const SampleSource& next, const std::function<void(const Samples&)>& f);

// Writes .nrrd or .raw (little endian, dims and type must be in the name, spacing 1 and origin 0), whole or not
// at all. Throws InputError when the file cannot be written or could not be read back.
void write_volume(const ScalarGrid& grid, const std::filesystem::path& path,
                  NrrdEncoding encoding = NrrdEncoding::kGzip);
// The same piece by piece: the volume need not fit into memory. Precondition: the source gives the header's type.
void write_volume(const VolumeHeader& header, const SampleSource& next, const std::filesystem::path& path,
                  NrrdEncoding encoding = NrrdEncoding::kGzip);

}  // namespace deliso

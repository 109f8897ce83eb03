// Volumes in headerless .raw files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "volume/io/base/volume.h"
#include "volume/io/base/volume_header.h"

namespace deliso {

// What a headerless .raw file does not say. The collection at klacansky.com/open-scivis-datasets puts dims and type
// into the file name (`engine_256x256x256_uint8.raw`); what is given here goes before the name.
struct RawOptions {
  std::optional<Dims> dims;         // default: from the file name
  std::string type;                 // any spelling of parse_stored_type; default (empty): from the file name
  Endian endian = Endian::kLittle;  // byte order of the samples
  Vec3 spacing{1, 1, 1};            // positive and finite
  Vec3 origin{0, 0, 0};             // finite
  std::uint64_t header_bytes = 0;   // bytes before the first sample
};

// See read_volume and write_volume. A file that begins as gzip does is unpacked, unless it has just the size of the
// samples.
Volume read_raw(const std::filesystem::path& path, const RawOptions& options);
void write_raw(const VolumeHeader& header, const SampleSource& next, const std::filesystem::path& path);

}  // namespace deliso

// Volumes in headerless .raw files.
#pragma once

#include <filesystem>

#include "volume/io/volume_file.h"

namespace deliso {

// See read_volume and write_volume.
ScalarGrid read_raw(const std::filesystem::path& path, const RawOptions& options);
void write_raw(const VolumeHeader& header, const SampleSource& next, const std::filesystem::path& path);

}  // namespace deliso

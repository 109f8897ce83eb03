// Reading and writing volumes: the format is chosen by the file's extension, or by its content where that is unknown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "volume/io/base/volume.h"
#include "volume/io/base/volume_header.h"
#include "volume/io/raw/raw.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The formats that are read, for messages.
inline constexpr std::string_view kVolumeExtensions =
    ".nrrd, .nhdr, .nii, .hdr, .mhd, .mha, .vtk, .vti, .npy, .mrc, .map, .ccp4, .inr, .pvm or .raw";

struct ReadOptions {
  ReadOptions() = default;
  ReadOptions(RawOptions options) : raw(std::move(options)) {}  // NOLINT(google-explicit-constructor): as it reads

  RawOptions raw;                        // of .raw files alone
  std::optional<std::uint64_t> channel;  // of files with several values a voxel or several volumes
  std::string array;                     // of files with named arrays (.vtk, .vti)
  std::string format;                    // an extension without its dot, to be taken for the file's own; or empty
  bool stands_alone = false;             // no other file is beside it: a header of samples elsewhere is refused
  bool accepts_not_finite = false;       // NaN and infinities are counted and replaced (volume.h); else refused
};

// Whether ReadOptions::format may be this.
bool is_volume_format(const std::string& format);

// Reads a volume with its place in the world. Files that begin as gzip does are unpacked, whatever their names. Throws
// InputError with one sentence that names the file, the place, the value found and what was expected; for formats that
// are read by others, a program that converts them.
Volume read_placed_volume(const std::filesystem::path& path, const ReadOptions& options = {});

// The grid alone, in coordinates of its own (placement.h).
ScalarGrid read_volume(const std::filesystem::path& path, const ReadOptions& options = {});

// Writes .nrrd or .raw (little endian, dims and type must be in the name, spacing 1 and origin 0), whole or not
// at all. Throws InputError when the file cannot be written or could not be read back.
void write_volume(const ScalarGrid& grid, const std::filesystem::path& path,
                  NrrdEncoding encoding = NrrdEncoding::kGzip);
// The same piece by piece: the volume need not fit into memory. Precondition: the source gives the header's type.
void write_volume(const VolumeHeader& header, const SampleSource& next, const std::filesystem::path& path,
                  NrrdEncoding encoding = NrrdEncoding::kGzip);

}  // namespace deliso

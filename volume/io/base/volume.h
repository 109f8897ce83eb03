// A volume as a reader gives it, whatever the format: samples, dimensions, the affine map to the world, space and
// units.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "volume/affine.h"
#include "volume/io/base/byte_stream.h"
#include "volume/io/base/sample_reader.h"
#include "volume/not_finite.h"
#include "volume/placement.h"
#include "volume/scalar_grid.h"

namespace deliso {

// What a header says, in our terms.
struct VolumeDescription {
  SampleLayout layout;
  Affine index_to_world;  // of the samples as they lie in the file, but for the order of axes (is_z_fastest)
  std::string space;      // a name of placement.h; empty when the format does not say
  std::string units;      // "mm", "um", "angstrom", ...; empty when the format does not say
  std::string format;     // "NRRD", "NIfTI-1", ...
};

struct Volume {
  ScalarGrid grid;
  Placement placement;
  Affine index_to_world;  // of the samples as the file counts them, whichever way the grid's axes run
  std::string format;
  std::string stored_type;     // short_type_name of the samples in the file; scaled ones are doubles in memory
  std::uint64_t channels = 1;  // values of each place in the file, and volumes after each other
  std::uint64_t channel = 0;   // the one that was read
  // Where some samples are NaN or infinite: how many, and all samples as they were read. In the grid the lowest finite
  // one stands for NaN and -infinity, and the highest for +infinity.
  NotFiniteCounts not_finite{};
  std::optional<Samples> as_read{};
  // Where the grid is a part of what was read: the origin of the whole, from which local coordinates count.
  std::optional<Vec3> whole_origin{};
  std::array<std::int32_t, 3> first{};  // the file's number of the part's first sample
  // Where the file is a header, or a folder: those that hold the samples.
  std::vector<std::filesystem::path> data_files{};
};

// Which of several values to read where a file has more than one.
struct ChannelChoice {
  std::optional<std::uint64_t> channel;
};

// Sets layout.channel. Throws InputError with a sentence that names the choices when there are several and none was
// made, or the one made is not there.
void choose_channel(const ByteStream& file, const ChannelChoice& choice, SampleLayout& layout);

// Where directions run along x, y, z in this order, but some backwards, the layout reverses these axes, so that the
// volume is axis-parallel (the map stays that of the file). To be called before the samples are read.
void turn_forwards(VolumeDescription& description);

// Throws InputError naming the file of the header when the geometry is none that can be computed with; where the
// samples lie in another file, to be called before that is opened.
void check_geometry(const ByteStream& header, const VolumeDescription& description);

// The volume, with finite samples. Throws InputError naming the file when the geometry is none that can be computed
// with, or no sample is finite.
Volume make_volume(const ByteStream& file, const VolumeDescription& description, Samples samples);

// choose_channel, turn_forwards, read_samples and make_volume. `mappable`: see UnpackedFile.
Volume read_described(ByteStream& stream, VolumeDescription description, const ChannelChoice& choice,
                      const InputFile* mappable = nullptr);

// From a map whose columns are unit directions, spacings and the point of sample (0, 0, 0).
Affine affine_of(const Vec3& spacing, const Vec3& origin);

}  // namespace deliso

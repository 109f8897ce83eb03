#include "volume/io/base/volume.h"

#include <utility>

#include "delaunay/base/check.h"

namespace deliso {

namespace {

std::string choices_text(const SampleLayout& layout) {
  const std::uint64_t count = layout.components * layout.volumes;
  std::string text = "channels 0 to " + std::to_string(count - 1);
  if (layout.components > 1 && layout.volumes > 1) {
    return std::to_string(layout.volumes) + " volumes of " + std::to_string(layout.components) + " values a voxel (" +
           text + ", value + " + std::to_string(layout.components) + " * volume)";
  }
  if (layout.components > 1) return std::to_string(layout.components) + " values a voxel (" + text + ")";
  return std::to_string(layout.volumes) + " volumes (" + text + ")";
}

// The map of the samples in the order in which they are kept.
Affine map_of_kept(const VolumeDescription& description) {
  Affine map = description.index_to_world;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!description.layout.flipped[axis]) continue;
    double& along = map.columns[axis][axis];
    map.offset[axis] += along * (description.layout.dims[axis] - 1);
    along = -along;
  }
  return map;
}

}  // namespace

void choose_channel(const ByteStream& file, const ChannelChoice& choice, SampleLayout& layout) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 40;
  if (layout.components == 0 || layout.volumes == 0 || layout.components > kMost ||
      layout.volumes > kMost / layout.components)
    file.fail("the number of channels is 0 or beyond reason, expected a scalar, vector or time series volume");
  const std::uint64_t count = layout.components * layout.volumes;
  if (!choice.channel && count > 1) {
    file.fail("the file holds " + choices_text(layout) + ": choose one with its number (--channel N)");
  }
  layout.channel = choice.channel.value_or(0);
  if (layout.channel < count) return;
  file.fail("there is no channel " + std::to_string(layout.channel) + ": the file holds " +
            (count == 1 ? "one value a voxel (channel 0)" : choices_text(layout)));
}

void turn_forwards(VolumeDescription& description) {
  const Affine& map = description.index_to_world;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3& column = map.columns[axis];
    if (column[axis] == 0 || column[(axis + 1) % 3] != 0 || column[(axis + 2) % 3] != 0) return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) description.layout.flipped[axis] = map.columns[axis][axis] < 0;
}

void check_geometry(const ByteStream& header, const VolumeDescription& description) {
  try {
    static_cast<void>(frame_of(map_of_kept(description)));
  } catch (const InputError& error) {
    header.fail(error.what());
  }
}

Volume make_volume(const ByteStream& file, const VolumeDescription& description, Samples samples) {
  try {
    const SampleFrame frame = frame_of(map_of_kept(description));
    const NotFiniteCounts not_finite = count_not_finite(samples);
    std::optional<Samples> as_read;
    if (not_finite.count() > 0) {
      as_read = samples;
      const auto [low, high] = finite_range(samples);
      samples = with_finite_samples(samples, low, low, high);
    }
    Volume volume{ScalarGrid(description.layout.dims, std::move(samples), frame.spacing, frame.origin),
                  {frame.to_world, description.space, description.units},
                  description.index_to_world,
                  description.format,
                  short_type_name(description.layout.type),
                  description.layout.components * description.layout.volumes,
                  description.layout.channel,
                  not_finite,
                  std::move(as_read)};
    volume.grid.set_backwards(description.layout.flipped);
    return volume;
  } catch (const InputError& error) {
    file.fail(error.what());
  }
}

Volume read_described(ByteStream& stream, VolumeDescription description, const ChannelChoice& choice,
                      const InputFile* mappable) {
  choose_channel(stream, choice, description.layout);
  turn_forwards(description);
  check_geometry(stream, description);
  Samples samples = read_samples(stream, description.layout, mappable);
  return make_volume(stream, description, std::move(samples));
}

Affine affine_of(const Vec3& spacing, const Vec3& origin) {
  return {{Vec3{spacing.x, 0, 0}, Vec3{0, spacing.y, 0}, Vec3{0, 0, spacing.z}}, origin};
}

}  // namespace deliso

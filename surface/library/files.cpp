// Volumes and meshes in files, for callers of the library.
#include <array>
#include <memory>
#include <utility>

#include "surface/library/call.h"
#include "surface/mesh/io/mesh_io.h"
#include "volume/io/volume_file.h"
#include "volume/sample_type.h"

namespace deliso {
namespace {

// In the order of SampleType.
constexpr std::array<ScalarType, 7> kKept = {ScalarType::kUint8,  ScalarType::kInt8,  ScalarType::kUint16,
                                             ScalarType::kInt16,  ScalarType::kInt32, ScalarType::kFloat32,
                                             ScalarType::kFloat64};

std::array<std::array<double, 4>, 3> rows_of(const Affine& map) {
  std::array<std::array<double, 4>, 3> rows{};
  for (std::size_t row = 0; row < 3; ++row)
    rows[row] = {map.columns[0][row], map.columns[1][row], map.columns[2][row], map.offset[row]};
  return rows;
}

}  // namespace

LoadedVolume load_volume(const std::filesystem::path& path, std::optional<std::uint64_t> channel,
                         const std::string& array) {
  return call_guarded([&] {
    ReadOptions options;
    options.channel = channel;
    options.array = array;
    options.accepts_not_finite = true;  // who meshes it is told
    const Volume volume = read_placed_volume(path, options);
    const auto samples = std::make_shared<const Samples>(volume.as_read ? *volume.as_read : volume.grid.samples());
    LoadedVolume loaded;
    loaded.view.samples = sample_bytes(*samples).data();
    loaded.view.type = kKept.at(samples->index());
    for (std::size_t axis = 0; axis < 3; ++axis) loaded.view.dims[axis] = volume.grid.dims()[axis];
    loaded.view.affine =
        rows_of(composed(volume.placement.to_world, affine_of(volume.grid.spacing(), volume.grid.origin())));
    loaded.memory = samples;
    loaded.space = volume.placement.space;
    loaded.units = volume.placement.units;
    return loaded;
  });
}

Mesh load_mesh(const std::filesystem::path& path) {
  return call_guarded([&] { return public_mesh(read_mesh(path)); });
}

void save_mesh(const Mesh& mesh, const std::filesystem::path& path) {
  call_guarded([&] { write_mesh(engine_mesh(mesh), path); });
}

}  // namespace deliso

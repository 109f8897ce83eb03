// Volumes and meshes in files, for callers of the library.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "surface/library/call.h"
#include "surface/library/mesh_notes.h"
#include "surface/mesh/io/mesh_io.h"
#include "surface/mesh/io/stl_notes.h"
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

// The samples in the order of the file: along axes that are kept the other way round from the last one on.
VolumeView view_as_file(const Volume& volume, const Samples& samples) {
  const std::span<const std::byte> bytes = sample_bytes(samples);
  VolumeView view;
  view.type = kKept.at(samples.index());
  for (std::size_t axis = 0; axis < 3; ++axis) view.dims[axis] = volume.grid.dims()[axis];
  const auto [x, y, z] = volume.grid.backwards();
  if (!x && !y && !z) {
    view.samples = bytes.data();
    view.affine = rows_of(composed(volume.placement.to_world, affine_of(volume.grid.spacing(), volume.grid.origin())));
    return view;
  }
  auto stride = static_cast<std::int64_t>(bytes.size() / volume.grid.sample_count());
  const std::byte* first = bytes.data();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    view.strides[axis] = volume.grid.backwards()[axis] ? -stride : stride;
    if (view.strides[axis] < 0) first += (view.dims[axis] - 1) * stride;
    stride *= view.dims[axis];
  }
  view.samples = first;
  view.affine = rows_of(volume.index_to_world);
  return view;
}

}  // namespace

LoadedVolume load_volume(const std::filesystem::path& path, std::optional<std::uint64_t> channel,
                         const std::string& array) {
  return call_guarded([&] {
    ReadOptions options;
    options.channel = channel;
    options.array = array;
    options.accepts_not_finite = true;  // who meshes it is told
    const Volume volume = read_placed_volume(checked_path(path), options);
    const auto samples = std::make_shared<const Samples>(volume.as_read ? *volume.as_read : volume.grid.samples());
    LoadedVolume loaded;
    loaded.view = view_as_file(volume, *samples);
    loaded.memory = samples;
    loaded.space = volume.placement.space;
    loaded.units = volume.placement.units;
    return loaded;
  });
}

Mesh load_mesh(const std::filesystem::path& path) {
  return call_guarded([&] {
    MeshFile file = read_mesh_file(checked_path(path));
    Mesh mesh = public_mesh(file.mesh);
    mesh.comments = file.format == MeshFormat::kStl ? long_stl_notes(file.comments) : std::move(file.comments);
    return mesh;
  });
}

void save_mesh(const Mesh& mesh, const std::filesystem::path& path) {
  call_guarded([&] {
    MeshFileOptions options;
    options.format = mesh_format_of(checked_path(path));
    for (const std::string& line : mesh.comments) options.comments.push_back(on_one_line(line));
    if (options.format == MeshFormat::kStl) options.comments = short_stl_notes(options.comments).comments;
    write_mesh(engine_mesh(mesh), path, options);
  });
}

}  // namespace deliso

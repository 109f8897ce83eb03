#include "surface/repair/finish/finer_cubes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "surface/certificate/exact_polygonization.h"
#include "volume/filters/finer_grid.h"

namespace deliso {

namespace {

constexpr std::int64_t kMostSamples = std::int64_t{1} << 25;
constexpr int kMostTries = 4;  // factors tried until no sample of the finer grid equals the isovalue

// The samples of all cells that the component passes through: each of them has a crossing of it on an edge.
SamplePart part_around(std::uint32_t component, const ExactSurface& surface) {
  const Dims& dims = surface.grid().dims();
  CellIndex low = dims, high{};
  for (const EdgeCrossing& crossing : surface.topology.crossings) {
    if (crossing.component != component) continue;
    const CellIndex at = sample_of(crossing, dims);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], std::max(0, at[axis] - 1));
      high[axis] = std::max(high[axis], std::min(dims[axis] - 1, at[axis] + 1));
    }
  }
  return {low, {high[0] - low[0] + 1, high[1] - low[1] + 1, high[2] - low[2] + 1}};
}

bool has_sample(const ScalarGrid& grid, double isovalue) {
  const auto& samples = std::get<SampleArray<double>>(grid.samples());
  return std::find(samples.begin(), samples.end(), isovalue) != samples.end();
}

// The component of the finer grid that is the given one: by a crossing that both have.
std::optional<std::uint32_t> same_component(std::uint32_t component, const ExactSurface& surface,
                                            const IsosurfaceTopology& finer, const Dims& dims, const SamplePart& part,
                                            const std::array<std::int32_t, 3>& times) {
  for (const EdgeCrossing& crossing : finer.crossings) {
    std::array<std::int32_t, 3> at = sample_of(crossing, dims);
    bool is_common = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      is_common = is_common && (axis == crossing.axis || at[axis] % times[axis] == 0);
      at[axis] = part.low[axis] + at[axis] / times[axis];
    }
    if (!is_common) continue;
    const std::uint32_t found = surface.topology.index.find(at[0], at[1], at[2], crossing.axis);
    if (found == CrossingIndex::kNone || surface.topology.crossings[found].component != component) continue;
    return crossing.component;
  }
  return std::nullopt;
}

// Crossings that round to a sample would coincide there, and their triangles cross. At a distance from it, far less
// than vertices may be off the isosurface, they do not.
void keep_apart(IsosurfaceTopology& topology) {
  constexpr double kLeast = 2e-4;  // of an edge
  for (EdgeCrossing& crossing : topology.crossings) crossing.t = std::clamp(crossing.t, kLeast, 1 - kLeast);
}

}  // namespace

bool append_finer_cubes(std::uint32_t component, const ExactSurface& surface, double max_distance, SurfaceMesh& mesh) {
  constexpr double kDiagonal = 0.9;  // of the distance
  const double isovalue = surface.isosurface.isovalue();
  const SamplePart part = part_around(component, surface);
  const Vec3& step = surface.isosurface.step();
  std::array<std::int32_t, 3> times{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    times[axis] = static_cast<std::int32_t>(std::ceil(step[axis] * std::sqrt(3.0) / (kDiagonal * max_distance)));
  }
  std::optional<ScalarGrid> grid = finer_grid(surface.grid(), part, times, kMostSamples);
  for (int i = 0; i < kMostTries && grid && has_sample(*grid, isovalue); ++i) {
    for (std::int32_t& factor : times) ++factor;
    grid = finer_grid(surface.grid(), part, times, kMostSamples);
  }
  if (!grid || has_sample(*grid, isovalue)) return false;
  IsosurfaceTopology topology = exact_topology(*grid, isovalue, surface.threads);
  const auto same = same_component(component, surface, topology, grid->dims(), part, times);
  if (!same || topology.components[*same] != surface.topology.components[component]) return false;
  keep_apart(topology);

  const Isosurface isosurface(*grid, isovalue, SearchOptions{});
  ExactPolygonization cubes = exact_polygonization({isosurface, topology, surface.threads});
  std::vector<bool> wanted(topology.components.size(), false);
  wanted[*same] = true;
  const std::size_t first = mesh.points.size();
  append_pieces(cubes.mesh, cubes.component, wanted, mesh);
  for (std::size_t v = first; v < mesh.points.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mesh.points[v][axis] = (part.low[axis] + mesh.points[v][axis] / times[axis]) * step[axis];
    }
  }
  return true;
}

}  // namespace deliso

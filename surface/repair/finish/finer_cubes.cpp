#include "surface/repair/finish/finer_cubes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "surface/certificate/exact_polygonization.h"

namespace deliso {

namespace {

constexpr std::int64_t kMostSamples = std::int64_t{1} << 25;
constexpr int kMostTries = 4;  // factors tried until no sample of the finer grid equals the isovalue

// A box of samples of the grid.
struct SampleBox {
  std::array<std::int32_t, 3> low{}, high{};
};

// The samples of all cells that the component passes through: each of them has a crossing of it on an edge.
SampleBox box_of_component(std::uint32_t component, const ExactSurface& surface) {
  const Dims& dims = surface.grid().dims();
  SampleBox box{{dims[0], dims[1], dims[2]}, {0, 0, 0}};
  for (const EdgeCrossing& crossing : surface.topology.crossings) {
    if (crossing.component != component) continue;
    const std::array<std::int32_t, 3> at = sample_of(crossing, dims);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], std::max(0, at[axis] - 1));
      box.high[axis] = std::max(box.high[axis], std::min(dims[axis] - 1, at[axis] + 1));
    }
  }
  return box;
}

// Exact at both ends.
double between(double a, double b, double t) { return t == 0 ? a : (t == 1 ? b : a + t * (b - a)); }

double value_in(const CellCorners& c, const Vec3& t) {
  const double low = between(between(c[0], c[1], t.x), between(c[2], c[3], t.x), t.y);
  const double high = between(between(c[4], c[5], t.x), between(c[6], c[7], t.x), t.y);
  return between(low, high, t.z);
}

// The interpolant's samples, `times` as many steps along each axis; in units of the finer steps. None where it would be
// too large.
std::optional<ScalarGrid> finer_grid(const ScalarGrid& grid, const SampleBox& box,
                                     const std::array<std::int32_t, 3>& times) {
  Dims dims{};
  double count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    count *= double(box.high[axis] - box.low[axis]) * times[axis] + 1;
    if (count > double(kMostSamples)) return std::nullopt;
    dims[axis] = (box.high[axis] - box.low[axis]) * times[axis] + 1;
  }
  std::vector<double> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (std::int32_t k = 0; k < dims[2]; ++k) {
    for (std::int32_t j = 0; j < dims[1]; ++j) {
      for (std::int32_t i = 0; i < dims[0]; ++i) {
        const std::array<std::int32_t, 3> at = {i, j, k};
        std::array<std::int32_t, 3> cell{};
        Vec3 t;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          cell[axis] = std::min(box.low[axis] + at[axis] / times[axis], box.high[axis] - 1);
          t[axis] = double(at[axis] - (cell[axis] - box.low[axis]) * times[axis]) / times[axis];
        }
        samples.push_back(value_in(grid.cell(cell[0], cell[1], cell[2]), t));
      }
    }
  }
  return ScalarGrid(dims, Samples(std::move(samples)));
}

bool has_sample(const ScalarGrid& grid, double isovalue) {
  const auto& samples = std::get<SampleArray<double>>(grid.samples());
  return std::find(samples.begin(), samples.end(), isovalue) != samples.end();
}

// The component of the finer grid that is the given one: by a crossing that both have.
std::optional<std::uint32_t> same_component(std::uint32_t component, const ExactSurface& surface,
                                            const IsosurfaceTopology& finer, const Dims& dims, const SampleBox& box,
                                            const std::array<std::int32_t, 3>& times) {
  for (const EdgeCrossing& crossing : finer.crossings) {
    std::array<std::int32_t, 3> at = sample_of(crossing, dims);
    bool is_common = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      is_common = is_common && (axis == crossing.axis || at[axis] % times[axis] == 0);
      at[axis] = box.low[axis] + at[axis] / times[axis];
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
  const SampleBox box = box_of_component(component, surface);
  const Vec3& step = surface.isosurface.step();
  std::array<std::int32_t, 3> times{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    times[axis] = static_cast<std::int32_t>(std::ceil(step[axis] * std::sqrt(3.0) / (kDiagonal * max_distance)));
  }
  std::optional<ScalarGrid> grid = finer_grid(surface.grid(), box, times);
  for (int i = 0; i < kMostTries && grid && has_sample(*grid, isovalue); ++i) {
    for (std::int32_t& factor : times) ++factor;
    grid = finer_grid(surface.grid(), box, times);
  }
  if (!grid || has_sample(*grid, isovalue)) return false;
  IsosurfaceTopology topology = exact_topology(*grid, isovalue, surface.threads);
  const auto same = same_component(component, surface, topology, grid->dims(), box, times);
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
      mesh.points[v][axis] = (box.low[axis] + mesh.points[v][axis] / times[axis]) * step[axis];
    }
  }
  return true;
}

}  // namespace deliso

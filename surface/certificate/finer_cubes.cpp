#include "surface/certificate/finer_cubes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "volume/filters/finer_grid.h"

namespace deliso {

namespace {

constexpr std::int64_t kMostSamples = std::int64_t{1} << 25;
constexpr int kMostTries = 4;  // factors tried until no sample of the finer grid equals the isovalue

// Of each component, the samples of all cells that it passes through: each of them has a crossing of it on an edge.
std::vector<SamplePart> parts_around(const ExactSurface& surface) {
  const Dims& dims = surface.grid().dims();
  const std::size_t count = surface.topology.components.size();
  std::vector<CellIndex> low(count, dims), high(count, {0, 0, 0});
  for (const EdgeCrossing& crossing : surface.topology.crossings) {
    const std::uint32_t c = crossing.component;
    const CellIndex at = sample_of(crossing, dims);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[c][axis] = std::min(low[c][axis], std::max(0, at[axis] - 1));
      high[c][axis] = std::max(high[c][axis], std::min(dims[axis] - 1, at[axis] + 1));
    }
  }
  std::vector<SamplePart> parts;
  for (std::size_t c = 0; c < count; ++c) {
    const auto along = [&](std::size_t axis) { return high[c][axis] - low[c][axis] + 1; };
    parts.push_back({low[c], {along(0), along(1), along(2)}});
  }
  return parts;
}

bool has_sample(const ScalarGrid& grid, double isovalue) {
  const auto& samples = std::get<SampleArray<double>>(grid.samples());
  return std::find(samples.begin(), samples.end(), isovalue) != samples.end();
}

// A part of the grid at some factors.
struct FinerPart {
  ScalarGrid grid;
  SamplePart part;
  GridFactors factors;

  // In the mesh space of the whole grid.
  [[nodiscard]] Vec3 place(const Vec3& p, const Vec3& step) const {
    Vec3 place;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis] = (part.low[axis] + p[axis] / factors[axis]) * step[axis];
    }
    return place;
  }
};

std::optional<FinerPart> finer_part(const ExactSurface& surface, const SamplePart& part, GridFactors factors) {
  for (int i = 0; i < kMostTries; ++i) {
    std::optional<ScalarGrid> grid = finer_grid(surface.grid(), part, factors, kMostSamples);
    if (!grid) return std::nullopt;
    if (!has_sample(*grid, surface.isosurface.isovalue())) return FinerPart{std::move(*grid), part, factors};
    for (std::int32_t& factor : factors) factor += factor > 1 ? 1 : 0;
  }
  return std::nullopt;
}

// The component of the finer grid that is the given one: by a crossing that both have.
std::optional<std::uint32_t> same_component(std::uint32_t component, const ExactSurface& surface,
                                            const FinerPart& finer, const IsosurfaceTopology& topology) {
  for (const EdgeCrossing& crossing : topology.crossings) {
    CellIndex at = sample_of(crossing, finer.grid.dims());
    bool is_common = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      is_common = is_common && (axis == crossing.axis || at[axis] % finer.factors[axis] == 0);
      at[axis] = finer.part.low[axis] + at[axis] / finer.factors[axis];
    }
    if (!is_common) continue;
    const std::uint32_t found = surface.topology.index.find(at[0], at[1], at[2], crossing.axis);
    if (found == CrossingIndex::kNone || surface.topology.crossings[found].component != component) continue;
    return crossing.component;
  }
  return std::nullopt;
}

// Appends the cubes of a component in its part of the grid.
void append_cubes_of(std::uint32_t component, const SamplePart& part, const ExactSurface& surface,
                     const GridFactors& factors, ExactPolygonization& all) {
  const std::optional<FinerPart> finer = finer_part(surface, part, factors);
  if (!finer) return;
  const double isovalue = surface.isosurface.isovalue();
  IsosurfaceTopology topology = exact_topology(finer->grid, isovalue, surface.threads);
  const auto same = same_component(component, surface, *finer, topology);
  if (!same || topology.components[*same] != surface.topology.components[component]) return;
  keep_apart(topology);
  const Isosurface isosurface(finer->grid, isovalue, SearchOptions{});
  const ExactPolygonization cubes = exact_polygonization({isosurface, topology, surface.threads});
  std::vector<bool> wanted(topology.components.size(), false);
  wanted[*same] = true;
  const std::size_t first = all.mesh.points.size();
  append_pieces(cubes.mesh, cubes.component, wanted, all.mesh);
  for (std::size_t v = first; v < all.mesh.points.size(); ++v) {
    all.mesh.points[v] = finer->place(all.mesh.points[v], surface.isosurface.step());
  }
  all.component.resize(all.mesh.points.size(), component);
}

}  // namespace

void keep_apart(IsosurfaceTopology& topology) {
  constexpr double kLeast = 2e-4;  // of an edge
  for (EdgeCrossing& crossing : topology.crossings) crossing.t = std::clamp(crossing.t, kLeast, 1 - kLeast);
}

GridFactors factors_within(double max_distance, const Isosurface& isosurface) {
  constexpr double kDiagonal = 0.9;  // of the distance
  GridFactors factors{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double parts = isosurface.step()[axis] * std::sqrt(3.0) / (kDiagonal * max_distance);
    factors[axis] = static_cast<std::int32_t>(std::ceil(parts));
  }
  return factors;
}

ExactPolygonization finer_cubes(const std::vector<bool>& components, const ExactSurface& surface,
                                const GridFactors& factors) {
  ExactPolygonization all;
  if (std::find(components.begin(), components.end(), true) == components.end()) return all;
  const std::vector<SamplePart> parts = parts_around(surface);
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    if (components[c]) append_cubes_of(c, parts[c], surface, factors, all);
  }
  take_strips_off(all, surface.isosurface);
  return all;
}

}  // namespace deliso

#include "surface/repair/finish/nearer_cubes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>

#include "surface/certificate/geometry_check.h"
#include "surface/certificate/graded_cubes.h"
#include "surface/intersection/self_intersection.h"
#include "surface/mesh/side_adjacency.h"

namespace deliso {

namespace {

constexpr int kMostRounds = 8;
constexpr std::int32_t kMostParts = 4;  // of a cell, because many are too far
constexpr std::size_t kFewCells = 20;   // one cell in so many may be
constexpr std::size_t kMostCrossings = 4096;

// The cells that are to be divided.
class DividedCells {
 public:
  explicit DividedCells(const ExactSurface& surface) : step_(surface.isosurface.step()), dims_(surface.grid().dims()) {}

  // A triangle of marching cubes lies in one cell.
  void add_cell_of(const SurfaceMesh& mesh, std::uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    add_cells_at((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3);
  }
  // All cells that a point lies in, on their boundaries too.
  void add_cells_at(const Vec3& p) {
    constexpr double kMargin = 1e-9;  // of a cell
    CellIndex low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto cell = [&](double place) {
        return static_cast<std::int32_t>(std::clamp(std::floor(place), 0.0, double(dims_[axis] - 2)));
      };
      low[axis] = cell(p[axis] / step_[axis] - kMargin);
      high[axis] = cell(p[axis] / step_[axis] + kMargin);
    }
    for (std::int32_t k = low[2]; k <= high[2]; ++k) {
      for (std::int32_t j = low[1]; j <= high[1]; ++j) {
        for (std::int32_t i = low[0]; i <= high[0]; ++i) cells_.insert({i, j, k});
      }
    }
  }
  [[nodiscard]] std::vector<CellIndex> list() const { return {cells_.begin(), cells_.end()}; }
  [[nodiscard]] std::size_t count() const { return cells_.size(); }

 private:
  Vec3 step_;
  Dims dims_;
  std::set<CellIndex> cells_;
};

// Those of the wanted components alone.
ExactPolygonization part_of(const ExactPolygonization& all, const std::vector<bool>& components) {
  ExactPolygonization part;
  append_pieces(all.mesh, all.component, components, part.mesh);
  std::copy_if(all.component.begin(), all.component.end(), std::back_inserter(part.component),
               [&](std::uint32_t c) { return c < components.size() && components[c]; });
  set_side_adjacency(part.mesh);
  return part;
}

void add_far_cells(const SurfaceMesh& mesh, const std::vector<bool>& components, const ExactSurface& surface,
                   double max_distance, DividedCells& cells) {
  ExactSurface own = surface;
  own.is_dropped.clear();
  for (const bool is_wanted : components) own.is_dropped.push_back(is_wanted ? 0 : 1);
  const GeometryCheck check = check_distances(mesh, own, {.max_distance = max_distance, .within_cells = true});
  for (const std::uint32_t t : check.far_triangles) cells.add_cell_of(mesh, t);
  for (const Vec3& p : check.missed_points) cells.add_cells_at(p);
}

}  // namespace

ExactPolygonization nearer_cubes(const std::vector<bool>& components, const ExactSurface& surface,
                                 const CubeNearness& wanted) {
  ExactPolygonization whole = part_of(exact_polygonization(surface), components);
  DividedCells cells(surface);
  for (const Vec3& p : wanted.samples) cells.add_cells_at(p);
  add_far_cells(whole.mesh, components, surface, wanted.max_distance, cells);
  std::int32_t parts = wanted.parts;
  for (int round = 0; round < kMostRounds && cells.count() > 0; ++round) {
    const std::optional<ExactPolygonization> graded = graded_cubes(surface, cells.list(), {parts, parts, parts});
    if (!graded) {
      ++parts;  // the mean of two samples is often the isovalue, other sums of them are not
      continue;
    }
    ExactPolygonization part = part_of(*graded, components);
    const SelfIntersections found =
        self_intersections(part.mesh.points, part.mesh.triangles, kMostCrossings, surface.threads);
    const std::size_t before = cells.count();
    for (const TrianglePair& pair : found.crossing) {
      cells.add_cell_of(part.mesh, pair.first);
      cells.add_cell_of(part.mesh, pair.second);
    }
    if (cells.count() > before) continue;
    if (found.crossing_pairs > 0) break;
    whole = std::move(part);
    if (parts >= kMostParts) break;
    DividedCells far(surface);
    add_far_cells(whole.mesh, components, surface, wanted.max_distance, far);
    if (far.count() * kFewCells <= cells.count()) break;
    ++parts;
  }
  return whole;
}

}  // namespace deliso

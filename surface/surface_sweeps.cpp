#include "surface/surface_sweeps.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "surface/surface_mesh.h"
#include "volume/marching_cubes.h"

namespace deliso {

namespace {

// Of a crossing as of the vertex of the mesh.
SampleLayers layers_of(const EdgeCrossing& crossing, const ScalarGrid& grid, const Vec3& step) {
  return layers_at(scaled(crossing_position(grid, crossing), step), step, grid.dims());
}

// Twice the Euler characteristic is the sum of 2 for every vertex and of 2 - 3 for every triangle, each with half of
// its three edges, less 1 for every edge on the box, which has no other half. All of them count from the highest layer
// of their corners on.
template <class Visit>
class ExactChanges {
 public:
  ExactChanges(const ScalarGrid& grid, const Isosurface& isosurface, const IsosurfaceTopology& topology,
               const std::function<bool(const CellIndex&)>& is_wanted, Visit visit)
      : grid_(grid), step_(isosurface.step()), dims_(grid.dims()), topology_(topology), visit_(std::move(visit)) {
    for (const EdgeCrossing& crossing : topology.crossings) {
      visit_(crossing.component, layers_of(crossing, grid, step_), 2);
    }
    for_each_marching_cubes_patch(
        grid, isosurface.isovalue(), topology.index, topology.crossings,
        [&](const MarchingCubesPatch& patch) { visit_patch(patch); }, nullptr, is_wanted);
  }

 private:
  void visit_patch(const MarchingCubesPatch& patch);

  // Of a point in index space, just as that of the mesh.
  [[nodiscard]] SampleLayers layers_of_crossing(const Vec3& p) const {
    return layers_at(scaled(p, step_), step_, dims_);
  }
  [[nodiscard]] SampleLayers layers_of_inner_point(const Vec3& p) const {
    return layers_at(from_world(grid_.origin() + scaled(p, grid_.spacing()), grid_, step_), step_, dims_);
  }
  [[nodiscard]] bool are_on_one_face_of_box(const Vec3& a, const Vec3& b) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (a[axis] == b[axis] && (a[axis] == 0 || a[axis] == dims_[axis] - 1)) return true;
    }
    return false;
  }

  const ScalarGrid& grid_;
  const Vec3& step_;
  Dims dims_;
  const IsosurfaceTopology& topology_;
  Visit visit_;
  std::vector<SampleLayers> at_;  // of the vertices of the patch at hand
  std::vector<bool> is_counted_;  // of the same
};

// Its triangles with half their edges, and its inner points.
template <class Visit>
void ExactChanges<Visit>::visit_patch(const MarchingCubesPatch& patch) {
  at_.clear();
  for (std::size_t v = 0; v < patch.points.size(); ++v) {
    const Vec3& p = patch.points[v];
    at_.push_back(v < patch.crossing_count ? layers_of_crossing(p) : layers_of_inner_point(p));
  }
  is_counted_.assign(patch.points.size(), false);
  for (const auto& v : patch.triangles) {
    // Every triangle has a crossing for a corner.
    const std::uint32_t component = topology_.crossings[patch.vertices[std::min({v[0], v[1], v[2]})]].component;
    visit_(component, highest(highest(at_[v[0]], at_[v[1]]), at_[v[2]]), 2);
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t a = v[i];
      const std::uint32_t b = v[(i + 1) % 3];
      const bool are_crossings = std::max(a, b) < patch.crossing_count;
      const bool is_whole = are_crossings && are_on_one_face_of_box(patch.points[a], patch.points[b]);
      visit_(component, highest(at_[a], at_[b]), is_whole ? -2 : -1);
      if (a < patch.crossing_count || is_counted_[a]) continue;
      is_counted_[a] = true;
      visit_(component, at_[a], 2);
    }
  }
}

}  // namespace

void for_each_exact_change(const ScalarGrid& grid, const Isosurface& isosurface, const IsosurfaceTopology& topology,
                           const std::function<bool(const CellIndex&)>& is_wanted, const VisitChange& visit) {
  const ExactChanges changes(grid, isosurface, topology, is_wanted, std::cref(visit));
}

SurfaceSweeps::SurfaceSweeps(const ScalarGrid& grid, const Isosurface& isosurface, const IsosurfaceTopology& topology)
    : dims_(grid.dims()) {
  find_layers(grid, isosurface, topology);
  const ExactChanges changes(
      grid, isosurface, topology, {}, [this](std::uint32_t component, const SampleLayers& at, std::int32_t twice) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Layers& layers = layers_[component][axis];
          twice_changes_[layers.begin + static_cast<std::size_t>(at[axis] - layers.first)] += twice;
        }
      });
}

// The layers that the crossings of each component are in; a rounded inner point may be in one beside them.
void SurfaceSweeps::find_layers(const ScalarGrid& grid, const Isosurface& isosurface,
                                const IsosurfaceTopology& topology) {
  using Reach = std::pair<std::int32_t, std::int32_t>;
  std::vector<std::array<Reach, 3>> reach(topology.components.size());
  for (auto& along : reach) along.fill({std::numeric_limits<std::int32_t>::max(), 0});
  for (const EdgeCrossing& crossing : topology.crossings) {
    const SampleLayers at = layers_of(crossing, grid, isosurface.step());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto& [first, last] = reach[crossing.component][axis];
      first = std::min(first, at[axis]);
      last = std::max(last, at[axis]);
    }
  }
  std::size_t total = 0;
  layers_.resize(reach.size());
  for (std::size_t c = 0; c < reach.size(); ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Layers& layers = layers_[c][axis];
      layers.begin = total;
      layers.first = std::max(reach[c][axis].first - 1, 0);
      layers.count = std::min(reach[c][axis].second + 1, dims_[axis] - 1) + 1 - layers.first;
      total += static_cast<std::size_t>(layers.count);
    }
  }
  twice_changes_.assign(total, 0);
}

SweptCharacteristics SurfaceSweeps::of(std::uint32_t component) const {
  SweptCharacteristics swept;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Layers& layers = layers_[component][axis];
    std::vector<std::int64_t>& along = swept[axis];
    along.assign(static_cast<std::size_t>(dims_[axis]), 0);
    const auto first = static_cast<std::size_t>(layers.first);
    for (std::size_t i = 0; i < static_cast<std::size_t>(layers.count); ++i) {
      along[first + i] = twice_changes_[layers.begin + i] / 2;
    }
    std::partial_sum(along.begin(), along.end(), along.begin());
  }
  return swept;
}

}  // namespace deliso

#include "surface/surface_sweeps.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "surface/surface_mesh.h"
#include "volume/marching_cubes.h"

namespace deliso {

// Twice the Euler characteristic is the sum of 2 for every vertex and of 2 - 3 for every triangle, each with half of
// its three edges, less 1 for every edge on the box, which has no other half. All of them count from the highest layer
// of their corners on.
class SurfaceSweeps::Counter {
 public:
  Counter(SurfaceSweeps& sweeps, const ScalarGrid& grid, const Isosurface& isosurface,
          const IsosurfaceTopology& topology)
      : sweeps_(sweeps), grid_(grid), step_(isosurface.step()), dims_(grid.dims()), topology_(topology) {}

  void find_layers();
  void count_crossings();
  void count_patch(const MarchingCubesPatch& patch);

 private:
  using LayersOfPoint = std::array<std::int32_t, 3>;

  // Of a point in index space, just as that of the mesh.
  [[nodiscard]] LayersOfPoint layers_of_crossing(const Vec3& p) const {
    return layers_at(scaled(p, step_), step_, dims_);
  }
  [[nodiscard]] LayersOfPoint layers_of_inner_point(const Vec3& p) const {
    return layers_at(from_world(grid_.origin() + scaled(p, grid_.spacing()), grid_, step_), step_, dims_);
  }
  void change(std::uint32_t component, const LayersOfPoint& at, std::int32_t twice) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Layers& layers = sweeps_.layers_[component][axis];
      sweeps_.twice_changes_[layers.begin + static_cast<std::size_t>(at[axis] - layers.first)] += twice;
    }
  }
  static LayersOfPoint highest(const LayersOfPoint& a, const LayersOfPoint& b) {
    return {std::max(a[0], b[0]), std::max(a[1], b[1]), std::max(a[2], b[2])};
  }
  [[nodiscard]] bool are_on_one_face_of_box(const Vec3& a, const Vec3& b) const;

  SurfaceSweeps& sweeps_;
  const ScalarGrid& grid_;
  const Vec3& step_;
  Dims dims_;
  const IsosurfaceTopology& topology_;
  std::vector<LayersOfPoint> at_;  // of the vertices of the patch at hand
  std::vector<bool> is_counted_;   // of the same
};

// The layers that the crossings of each component are in; a rounded inner point may be in one beside them.
void SurfaceSweeps::Counter::find_layers() {
  using Reach = std::pair<std::int32_t, std::int32_t>;
  std::vector<std::array<Reach, 3>> reach(topology_.components.size());
  for (auto& along : reach) along.fill({std::numeric_limits<std::int32_t>::max(), 0});
  for (const EdgeCrossing& crossing : topology_.crossings) {
    const LayersOfPoint at = layers_of_crossing(crossing_position(grid_, crossing));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto& [first, last] = reach[crossing.component][axis];
      first = std::min(first, at[axis]);
      last = std::max(last, at[axis]);
    }
  }
  std::size_t total = 0;
  sweeps_.layers_.resize(reach.size());
  for (std::size_t c = 0; c < reach.size(); ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Layers& layers = sweeps_.layers_[c][axis];
      layers.begin = total;
      layers.first = std::max(reach[c][axis].first - 1, 0);
      layers.count = std::min(reach[c][axis].second + 1, dims_[axis] - 1) + 1 - layers.first;
      total += static_cast<std::size_t>(layers.count);
    }
  }
  sweeps_.twice_changes_.assign(total, 0);
}

void SurfaceSweeps::Counter::count_crossings() {
  for (const EdgeCrossing& crossing : topology_.crossings) {
    change(crossing.component, layers_of_crossing(crossing_position(grid_, crossing)), 2);
  }
}

bool SurfaceSweeps::Counter::are_on_one_face_of_box(const Vec3& a, const Vec3& b) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a[axis] == b[axis] && (a[axis] == 0 || a[axis] == dims_[axis] - 1)) return true;
  }
  return false;
}

// Its triangles with half their edges, and its inner points.
void SurfaceSweeps::Counter::count_patch(const MarchingCubesPatch& patch) {
  at_.clear();
  for (std::size_t v = 0; v < patch.points.size(); ++v) {
    const Vec3& p = patch.points[v];
    at_.push_back(v < patch.crossing_count ? layers_of_crossing(p) : layers_of_inner_point(p));
  }
  is_counted_.assign(patch.points.size(), false);
  for (const auto& v : patch.triangles) {
    // Every triangle has a crossing for a corner.
    const std::uint32_t component = topology_.crossings[patch.vertices[std::min({v[0], v[1], v[2]})]].component;
    change(component, highest(highest(at_[v[0]], at_[v[1]]), at_[v[2]]), 2);
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t a = v[i];
      const std::uint32_t b = v[(i + 1) % 3];
      const bool are_crossings = std::max(a, b) < patch.crossing_count;
      const bool is_whole = are_crossings && are_on_one_face_of_box(patch.points[a], patch.points[b]);
      change(component, highest(at_[a], at_[b]), is_whole ? -2 : -1);
      if (a < patch.crossing_count || is_counted_[a]) continue;
      is_counted_[a] = true;
      change(component, at_[a], 2);
    }
  }
}

SurfaceSweeps::SurfaceSweeps(const ScalarGrid& grid, const Isosurface& isosurface, const IsosurfaceTopology& topology)
    : dims_(grid.dims()) {
  Counter counter(*this, grid, isosurface, topology);
  counter.find_layers();
  counter.count_crossings();
  for_each_marching_cubes_patch(grid, isosurface.isovalue(), topology.index, topology.crossings,
                                [&](const MarchingCubesPatch& patch) { counter.count_patch(patch); });
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

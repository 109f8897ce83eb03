#include "surface/surface_sweeps.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

#include "volume/exact_topology_cell.h"

namespace deliso {

namespace {

SampleLayers layers_of(const EdgeCrossing& crossing, const Dims& dims) {
  SampleLayers layers = sample_of(crossing, dims);
  ++layers[crossing.axis];
  return layers;
}

// The surface is made of crossings, of arcs in which it meets grid faces and of pieces in cells, each with an Euler
// characteristic of its own: 1, -1, and 1 or 0. An arc belongs to two cells, which have half of it each; or to one,
// when it lies on the box.
template <class Visit>
class ExactChanges {
 public:
  ExactChanges(const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology,
               const std::function<bool(const CellIndex&)>& is_wanted, Visit visit)
      : grid_(grid), isovalue_(isovalue), topology_(topology), visit_(std::move(visit)) {
    for (const EdgeCrossing& crossing : topology.crossings) {
      visit_(crossing.component, layers_of(crossing, grid.dims()), 2);
    }
    topology.index.for_each_active_cell([&](const CellIndex& cell, std::uint8_t pattern) {
      if (is_wanted && !is_wanted(cell)) return;
      is_simple(pattern) ? visit_simple(cell, pattern) : visit_any(cell, pattern);
    });
  }

 private:
  // One disk.
  void visit_simple(const CellIndex& cell, std::uint8_t pattern) {
    const std::uint32_t component = component_on(cell, std::countr_zero(crossed_edges(pattern)));
    visit_(component, top_of(cell), 2);
    for (unsigned faces = crossed_faces(pattern); faces != 0; faces &= faces - 1) {
      visit_arc(component, cell, std::countr_zero(faces));
    }
  }

  void visit_any(const CellIndex& cell, std::uint8_t pattern) {
    const CellCorners corners = grid_.cell(cell[0], cell[1], cell[2]);
    const CellSweep sweep(corners, isovalue_);
    std::array<bool, kMaxCellPieces> is_seen{};
    for (unsigned edges = crossed_edges(pattern); edges != 0; edges &= edges - 1) {
      const int edge = std::countr_zero(edges);
      const int piece = sweep.piece_of_edge(edge);
      if (std::exchange(is_seen[static_cast<std::size_t>(piece)], true)) continue;
      visit_(component_on(cell, edge), top_of(cell), 2 * sweep.euler_characteristic(piece));
    }
    for (int face = 0; face < kCellFaces; ++face) {
      const bool joined = is_ambiguous_face(pattern, face) && above_joined_on_face(corners, isovalue_, face);
      const CellFaceArcs arcs = arcs_on_cell_face(pattern, face, joined);
      for (std::size_t i = 0; i < static_cast<std::size_t>(arcs.count); ++i) {
        visit_arc(component_on(cell, arcs.from[i]), cell, face);
      }
    }
  }

  void visit_arc(std::uint32_t component, const CellIndex& cell, int face) {
    const auto axis = static_cast<std::size_t>(face / 2);
    SampleLayers at = top_of(cell);
    at[axis] = cell[axis] + face % 2;
    const bool is_on_box = at[axis] == 0 || at[axis] == grid_.dims()[axis] - 1;
    visit_(component, at, is_on_box ? -2 : -1);
  }

  static SampleLayers top_of(const CellIndex& cell) { return {cell[0] + 1, cell[1] + 1, cell[2] + 1}; }

  [[nodiscard]] std::uint32_t component_on(const CellIndex& cell, int edge) const {
    return topology_.crossings[topology_.index.number(cell, edge)].component;
  }

  const ScalarGrid& grid_;
  double isovalue_;
  const IsosurfaceTopology& topology_;
  Visit visit_;
};

}  // namespace

void for_each_exact_change(const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology,
                           const std::function<bool(const CellIndex&)>& is_wanted, const VisitChange& visit) {
  const ExactChanges changes(grid, isovalue, topology, is_wanted, std::cref(visit));
}

SurfaceSweeps::SurfaceSweeps(const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology)
    : dims_(grid.dims()) {
  find_layers(topology);
  const ExactChanges changes(
      grid, isovalue, topology, {}, [this](std::uint32_t component, const SampleLayers& at, std::int32_t twice) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Layers& layers = layers_[component][axis];
          twice_changes_[layers.begin + static_cast<std::size_t>(at[axis] - layers.first)] += twice;
        }
      });
}

// Those that the crossings of each component are in: arcs and pieces are in no other.
void SurfaceSweeps::find_layers(const IsosurfaceTopology& topology) {
  using Reach = std::pair<std::int32_t, std::int32_t>;
  std::vector<std::array<Reach, 3>> reach(topology.components.size());
  for (auto& along : reach) along.fill({std::numeric_limits<std::int32_t>::max(), 0});
  for (const EdgeCrossing& crossing : topology.crossings) {
    const SampleLayers at = layers_of(crossing, dims_);
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
      const auto& [first, last] = reach[c][axis];
      layers_[c][axis] = {total, first, last + 1 - first};
      total += static_cast<std::size_t>(last + 1 - first);
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

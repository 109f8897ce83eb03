#include "surface/repair/diagnosis/exact_euler_curves.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

#include "volume/topology/cell_crossings.h"
#include "volume/topology/cell_sweep.h"

namespace deliso {

namespace {

// Calls visit(crossing, layers) for the crossings on the edges from samples of a layer across z; `layers` are the first
// sample layers that are not below the crossing.
template <class Visit>
void for_each_crossing(const IsosurfaceTopology& topology, std::int32_t layer, const Visit& visit) {
  const CrossingIndex& index = topology.index;
  const auto length = static_cast<std::uint64_t>(index.dims()[0]), rows = static_cast<std::uint64_t>(index.dims()[1]);
  // Crossings come row by row, so the row of a sample is tracked instead of computed by division.
  std::uint64_t first = static_cast<std::uint64_t>(layer) * rows * length;  // first sample of the row
  std::int32_t row = 0;
  const std::uint32_t end = layer + 1 < index.dims()[2] ? index.first_number(0, 0, layer + 1) : index.crossing_count();
  for (std::uint32_t i = index.first_number(0, 0, layer); i < end; ++i) {
    const EdgeCrossing& crossing = topology.crossings[i];
    for (; crossing.sample >= first + length; first += length) ++row;
    SampleLayers layers = {static_cast<std::int32_t>(crossing.sample - first), row, layer};
    ++layers[crossing.axis];
    visit(crossing, layers);
  }
}

// The surface consists of crossings, of arcs on grid faces and of pieces in cells, whose Euler characteristics are 1,
// -1, and 1 or 0. An arc is visited together with the cell above it along the axis across its face; at the far side of
// the box, with the cell below. Passes everything visited to `Changes`: to add_disk() for the cells with a single disk,
// which are nearly all, and otherwise to add().
template <class Changes>
class ExactChanges {
 public:
  ExactChanges(const ExactSurface& surface, Changes& changes)
      : grid_(surface.grid()),
        isovalue_(surface.isosurface.isovalue()),
        topology_(surface.topology),
        crossings_(surface.topology.index),
        changes_(changes) {}

  // What lies between a layer of samples across z and the next one, and on the layer.
  void visit(std::int32_t layer) {
    for_each_crossing(topology_, layer, [&](const EdgeCrossing& crossing, const SampleLayers& at) {
      changes_.add(crossing.component, at, 2);
    });
    const std::int32_t last = std::min(layer + 1, topology_.index.cell_layers());
    topology_.index.for_each_active_cell(layer, last, [&](const CellIndex& cell, std::uint8_t pattern) {
      crossings_.move_to(cell);
      is_simple(pattern) ? visit_simple(cell, pattern) : visit_any(cell, pattern);
    });
  }

 private:
  void visit_simple(const CellIndex& cell, std::uint8_t pattern) {
    const std::uint32_t component = component_on(std::countr_zero(crossed_edges(pattern)));
    const unsigned faces = crossed_faces(pattern);
    changes_.add_disk(component, cell, {faces & 1u, faces >> 2 & 1u, faces >> 4 & 1u});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (is_last(cell, axis) && (faces >> (2 * axis + 1) & 1u) != 0) changes_.add(component, top_of(cell), -2);
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
      changes_.add(component_on(edge), top_of(cell), 2 * sweep.euler_characteristic(piece));
    }
    for (int face = 0; face < kCellFaces; ++face) {
      const auto axis = static_cast<std::size_t>(face / 2);
      if (face % 2 == 1 && !is_last(cell, axis)) continue;
      const bool joined = is_ambiguous_face(pattern, face) && above_joined_on_face(corners, isovalue_, face);
      const CellFaceArcs arcs = arcs_on_cell_face(pattern, face, joined);
      SampleLayers at = top_of(cell);
      at[axis] = cell[axis] + face % 2;
      for (std::size_t i = 0; i < static_cast<std::size_t>(arcs.count); ++i) {
        changes_.add(component_on(arcs.from[i]), at, -2);
      }
    }
  }

  static SampleLayers top_of(const CellIndex& cell) { return {cell[0] + 1, cell[1] + 1, cell[2] + 1}; }
  [[nodiscard]] bool is_last(const CellIndex& cell, std::size_t axis) const {
    return cell[axis] + 2 == grid_.dims()[axis];
  }
  [[nodiscard]] std::uint32_t component_on(int edge) const {
    return topology_.crossings[crossings_.number(edge)].component;
  }

  const ScalarGrid& grid_;
  double isovalue_;
  const IsosurfaceTopology& topology_;
  CellCrossings crossings_;  // of the current cell
  Changes& changes_;
};

// Passes all changes on one by one.
struct PassedOn {
  const VisitChange& visit;

  void add(std::uint32_t component, const SampleLayers& at, std::int32_t twice) const { visit(component, at, twice); }
  void add_disk(std::uint32_t component, const CellIndex& cell, const std::array<unsigned, 3>& has_arc_below) const {
    const SampleLayers top = {cell[0] + 1, cell[1] + 1, cell[2] + 1};
    visit(component, top, 2);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      SampleLayers at = top;
      at[axis] = cell[axis];
      if (has_arc_below[axis] != 0) visit(component, at, -2);
    }
  }
};

}  // namespace

void for_each_exact_change(const ExactSurface& surface, const std::vector<bool>& layers, const VisitChange& visit) {
  const PassedOn passed_on{visit};
  ExactChanges changes(surface, passed_on);
  for (std::size_t k = 0; k < layers.size(); ++k) {
    if (layers[k] || (k + 1 < layers.size() && layers[k + 1])) changes.visit(static_cast<std::int32_t>(k));
  }
}

// Adds up the changes by layer.
class ExactEulerCurves::Changes {
 public:
  explicit Changes(ExactEulerCurves& curves) : euler_curves_(curves) {}

  void add(std::uint32_t component, const SampleLayers& at, std::int32_t twice) {
    for (std::size_t axis = 0; axis < 3; ++axis) *from(component, axis, at[axis]) += twice;
  }
  // The disk counts from the upper layers of its cell on. An arc below the cell along an axis counts from the lower
  // layer along that axis on.
  void add_disk(std::uint32_t component, const CellIndex& cell, const std::array<unsigned, 3>& has_arc_below) {
    const auto arcs = static_cast<std::int32_t>(has_arc_below[0] + has_arc_below[1] + has_arc_below[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto below = static_cast<std::int32_t>(has_arc_below[axis]);
      std::int32_t* const twice = from(component, axis, cell[axis]);
      twice[0] -= 2 * below;
      twice[1] += 2 - 2 * (arcs - below);
    }
  }

 private:
  [[nodiscard]] std::int32_t* from(std::uint32_t component, std::size_t axis, std::int32_t layer) {
    const Layers& layers = euler_curves_.layers_[component][axis];
    return &euler_curves_.twice_changes_[layers.begin + static_cast<std::size_t>(layer - layers.first)];
  }

  ExactEulerCurves& euler_curves_;
};

ExactEulerCurves::ExactEulerCurves(const ExactSurface& surface) : dims_(surface.grid().dims()) {
  find_layers(surface.topology);
  Changes added(*this);
  ExactChanges changes(surface, added);
  for (std::int32_t k = 0; k < dims_[2]; ++k) changes.visit(k);
}

// Finds the layers of each component: those of its crossings, which are also those of its arcs and pieces, and the ones
// before.
void ExactEulerCurves::find_layers(const IsosurfaceTopology& topology) {
  using Reach = std::pair<std::int32_t, std::int32_t>;
  std::vector<std::array<Reach, 3>> reach(topology.components.size());
  for (auto& along : reach) along.fill({std::numeric_limits<std::int32_t>::max(), 0});
  const auto extend = [&](const EdgeCrossing& crossing, const SampleLayers& at) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto& [first, last] = reach[crossing.component][axis];
      first = std::min(first, std::max(at[axis] - 1, 0));
      last = std::max(last, at[axis]);
    }
  };
  for (std::int32_t k = 0; k < dims_[2]; ++k) for_each_crossing(topology, k, extend);
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

EulerCurves ExactEulerCurves::of(std::uint32_t component) const {
  EulerCurves swept;
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

// Where a point or a grid face meets the components of the isosurface.
#include <algorithm>
#include <cmath>
#include <limits>

#include "delaunay/base/check.h"
#include "volume/exact_topology.h"
#include "volume/exact_topology_cell.h"

namespace deliso {

namespace {

using Cell = std::array<std::int32_t, 3>;

constexpr double kNear = 1e-9;  // in voxels

// A face of the grid seen as a face of a cell.
struct CellFace {
  Cell cell{};
  int face = 0;
};

CellFace cell_face(const Dims& dims, const Cell& corner, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  CellFace result{corner, 2 * axis};
  if (corner[a] + 1 == dims[a]) {
    --result.cell[a];
    ++result.face;
  }
  return result;
}

std::uint32_t crossing_on(const CrossingIndex& index, const Cell& cell, int edge) {
  const CellEdge e = cell_edge(edge);
  return index.find(cell[0] + (e.corner & 1), cell[1] + (e.corner >> 1 & 1), cell[2] + (e.corner >> 2), e.axis);
}

std::uint8_t pattern_of(const CrossingIndex& index, const Cell& cell) {
  unsigned pattern = 0;
  for (int c = 0; c < 8; ++c) {
    if (index.above(cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2))) pattern |= 1u << c;
  }
  return static_cast<std::uint8_t>(pattern);
}

// Looks a point up: on a grid edge, then on a grid face, then in a cell.
class PointLookup {
 public:
  PointLookup(const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology, const Vec3& point)
      : grid_(grid), isovalue_(isovalue), topology_(topology), point_(point) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double limit = grid.dims()[a] - 1;
      point_[a] = std::clamp(point[a], 0.0, limit);
      const double nearest = std::nearbyint(point_[a]);
      on_plane_[a] = std::abs(point_[a] - nearest) <= kNear;
      plane_[a] = static_cast<std::int32_t>(nearest);
      cell_[a] = std::min(static_cast<std::int32_t>(point_[a]), grid.dims()[a] - 2);
    }
  }

  [[nodiscard]] std::optional<std::uint32_t> component() const {
    std::uint32_t crossing = on_edge();
    if (crossing == CrossingIndex::kNone) crossing = on_face();
    if (crossing == CrossingIndex::kNone) crossing = in_cells();
    if (crossing == CrossingIndex::kNone) return std::nullopt;
    return topology_.crossings[crossing].component;
  }

 private:
  [[nodiscard]] double distance_to(std::uint32_t crossing) const {
    return squared_distance(crossing_position(grid_, topology_.crossings[crossing]), point_);
  }
  void take_nearer(std::uint32_t crossing, std::uint32_t& best) const {
    if (crossing == CrossingIndex::kNone) return;
    if (best == CrossingIndex::kNone || distance_to(crossing) < distance_to(best)) best = crossing;
  }

  // The nearest crossing of the grid edges through the point.
  [[nodiscard]] std::uint32_t on_edge() const {
    std::uint32_t best = CrossingIndex::kNone;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!on_plane_[(axis + 1) % 3] || !on_plane_[(axis + 2) % 3]) continue;
      Cell sample = plane_;
      sample[axis] = cell_[axis];
      take_nearer(topology_.index.find(sample[0], sample[1], sample[2], static_cast<int>(axis)), best);
      if (!on_plane_[axis]) continue;
      sample[axis] = plane_[axis] == cell_[axis] ? cell_[axis] - 1 : plane_[axis];
      take_nearer(topology_.index.find(sample[0], sample[1], sample[2], static_cast<int>(axis)), best);
    }
    return best;
  }

  // A crossing on the same arc of a grid face through the point.
  [[nodiscard]] std::uint32_t on_face() const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!on_plane_[axis]) continue;
      Cell corner = cell_;
      corner[axis] = plane_[axis];
      const FaceArcs arcs = face_arcs(grid_, isovalue_, topology_, corner, static_cast<int>(axis));
      if (arcs.count == 1) return arcs.arcs[0].crossings[0];
      if (arcs.count == 2) return on_ambiguous_face(arcs, axis);
    }
    return CrossingIndex::kNone;
  }

  // Two arcs lie in opposite quadrants of the face's saddle; one of them ends on the side c = 0.
  [[nodiscard]] std::uint32_t on_ambiguous_face(const FaceArcs& arcs, std::size_t axis) const {
    const std::size_t b = (axis + 1) % 3;
    const std::size_t c = (axis + 2) % 3;
    const Cell& corner = arcs.arcs[0].corner;
    std::array<double, 4> f;
    for (std::size_t n = 0; n < 4; ++n) {
      Cell at = corner;
      at[b] += static_cast<std::int32_t>(n & 1);
      at[c] += static_cast<std::int32_t>(n >> 1);
      f[n] = grid_.at(at[0], at[1], at[2]) - isovalue_;
    }
    const double mixed = (f[0] - f[1]) + (f[3] - f[2]);
    const double db = point_[b] - corner[b] - (f[0] - f[2]) / mixed;
    const double dc = point_[c] - corner[c] - (f[0] - f[1]) / mixed;
    const std::uint32_t bottom = topology_.index.find(corner[0], corner[1], corner[2], static_cast<int>(b));
    const std::uint32_t left = topology_.index.find(corner[0], corner[1], corner[2], static_cast<int>(c));
    const bool bottom_arc_first = arcs.arcs[0].crossings[0] == bottom || arcs.arcs[0].crossings[1] == bottom;
    const FaceArc& bottom_arc = arcs.arcs[bottom_arc_first ? 0 : 1];
    const FaceArc& top_arc = arcs.arcs[bottom_arc_first ? 1 : 0];
    const bool cuts_corner = bottom_arc.crossings[0] == left || bottom_arc.crossings[1] == left;
    const bool on_bottom = cuts_corner ? db + dc < 0 : dc - db < 0;
    return (on_bottom ? bottom_arc : top_arc).crossings[0];
  }

  // A crossing on the same piece of the cell, or of a neighbour when the point lies on its border.
  [[nodiscard]] std::uint32_t in_cells() const {
    std::uint32_t nearest = CrossingIndex::kNone;
    for (unsigned side = 0; side < 8; ++side) {
      Cell cell = cell_;
      bool valid = true;
      for (std::size_t a = 0; a < 3; ++a) {
        if ((side >> a & 1u) == 0) continue;
        cell[a] += plane_[a] == cell_[a] ? -1 : 1;
        valid = valid && on_plane_[a] && cell[a] >= 0 && cell[a] + 1 < grid_.dims()[a];
      }
      if (!valid) continue;
      const std::uint32_t crossing = in_cell(cell);
      if (crossing != CrossingIndex::kNone) return crossing;
      for (int edge = 0; edge < kCellEdges; ++edge) take_nearer(crossing_on(topology_.index, cell, edge), nearest);
    }
    return nearest;
  }

  [[nodiscard]] std::uint32_t in_cell(const Cell& cell) const {
    const std::uint8_t pattern = pattern_of(topology_.index, cell);
    const std::uint16_t edges = crossed_edges(pattern);
    if (edges == 0) return CrossingIndex::kNone;
    if (is_simple(pattern)) return crossing_on(topology_.index, cell, std::countr_zero(edges));
    const CellSweep sweep(grid_.cell(cell[0], cell[1], cell[2]), isovalue_);
    const Vec3 base{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
    const int piece = sweep.pieces() == 1 ? 0 : sweep.piece_at(point_ - base);
    if (piece < 0) return CrossingIndex::kNone;
    int edge = 0;
    while (sweep.piece_of_edge(edge) != piece) ++edge;
    return crossing_on(topology_.index, cell, edge);
  }

  const ScalarGrid& grid_;
  double isovalue_;
  const IsosurfaceTopology& topology_;
  Vec3 point_;
  std::array<bool, 3> on_plane_{};  // of grid points, within kNear
  Cell plane_{};                    // the nearest one
  Cell cell_{};                     // a cell that holds the point
};

}  // namespace

Vec3 crossing_position(const ScalarGrid& grid, const EdgeCrossing& crossing) {
  const auto nx = static_cast<std::uint64_t>(grid.dims()[0]);
  const auto ny = static_cast<std::uint64_t>(grid.dims()[1]);
  Vec3 position{static_cast<double>(crossing.sample % nx), static_cast<double>(crossing.sample / nx % ny),
                static_cast<double>(crossing.sample / nx / ny)};
  position[crossing.axis] += crossing.t;
  return position;
}

std::optional<std::uint32_t> component_of(const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology,
                                          const Vec3& point) {
  DELISO_CHECK(is_finite(point), "a point of the surface has finite coordinates");
  return PointLookup(grid, isovalue, topology, point).component();
}

FaceArcs face_arcs(const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology,
                   const std::array<std::int32_t, 3>& corner, int axis) {
  const CellFace place = cell_face(grid.dims(), corner, axis);
  FaceArcs result;
  const std::uint8_t pattern = pattern_of(topology.index, place.cell);
  unsigned joined = 0;
  if (is_ambiguous_face(pattern, place.face)) {
    const CellCorners corners = grid.cell(place.cell[0], place.cell[1], place.cell[2]);
    joined = above_joined_on_face(corners, isovalue, place.face) ? 1u << place.face : 0u;
  }
  const CellFaceArcs arcs = arcs_on_cell_face(pattern, place.face, joined != 0);
  result.count = arcs.count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(arcs.count); ++i) {
    result.arcs[i] = {
        {crossing_on(topology.index, place.cell, arcs.from[i]), crossing_on(topology.index, place.cell, arcs.to[i])},
        corner,
        static_cast<std::uint8_t>(axis)};
  }
  return result;
}

std::vector<FaceArc> all_face_arcs(const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology) {
  std::vector<FaceArc> result;
  const Dims& dims = grid.dims();
  Cell corner{};
  for (corner[2] = 0; corner[2] < dims[2]; ++corner[2]) {
    for (corner[1] = 0; corner[1] < dims[1]; ++corner[1]) {
      for (corner[0] = 0; corner[0] < dims[0]; ++corner[0]) {
        for (int axis = 0; axis < 3; ++axis) {
          const auto b = static_cast<std::size_t>((axis + 1) % 3);
          const auto c = static_cast<std::size_t>((axis + 2) % 3);
          if (corner[b] + 1 == dims[b] || corner[c] + 1 == dims[c]) continue;
          const FaceArcs arcs = face_arcs(grid, isovalue, topology, corner, axis);
          result.insert(result.end(), arcs.arcs.begin(), arcs.arcs.begin() + arcs.count);
        }
      }
    }
  }
  return result;
}

}  // namespace deliso

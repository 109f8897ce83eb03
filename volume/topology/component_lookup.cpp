// Which component of the isosurface a point or an arc on a grid face belongs to.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "delaunay/base/check.h"
#include "volume/topology/cell_sweep.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

namespace {

constexpr double kNear = 1e-13;  // in voxels

// A face of the grid seen as a face of a cell.
struct CellFace {
  CellIndex cell{};
  int face = 0;
};

CellFace cell_face(const Dims& dims, const CellIndex& corner, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  CellFace result{corner, 2 * axis};
  if (corner[a] + 1 == dims[a]) {
    --result.cell[a];
    ++result.face;
  }
  return result;
}

std::uint32_t crossing_on(const CrossingIndex& index, const CellIndex& cell, int edge) {
  const CellEdge e = cell_edge(edge);
  return index.find(cell[0] + (e.corner & 1), cell[1] + (e.corner >> 1 & 1), cell[2] + (e.corner >> 2), e.axis);
}

std::uint8_t pattern_of(const CrossingIndex& index, const CellIndex& cell) {
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
    }
    if (grid.walls()) move_beyond_wall();
    for (std::size_t a = 0; a < 3; ++a) {
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
  // A point on a wall (filters/closing.h) stands for one of the surface that closes the volume just outside it, which
  // is moved to where it came from: on the wall itself it would be looked up in the cells within, where another
  // component may pass. On an edge or at a corner of the walls the cell just outside holds one piece.
  void move_beyond_wall() {
    constexpr double kOnWall = 0x1p-19, kBeyond = 0x1p-31;
    std::array<double, 3> outward{};  // 1 at the upper wall, -1 at the lower one
    for (std::size_t a = 0; a < 3; ++a) {
      const double upper = grid_.dims()[a] - 2;
      if (std::abs(point_[a] - 1) <= kOnWall) outward[a] = -1;
      if (std::abs(point_[a] - upper) <= kOnWall) outward[a] = 1;
      if (outward[a] != 0) point_[a] = outward[a] < 0 ? 1 : upper;
    }
    const auto walls = std::count_if(outward.begin(), outward.end(), [](double o) { return o != 0; });
    for (std::size_t a = 0; a < 3; ++a) {
      if (outward[a] != 0) point_[a] += outward[a] * (walls == 1 ? height_beyond_wall(a, outward[a]) : kBeyond);
    }
  }
  // How far above a point of the wall across an axis the isosurface passes, by the interpolant there and in the layer.
  [[nodiscard]] double height_beyond_wall(std::size_t axis, double outward) const {
    const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
    CellIndex at{};
    at[axis] = static_cast<std::int32_t>(point_[axis]);
    at[b] = std::min(static_cast<std::int32_t>(point_[b]), grid_.dims()[b] - 2);
    at[c] = std::min(static_cast<std::int32_t>(point_[c]), grid_.dims()[c] - 2);
    const double u = point_[b] - at[b], v = point_[c] - at[c];
    double value = 0;
    for (unsigned n = 0; n < 4; ++n) {
      CellIndex sample = at;
      sample[b] += static_cast<std::int32_t>(n & 1u);
      sample[c] += static_cast<std::int32_t>(n >> 1);
      const double weight = ((n & 1u) != 0 ? u : 1 - u) * (n >> 1 != 0 ? v : 1 - v);
      value += weight * (grid_.at(sample[0], sample[1], sample[2]) - isovalue_);
    }
    at[axis] += static_cast<std::int32_t>(outward);
    const double beyond = grid_.at(at[0], at[1], at[2]) - isovalue_;
    // Below 0, at a crease within rounding: where the wall meets the surface within. Above 1, or without a value: where
    // no surface passes, as of any point of a mesh that lies elsewhere.
    const double height = value / (value - beyond);
    return height > 0 ? std::min(height, 1.0) : 0;
  }
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
      CellIndex sample = plane_;
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
      CellIndex corner = cell_;
      corner[axis] = plane_[axis];
      const FaceArcs arcs = face_arcs(grid_, isovalue_, topology_.index, corner, static_cast<int>(axis));
      if (arcs.count == 1) return arcs.arcs[0].crossings[0];
      if (arcs.count == 2) return on_ambiguous_face(arcs, axis);
    }
    return CrossingIndex::kNone;
  }

  // Two arcs lie in opposite quadrants of the face's saddle; only one of them has an end on the side c = 0.
  [[nodiscard]] std::uint32_t on_ambiguous_face(const FaceArcs& arcs, std::size_t axis) const {
    const std::size_t b = (axis + 1) % 3;
    const std::size_t c = (axis + 2) % 3;
    const CellIndex& corner = arcs.arcs[0].corner;
    std::array<double, 4> f;
    for (std::size_t n = 0; n < 4; ++n) {
      CellIndex at = corner;
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

  // A crossing on the piece of the cell that holds the point, or of a neighbour cell when the point lies on the border.
  [[nodiscard]] std::uint32_t in_cells() const {
    std::uint32_t nearest = CrossingIndex::kNone;
    for (unsigned side = 0; side < 8; ++side) {
      CellIndex cell = cell_;
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

  [[nodiscard]] std::uint32_t in_cell(const CellIndex& cell) const {
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
  std::array<bool, 3> on_plane_{};  // whether it is within kNear of a plane of grid points
  CellIndex plane_{};               // the nearest such plane
  CellIndex cell_{};                // a cell that holds the point
};

}  // namespace

std::optional<std::uint32_t> component_of(const ScalarGrid& grid, double isovalue, const IsosurfaceTopology& topology,
                                          const Vec3& point) {
  DELISO_CHECK(is_finite(point), "a point of the surface has finite coordinates");
  return PointLookup(grid, isovalue, topology, point).component();
}

FaceArcs face_arcs(const ScalarGrid& grid, double isovalue, const CrossingIndex& index, const CellIndex& corner,
                   int axis) {
  const CellFace place = cell_face(grid.dims(), corner, axis);
  const std::uint8_t pattern = pattern_of(index, place.cell);
  bool joined = false;
  if (is_ambiguous_face(pattern, place.face)) {
    joined = above_joined_on_face(grid.cell(place.cell[0], place.cell[1], place.cell[2]), isovalue, place.face);
  }
  const CellFaceArcs arcs = arcs_on_cell_face(pattern, place.face, joined);
  FaceArcs result;
  result.count = arcs.count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(arcs.count); ++i) {
    const std::uint32_t from = crossing_on(index, place.cell, arcs.from[i]);
    const std::uint32_t to = crossing_on(index, place.cell, arcs.to[i]);
    result.arcs[i] = {{from, to}, corner, static_cast<std::uint8_t>(axis)};
  }
  return result;
}

}  // namespace deliso

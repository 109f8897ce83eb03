#include "volume/exact_topology.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "delaunay/base/check.h"
#include "volume/exact_topology_cell.h"

namespace deliso {

namespace {

using Cell = std::array<std::int32_t, 3>;

// Disjoint sets of crossings; the representative of a set is its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    for (std::size_t i = 0; i < size; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }
  std::uint32_t find(std::uint32_t x) {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  // True when x and y were in different sets.
  bool unite(std::uint32_t x, std::uint32_t y) {
    x = find(x);
    y = find(y);
    if (x == y) return false;
    if (y < x) std::swap(x, y);
    parent_[y] = x;
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// The place of the zero on an edge with end values a and b minus the isovalue, inside (0, 1) whatever the rounding.
double edge_parameter(double low, double high, double isovalue) {
  double a = low - isovalue;
  double length = low - high;
  if (!std::isfinite(a) || !std::isfinite(length)) {
    a = low / 2 - isovalue / 2;
    length = low / 2 - high / 2;
  }
  return std::clamp(a / length, std::numeric_limits<double>::min(), 1 - std::numeric_limits<double>::epsilon() / 2);
}

IsosurfaceTopology empty_result(const ScalarGrid& grid, double isovalue) {
  IsosurfaceTopology result;
  result.index = CrossingIndex(grid, isovalue);
  return result;
}

class TopologyBuilder {
 public:
  TopologyBuilder(const ScalarGrid& grid, double isovalue)
      : grid_(grid),
        isovalue_(isovalue),
        dims_(grid.dims()),
        result_(empty_result(grid, isovalue)),
        sets_(result_.index.crossing_count()) {}

  IsosurfaceTopology build();

 private:
  void list_crossings();
  template <class Sample>
  void list_crossings_in_word(const Sample* samples, std::int32_t w, std::int32_t j, std::int32_t k);
  void join_cells();
  void join_cells_in_word(std::int32_t w, std::int32_t j, std::int32_t k);
  void join_simple_cell(const Cell& cell, std::uint8_t pattern);
  void join_cell(const Cell& cell, std::uint8_t pattern);
  [[nodiscard]] std::uint32_t crossing_on(const Cell& cell, int edge) const;
  void number_components();
  void count_boundary_loops();
  template <class Visit>
  void for_each_outer_face(const Visit& visit) const;

  const ScalarGrid& grid_;
  double isovalue_;
  Dims dims_;
  IsosurfaceTopology result_;
  DisjointSets sets_;
  // Crossing -> twice its share of the Euler characteristic: that of cell pieces filed under it, plus 1 for itself,
  // minus half an arc for each grid face at its edge.
  std::vector<std::int32_t> twice_euler_;
};

IsosurfaceTopology TopologyBuilder::build() {
  list_crossings();
  join_cells();
  number_components();
  count_boundary_loops();
  return std::move(result_);
}

// --- Crossings ------------------------------------------------------------------------------------------------------

void TopologyBuilder::list_crossings() {
  result_.crossings.reserve(result_.index.crossing_count());
  twice_euler_.reserve(result_.index.crossing_count());
  std::visit(
      [&](const auto& samples) {
        for (std::int32_t k = 0; k < dims_[2]; ++k) {
          for (std::int32_t j = 0; j < dims_[1]; ++j) {
            for (std::int32_t w = 0; w < result_.index.words_per_row(); ++w)
              list_crossings_in_word(samples.data(), w, j, k);
          }
        }
      },
      grid_.samples());
}

template <class Sample>
void TopologyBuilder::list_crossings_in_word(const Sample* samples, std::int32_t w, std::int32_t j, std::int32_t k) {
  const std::array<std::uint64_t, 3> crossed = result_.index.crossed(w, j, k);
  const std::array<std::size_t, 3> stride{1, grid_.index(0, 1, 0), grid_.index(0, 0, 1)};
  for (std::uint64_t left = crossed[0] | crossed[1] | crossed[2]; left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    const std::array<std::int32_t, 3> at{w * CrossingIndex::kWordBits + bit, j, k};
    const std::size_t sample = grid_.index(at[0], at[1], at[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if ((crossed[axis] >> bit & 1u) == 0) continue;
      const double t = edge_parameter(static_cast<double>(samples[sample]),
                                      static_cast<double>(samples[sample + stride[axis]]), isovalue_);
      result_.crossings.push_back({sample, static_cast<std::uint8_t>(axis), 0, t});
      // Two grid faces meet at an edge of the box, three at an edge on a face of the box, four inside.
      int faces = 0;
      for (const std::size_t other : {(axis + 1) % 3, (axis + 2) % 3}) {
        faces += (at[other] > 0 ? 1 : 0) + (at[other] + 1 < dims_[other] ? 1 : 0);
      }
      twice_euler_.push_back(2 - faces);
    }
  }
}

std::uint32_t TopologyBuilder::crossing_on(const Cell& cell, int edge) const {
  const CellEdge e = cell_edge(edge);
  return result_.index.number(cell[0] + (e.corner & 1), cell[1] + (e.corner >> 1 & 1), cell[2] + (e.corner >> 2),
                              e.axis);
}

// --- Cells ----------------------------------------------------------------------------------------------------------

void TopologyBuilder::join_cells() {
  for (std::int32_t k = 0; k + 1 < dims_[2]; ++k) {
    for (std::int32_t j = 0; j + 1 < dims_[1]; ++j) {
      for (std::int32_t w = 0; w < result_.index.words_per_row(); ++w) join_cells_in_word(w, j, k);
    }
  }
}

void TopologyBuilder::join_cells_in_word(std::int32_t w, std::int32_t j, std::int32_t k) {
  // Bit b of corners[c]: corner c of the word's b-th cell lies above the isovalue.
  std::array<std::uint64_t, 8> corners;
  std::uint64_t any = 0;
  std::uint64_t all = ~std::uint64_t{0};
  for (std::size_t row = 0; row < 4; ++row) {
    const auto dj = static_cast<std::int32_t>(row & 1);
    const auto dk = static_cast<std::int32_t>(row >> 1);
    corners[2 * row] = result_.index.word(w, j + dj, k + dk);
    corners[2 * row + 1] = result_.index.next_word(w, j + dj, k + dk);
    any |= corners[2 * row] | corners[2 * row + 1];
    all &= corners[2 * row] & corners[2 * row + 1];
  }
  // Visit the cells whose corners do not all lie on one side.
  for (std::uint64_t active = any & ~all & result_.index.cells_in_word(w); active != 0; active &= active - 1) {
    const int bit = std::countr_zero(active);
    unsigned pattern = 0;
    for (std::size_t c = 0; c < 8; ++c) pattern |= static_cast<unsigned>(corners[c] >> bit & 1u) << c;
    const Cell cell{w * CrossingIndex::kWordBits + bit, j, k};
    if (is_simple(static_cast<std::uint8_t>(pattern))) {
      join_simple_cell(cell, static_cast<std::uint8_t>(pattern));
    } else {
      join_cell(cell, static_cast<std::uint8_t>(pattern));
    }
  }
}

// One disk through all crossings of the cell.
void TopologyBuilder::join_simple_cell(const Cell& cell, std::uint8_t pattern) {
  unsigned edges = crossed_edges(pattern);
  const std::uint32_t first = crossing_on(cell, std::countr_zero(edges));
  twice_euler_[first] += 2;
  for (edges &= edges - 1; edges != 0; edges &= edges - 1) {
    sets_.unite(first, crossing_on(cell, std::countr_zero(edges)));
  }
}

void TopologyBuilder::join_cell(const Cell& cell, std::uint8_t pattern) {
  const CellSweep sweep(grid_.cell(cell[0], cell[1], cell[2]), isovalue_);
  if (sweep.singular()) result_.singular_cells.push_back(cell);
  std::array<std::uint32_t, kMaxCellPieces> first;
  first.fill(CrossingIndex::kNone);
  for (unsigned edges = crossed_edges(pattern); edges != 0; edges &= edges - 1) {
    const int edge = std::countr_zero(edges);
    const int piece = sweep.piece_of_edge(edge);
    const std::uint32_t crossing = crossing_on(cell, edge);
    std::uint32_t& start = first[static_cast<std::size_t>(piece)];
    if (start == CrossingIndex::kNone) {
      start = crossing;
      twice_euler_[start] += 2 * sweep.euler_characteristic(piece);
    } else {
      sets_.unite(start, crossing);
    }
  }
  for (int i = 0; i < sweep.saddle_count(); ++i) {
    // Until components are numbered, a saddle remembers a crossing of its piece.
    const Vec3 base{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
    result_.saddles.push_back(
        {cell, base + sweep.saddle(i).uvw, first[static_cast<std::size_t>(sweep.saddle(i).piece)]});
  }
}

// --- Components -----------------------------------------------------------------------------------------------------

void TopologyBuilder::number_components() {
  std::vector<std::int64_t> twice_euler;
  for (std::uint32_t c = 0; c < result_.index.crossing_count(); ++c) {
    // A representative is the first crossing of its component.
    const std::uint32_t representative = sets_.find(c);
    if (representative == c) {
      result_.crossings[c].component = static_cast<std::uint32_t>(twice_euler.size());
      twice_euler.push_back(0);
    }
    const std::uint32_t component = result_.crossings[representative].component;
    result_.crossings[c].component = component;
    twice_euler[component] += twice_euler_[c];
  }
  for (const std::int64_t twice : twice_euler) {
    DELISO_CHECK(twice % 2 == 0, "half arcs come in pairs");
    result_.components.push_back({twice / 2, 0});
  }
  for (SurfaceSaddle& saddle : result_.saddles) saddle.component = result_.crossings[saddle.component].component;
}

// Calls visit(corner, axis) for every grid face on the box.
template <class Visit>
void TopologyBuilder::for_each_outer_face(const Visit& visit) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t b = (axis + 1) % 3;
    const std::size_t c = (axis + 2) % 3;
    for (const std::int32_t plane : {0, dims_[axis] - 1}) {
      Cell corner{};
      corner[axis] = plane;
      for (corner[c] = 0; corner[c] + 1 < dims_[c]; ++corner[c]) {
        for (corner[b] = 0; corner[b] + 1 < dims_[b]; ++corner[b]) visit(corner, static_cast<int>(axis));
      }
    }
  }
}

// On the box every crossing has two arcs, so the loops are the connected sets of crossings joined by outer arcs: as
// many as crossings on the box minus the arcs that joined two sets.
void TopologyBuilder::count_boundary_loops() {
  DisjointSets sets(0);
  std::vector<bool> seen;
  const auto count_crossing = [&](std::uint32_t crossing) {
    if (seen[crossing]) return;
    seen[crossing] = true;
    ++result_.components[result_.crossings[crossing].component].boundary_loops;
  };
  const CrossingIndex& index = result_.index;
  for_each_outer_face([&](const Cell& corner, int axis) {
    Cell across = corner;  // the face's corners in the two other directions
    const auto b = static_cast<std::size_t>((axis + 1) % 3);
    const auto c = static_cast<std::size_t>((axis + 2) % 3);
    unsigned above = 0;
    for (unsigned n = 0; n < 4; ++n) {
      across[b] = corner[b] + static_cast<std::int32_t>(n & 1);
      across[c] = corner[c] + static_cast<std::int32_t>(n >> 1);
      above |= index.above(across[0], across[1], across[2]) ? 1u << n : 0u;
    }
    if (above == 0 || above == 0xFu) return;
    if (seen.empty()) {
      seen.resize(result_.crossings.size());
      sets = DisjointSets(result_.crossings.size());
    }
    const FaceArcs arcs = face_arcs(grid_, isovalue_, result_, corner, axis);
    for (std::size_t i = 0; i < static_cast<std::size_t>(arcs.count); ++i) {
      const auto [from, to] = arcs.arcs[i].crossings;
      count_crossing(from);
      count_crossing(to);
      if (sets.unite(from, to)) --result_.components[result_.crossings[from].component].boundary_loops;
    }
  });
}

}  // namespace

IsosurfaceTopology exact_topology(const ScalarGrid& grid, double isovalue) {
  DELISO_CHECK(std::isfinite(isovalue), "an isovalue is a finite number");
  return TopologyBuilder(grid, isovalue).build();
}

}  // namespace deliso

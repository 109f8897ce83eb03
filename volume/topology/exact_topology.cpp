#include "volume/topology/exact_topology.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/base/disjoint_sets.h"
#include "delaunay/base/parallel.h"
#include "volume/regular_isovalue.h"
#include "volume/topology/cell_crossings.h"
#include "volume/topology/cell_sweep.h"

namespace deliso {

namespace {

// The Euler characteristic of a component is the sum over its pieces of their own, minus the arcs, plus the crossings.
// A piece has as many arcs as crossings on its cell's boundary. An arc belongs to two cells, or to one when it lies on
// the box. So twice the Euler characteristic of a component is the sum of (2 x that of the piece - crossings of the
// piece) over the pieces, plus 2 for every crossing, minus 1 for every arc on the box.
class TopologyBuilder {
 public:
  TopologyBuilder(const ScalarGrid& grid, double isovalue, CrossingIndex index, int threads)
      : grid_(grid), isovalue_(isovalue), threads_(threads) {
    const std::size_t count = index.crossing_count();
    // Both at the same time: most of the time goes into waiting for fresh pages.
    run_tasks(2, threads, [&](std::size_t task) {
      if (task == 0) sets_.reset(count);
      if (task == 1) twice_euler_of_crossing_.assign(count, 2);
    });
    result_.index = std::move(index);
  }

  IsosurfaceTopology build() {
    result_.crossings = list_crossings(grid_, isovalue_, result_.index, threads_);
    join_cells();
    number_components();
    count_on_box();
    for (std::size_t i = 0; i < result_.components.size(); ++i) {
      DELISO_CHECK(twice_euler_[i] % 2 == 0, "half arcs come in pairs");
      result_.components[i].euler_characteristic = twice_euler_[i] / 2;
    }
    return std::move(result_);
  }

 private:
  // What some layers of cells contribute, in the order of the cells.
  struct Found {
    std::vector<SurfaceSaddle> saddles;
    std::vector<CellIndex> singular_cells;
  };

  void join_cells();
  void join_layers(std::int32_t first, std::int32_t last, Found& found);
  void join_simple_cell(const CellCrossings& crossings, std::uint8_t pattern);
  void join_cell(const CellIndex& cell, const CellCrossings& crossings, std::uint8_t pattern, Found& found);
  [[nodiscard]] bool passes_through(const CellIndex& cell, int face) const;
  void number_components();
  void count_on_box();
  template <class Visit>
  void for_each_face_on_box(const Visit& visit) const;

  const ScalarGrid& grid_;
  double isovalue_;
  int threads_;
  DisjointSets sets_;                                 // of crossings
  LargeArray<std::int32_t> twice_euler_of_crossing_;  // its own share, and that of the cell pieces counted at it
  std::vector<std::int64_t> twice_euler_;             // of the components
  IsosurfaceTopology result_;
};

// The cells of a slab except its last layer join only crossings that start from the slab's own samples. So slabs are
// joined independently of each other, and the layers between them afterwards.
void TopologyBuilder::join_cells() {
  const std::int32_t layers = result_.index.cell_layers();
  std::vector<std::array<Found, 2>> found(slab_count(layers));
  for_each_slab(layers, threads_, [&](std::size_t slab, std::int32_t first, std::int32_t last) {
    join_layers(first, last - 1, found[slab][0]);
  });
  for_each_slab(layers, 1, [&](std::size_t slab, std::int32_t, std::int32_t last) {
    join_layers(last - 1, last, found[slab][1]);
  });
  for (const auto& slab : found) {
    for (const Found& some : slab) {
      result_.saddles.insert(result_.saddles.end(), some.saddles.begin(), some.saddles.end());
      result_.singular_cells.insert(result_.singular_cells.end(), some.singular_cells.begin(),
                                    some.singular_cells.end());
    }
  }
}

void TopologyBuilder::join_layers(std::int32_t first, std::int32_t last, Found& found) {
  CellCrossings crossings(result_.index);
  result_.index.for_each_active_cell(first, last, [&](const CellIndex& cell, std::uint8_t pattern) {
    crossings.move_to(cell);
    if (is_simple(pattern)) {
      join_simple_cell(crossings, pattern);
    } else {
      join_cell(cell, crossings, pattern, found);
    }
  });
}

// One disk through all crossings of the cell.
void TopologyBuilder::join_simple_cell(const CellCrossings& crossings, std::uint8_t pattern) {
  unsigned edges = crossed_edges(pattern);
  std::uint32_t representative = sets_.find(crossings.number(std::countr_zero(edges)));
  std::int32_t twice_euler = 1;
  for (edges &= edges - 1; edges != 0; edges &= edges - 1) {
    representative = sets_.unite_representative(representative, crossings.number(std::countr_zero(edges)));
    --twice_euler;
  }
  twice_euler_of_crossing_[representative] += twice_euler;
}

void TopologyBuilder::join_cell(const CellIndex& cell, const CellCrossings& crossings, std::uint8_t pattern,
                                Found& found) {
  const CellSweep sweep(grid_.cell(cell[0], cell[1], cell[2]), isovalue_);
  bool singular = sweep.singular_inside();
  for (unsigned faces = sweep.saddle_faces(); faces != 0; faces &= faces - 1) {
    singular = singular || !passes_through(cell, std::countr_zero(faces));
  }
  if (singular) found.singular_cells.push_back(cell);
  std::array<std::uint32_t, kMaxCellPieces> first;
  first.fill(CrossingIndex::kNone);
  for (unsigned edges = crossed_edges(pattern); edges != 0; edges &= edges - 1) {
    const int edge = std::countr_zero(edges);
    const int piece = sweep.piece_of_edge(edge);
    const std::uint32_t crossing = crossings.number(edge);
    std::uint32_t& start = first[static_cast<std::size_t>(piece)];
    if (start == CrossingIndex::kNone) {
      start = crossing;
      twice_euler_of_crossing_[start] += 2 * sweep.euler_characteristic(piece);
    }
    sets_.unite(start, crossing);
    --twice_euler_of_crossing_[start];
  }
  const Vec3 base{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])};
  for (int i = 0; i < sweep.saddle_count(); ++i) {
    // Until components are numbered, a saddle stores a crossing of its piece.
    const auto piece = static_cast<std::size_t>(sweep.saddle(i).piece);
    found.saddles.push_back({cell, base + sweep.saddle(i).uvw, first[piece]});
  }
}

// Whether the surface passes from cell to cell at a saddle of a face that lies exactly at the isovalue. Then the
// surface is a graph over the face there, and the point is regular. Otherwise two sheets touch in that point.
bool TopologyBuilder::passes_through(const CellIndex& cell, int face) const {
  const auto axis = static_cast<std::size_t>(face / 2);
  CellIndex neighbour = cell;
  neighbour[axis] += face % 2 == 1 ? 1 : -1;
  if (neighbour[axis] < 0 || neighbour[axis] + 1 >= grid_.dims()[axis]) return false;
  const auto slope = [&](const CellIndex& at, int side) {
    return saddle_slope_into_cell(grid_.cell(at[0], at[1], at[2]), isovalue_, side);
  };
  return slope(cell, face) * slope(neighbour, face ^ 1) < 0;
}

void TopologyBuilder::number_components() {
  for (std::uint32_t c = 0; c < result_.crossings.size(); ++c) {
    // A representative is the first crossing of its component.
    const std::uint32_t representative = sets_.find(c);
    if (representative == c) {
      result_.crossings[c].component = static_cast<std::uint32_t>(twice_euler_.size());
      twice_euler_.push_back(0);
    }
    const std::uint32_t component = result_.crossings[representative].component;
    result_.crossings[c].component = component;
    twice_euler_[component] += twice_euler_of_crossing_[c];
  }
  result_.components.resize(twice_euler_.size());
  for (SurfaceSaddle& saddle : result_.saddles) saddle.component = result_.crossings[saddle.component].component;
}

// Calls visit(corner, axis) for the grid faces on the box that have corners on both sides.
template <class Visit>
void TopologyBuilder::for_each_face_on_box(const Visit& visit) const {
  const Dims& dims = grid_.dims();
  const CrossingIndex& index = result_.index;
  // Faces across x are visited one by one, faces along x 64 at a time.
  for (const std::int32_t i : {0, dims[0] - 1}) {
    for (std::int32_t k = 0; k + 1 < dims[2]; ++k) {
      for (std::int32_t j = 0; j + 1 < dims[1]; ++j) {
        const bool first = index.above(i, j, k);
        if (index.above(i, j + 1, k) == first && index.above(i, j, k + 1) == first &&
            index.above(i, j + 1, k + 1) == first) {
          continue;
        }
        visit(CellIndex{i, j, k}, 0);
      }
    }
  }
  for (const std::size_t axis : {1u, 2u}) {
    const std::size_t along = 3 - axis;  // the axis within the face other than x
    for (const std::int32_t plane : {0, dims[axis] - 1}) {
      CellIndex corner{};
      corner[axis] = plane;
      for (corner[along] = 0; corner[along] + 1 < dims[along]; ++corner[along]) {
        CellIndex next = corner;
        ++next[along];
        for (std::int32_t w = 0; w < index.words_per_row(); ++w) {
          const std::uint64_t first = index.word(w, corner[1], corner[2]);
          const std::uint64_t mixed = (first ^ index.next_word(w, corner[1], corner[2])) |
                                      (first ^ index.word(w, next[1], next[2])) |
                                      (first ^ index.next_word(w, next[1], next[2]));
          for (std::uint64_t left = mixed & index.cells_in_word(w); left != 0; left &= left - 1) {
            corner[0] = w * CrossingIndex::kWordBits + std::countr_zero(left);
            visit(corner, static_cast<int>(axis));
          }
        }
      }
    }
  }
}

// The arcs on the box. Every crossing on the box ends two of them, so the loops are the sets of crossings that arcs
// join. Their number is the number of crossings on the box, minus the number of arcs that joined two sets.
void TopologyBuilder::count_on_box() {
  DisjointSets sets;
  std::vector<bool> seen;
  const auto add_arc = [&](std::uint32_t from, std::uint32_t to) {
    const std::uint32_t component = result_.crossings[from].component;
    --twice_euler_[component];
    for (const std::uint32_t crossing : {from, to}) {
      if (!seen[crossing]) ++result_.components[component].boundary_loops;
      seen[crossing] = true;
    }
    if (sets.unite(from, to)) --result_.components[component].boundary_loops;
  };
  for_each_face_on_box([&](const CellIndex& corner, int axis) {
    if (seen.empty()) {
      seen.resize(result_.crossings.size());
      sets.reset(result_.crossings.size());
    }
    const FaceArcs arcs = face_arcs(grid_, isovalue_, result_.index, corner, axis);
    for (std::size_t i = 0; i < static_cast<std::size_t>(arcs.count); ++i) {
      add_arc(arcs.arcs[i].crossings[0], arcs.arcs[i].crossings[1]);
    }
  });
}

}  // namespace

IsosurfaceTopology exact_topology(const ScalarGrid& grid, double isovalue, int threads) {
  DELISO_CHECK(std::isfinite(isovalue), "an isovalue is a finite number");
  return TopologyBuilder(grid, isovalue, CrossingIndex(grid, isovalue, threads), threads).build();
}

RegularTopology regular_topology(const ScalarGrid& grid, double isovalue, int threads) {
  constexpr int kLowerings = 3;
  RegularTopology result;
  result.isovalue = regular_isovalue(grid, isovalue);
  result.topology = exact_topology(grid, result.isovalue, threads);
  for (int i = 0; i < kLowerings && !result.topology.singular_cells.empty(); ++i) {
    result.isovalue = lowered_isovalue(grid, result.isovalue);
    result.topology = exact_topology(grid, result.isovalue, threads);
  }
  return result;
}

}  // namespace deliso

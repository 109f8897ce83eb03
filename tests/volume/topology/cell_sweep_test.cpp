// The pieces of the surface inside one cell: against a fine lattice, and against the sweep along other axes.
#include "volume/topology/cell_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "delaunay/base/rng.h"
#include "tests/support/topology_grids.h"
#include "tests/support/topology_oracle.h"
#include "volume/trilinear_cell.h"

namespace deliso {
namespace {

CellCorners corners_of(const test::IntegerGrid& cell) {
  CellCorners corners;
  for (std::size_t c = 0; c < 8; ++c) corners[c] = static_cast<double>(cell.samples[c]);
  return corners;
}

// Signs as in `pattern` around the isovalue -1/2, sizes up to `range`.
test::IntegerGrid random_cell(Rng& rng, unsigned pattern, std::int64_t range) {
  test::IntegerGrid cell{{2, 2, 2}, {}, -1};
  for (unsigned c = 0; c < 8; ++c) {
    const auto size = static_cast<std::int64_t>(rng.below(static_cast<std::uint64_t>(range)));
    cell.samples.push_back((pattern >> c & 1u) != 0 ? size : -1 - size);
  }
  return cell;
}

// A cell alone: its faces lie on the box.
bool is_degenerate(const CellSweep& sweep) { return sweep.singular_inside() || sweep.saddle_faces() != 0; }

// The loops of crossings on the cell's boundary.
std::vector<std::vector<int>> loops_of(const CellCorners& corners, double isovalue) {
  const std::uint8_t pattern = sign_pattern(corners, isovalue);
  unsigned joined = 0;
  for (int face = 0; face < kCellFaces; ++face) {
    if (above_joined_on_face(corners, isovalue, face)) joined |= 1u << face;
  }
  const EdgeSuccessors next = edge_successors(pattern, joined);
  std::vector<std::vector<int>> loops;
  std::array<bool, kCellEdges> seen{};
  for (int start = 0; start < kCellEdges; ++start) {
    if (next[static_cast<std::size_t>(start)] < 0 || seen[static_cast<std::size_t>(start)]) continue;
    loops.emplace_back();
    for (int edge = start; !seen[static_cast<std::size_t>(edge)]; edge = next[static_cast<std::size_t>(edge)]) {
      seen[static_cast<std::size_t>(edge)] = true;
      loops.back().push_back(edge);
    }
  }
  return loops;
}

// (Euler characteristic, loops) of the cell's pieces, sorted.
std::vector<ComponentTopology> piece_topologies(const CellCorners& corners, double isovalue) {
  const CellSweep sweep(corners, isovalue);
  std::vector<ComponentTopology> pieces(static_cast<std::size_t>(sweep.pieces()));
  for (int p = 0; p < sweep.pieces(); ++p)
    pieces[static_cast<std::size_t>(p)].euler_characteristic = sweep.euler_characteristic(p);
  for (const std::vector<int>& loop : loops_of(corners, isovalue)) {
    const int piece = sweep.piece_of_edge(loop.front());
    for (const int edge : loop) EXPECT_EQ(sweep.piece_of_edge(edge), piece);
    ++pieces[static_cast<std::size_t>(piece)].boundary_loops;
  }
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

// The lattice may be too coarse for thin necks: it is refined until it agrees, up to a limit.
bool agrees_with_lattice(const test::IntegerGrid& grid, const std::vector<ComponentTopology>& ours, int finest) {
  for (int n = 4; n <= finest; n *= 2) {
    if (test::lattice_topology(grid, n) == ours) return true;
  }
  return false;
}

TEST(CellSweep, AgreesWithAFineLatticeForEverySignPattern) {
  Rng rng(11);
  for (unsigned pattern = 0; pattern < 256; ++pattern) {
    for (const std::int64_t range : {2, 8, 1000}) {
      for (int i = 0; i < 4; ++i) {
        const test::IntegerGrid cell = random_cell(rng, pattern, range);
        if (is_degenerate(CellSweep(corners_of(cell), -0.5))) continue;
        ASSERT_TRUE(agrees_with_lattice(cell, piece_topologies(corners_of(cell), -0.5), 128))
            << "pattern " << pattern << ", range " << range << ", case " << i << " after seed 11";
      }
    }
  }
}

// Tunnels are rare among random values: take cells whose two opposite corners lie above and whose centre is near the
// isovalue.
TEST(CellSweep, AgreesWithAFineLatticeAroundTunnels) {
  Rng rng(12);
  std::map<std::size_t, int> seen;  // number of pieces -> cells
  for (int i = 0; i < 150; ++i) {
    test::IntegerGrid cell = random_cell(rng, rng.below(2) == 0 ? 0b10000001u : 0b01111110u, 40);
    const std::int64_t sign = cell.samples[0] >= 0 ? 1 : -1;
    cell.samples[0] += sign * static_cast<std::int64_t>(rng.below(80));
    cell.samples[7] += sign * static_cast<std::int64_t>(rng.below(80));
    if (is_degenerate(CellSweep(corners_of(cell), -0.5))) continue;
    const std::vector<ComponentTopology> pieces = piece_topologies(corners_of(cell), -0.5);
    ++seen[pieces.size()];
    ASSERT_TRUE(agrees_with_lattice(cell, pieces, 128)) << "case " << i << " after seed 12";
  }
  EXPECT_GT(seen[1], 20);
  EXPECT_GT(seen[2], 20);
}

// The sweep along another axis, or backwards, makes quite different decisions and must find the same pieces.
void expect_symmetric(const CellCorners& corners, double isovalue, const std::string& context) {
  const CellSweep sweep(corners, isovalue);
  for (const test::CubeSymmetry& symmetry : test::cube_symmetries()) {
    CellCorners moved;
    for (int c = 0; c < 8; ++c) {
      moved[static_cast<std::size_t>(c)] = corners[static_cast<std::size_t>(test::source_corner(symmetry, c))];
    }
    const CellSweep other(moved, isovalue);
    ASSERT_EQ(std::popcount(other.saddle_faces()), std::popcount(sweep.saddle_faces())) << context;
    if (sweep.saddle_faces() != 0) continue;
    ASSERT_EQ(other.singular_inside(), sweep.singular_inside()) << context;
    if (sweep.singular_inside()) continue;
    ASSERT_EQ(other.pieces(), sweep.pieces()) << context;
    std::array<int, kMaxCellPieces> image{-1, -1, -1, -1};
    for (int edge = 0; edge < kCellEdges; ++edge) {
      const CellEdge e = cell_edge(edge);
      const int source = edge_between(test::source_corner(symmetry, e.corner),
                                      test::source_corner(symmetry, e.corner + (1 << e.axis)));
      const int piece = sweep.piece_of_edge(source);
      ASSERT_EQ(other.piece_of_edge(edge) < 0, piece < 0) << context;
      if (piece < 0) continue;
      int& known = image[static_cast<std::size_t>(piece)];
      if (known < 0) known = other.piece_of_edge(edge);
      ASSERT_EQ(other.piece_of_edge(edge), known) << context;
      ASSERT_EQ(other.euler_characteristic(known), sweep.euler_characteristic(piece)) << context;
    }
  }
}

TEST(CellSweep, FindsTheSamePiecesAlongEveryAxis) {
  Rng rng(13);
  for (int i = 0; i < 8000; ++i) {
    CellCorners corners;
    const int kind = i % 4;
    for (double& f : corners) {
      const double sign = rng.below(2) == 0 ? 1 : -1;
      if (kind == 0) f = rng.uniform(-1, 1);
      if (kind == 1) f = sign * static_cast<double>(1 + rng.below(3));              // ties everywhere
      if (kind == 2) f = sign * (1 + 0x1p-52 * static_cast<double>(rng.below(4)));  // ties but for rounding
      if (kind == 3) f = sign * std::ldexp(1 + rng.uniform(), static_cast<int>(rng.below(2000)) - 1000);  // any size
    }
    expect_symmetric(corners, 0, "case " + std::to_string(i) + " after seed 13");
    if (HasFatalFailure()) return;
  }
}

// With an isovalue that does not subtract exactly from the samples, f = sample - isovalue has more than 53 bits.
TEST(CellSweep, FindsTheSamePiecesAlongEveryAxisWhenTheDifferencesRound) {
  Rng rng(14);
  for (int i = 0; i < 2000; ++i) {
    CellCorners corners;
    const double isovalue = 1 + 0x1p-52 * static_cast<double>(1 + rng.below(7));
    for (double& sample : corners) {
      const double tiny = std::ldexp(1 + rng.uniform(), -60);
      sample = rng.below(2) == 0 ? tiny * static_cast<double>(rng.below(3))
                                 : 2 + 0x1p-51 * static_cast<double>(rng.below(3));
    }
    expect_symmetric(corners, isovalue, "case " + std::to_string(i) + " after seed 14");
    if (HasFatalFailure()) return;
  }
}

TEST(CellSweep, ANegatedFieldHasTheSamePieces) {
  Rng rng(15);
  for (int i = 0; i < 5000; ++i) {
    CellCorners corners;
    for (double& f : corners) f = rng.uniform(-1, 1);
    CellCorners negated;
    std::transform(corners.begin(), corners.end(), negated.begin(), [](double f) { return -f; });
    ASSERT_EQ(piece_topologies(corners, 0), piece_topologies(negated, 0)) << "case " << i << " after seed 15";
  }
}

TEST(CellSweep, EveryPieceIsADiskOrATunnelAndASimplePatternOneDisk) {
  Rng rng(16);
  for (int i = 0; i < 50000; ++i) {
    CellCorners corners;
    for (double& f : corners) f = rng.uniform(-1, 1);
    const std::vector<ComponentTopology> pieces = piece_topologies(corners, 0);
    for (const ComponentTopology& piece : pieces) {
      ASSERT_TRUE((piece == ComponentTopology{1, 1}) || (piece == ComponentTopology{0, 2})) << "case " << i;
    }
    const std::uint8_t pattern = sign_pattern(corners, 0);
    if (!is_simple(pattern)) continue;
    ASSERT_EQ(pieces.size(), crossed_edges(pattern) == 0 ? 0u : 1u) << "case " << i;
  }
}

TEST(CellSweep, MostPatternsAreSimple) {
  int simple = 0;
  for (unsigned pattern = 0; pattern < 256; ++pattern) simple += is_simple(static_cast<std::uint8_t>(pattern)) ? 1 : 0;
  // 256 patterns less those with an ambiguous face and less the 8 with two opposite corners apart.
  int ambiguous = 0;
  for (unsigned pattern = 0; pattern < 256; ++pattern) {
    bool any = false;
    for (int face = 0; face < kCellFaces; ++face)
      any = any || is_ambiguous_face(static_cast<std::uint8_t>(pattern), face);
    ambiguous += any ? 1 : 0;
  }
  EXPECT_EQ(simple, 256 - ambiguous - 8);
}

// A point of the surface belongs to the same piece whichever axis is swept.
TEST(CellSweep, LooksAPointUpAlikeAlongEveryAxis) {
  Rng rng(19);
  int checked = 0;
  for (int i = 0; i < 20000; ++i) {
    CellCorners corners;
    for (double& f : corners) f = rng.uniform(-1, 1);
    const CellSweep sweep(corners, 0);
    if (sweep.pieces() < 2) continue;
    // The surface's point on a random line along w.
    const double u = rng.uniform(0.01, 0.99);
    const double v = rng.uniform(0.01, 0.99);
    const double below = trilinear_value(corners, {u, v, 0});
    const double above = trilinear_value(corners, {u, v, 1});
    if ((below > 0) == (above > 0)) continue;
    const Vec3 point{u, v, below / (below - above)};
    const int piece = sweep.piece_at(point);
    ASSERT_GE(piece, 0) << "case " << i << " after seed 19";
    // Sweep along u: (v, w, u).
    const test::CubeSymmetry cycle{{1, 2, 0}, {}};
    CellCorners moved;
    for (int c = 0; c < 8; ++c)
      moved[static_cast<std::size_t>(c)] = corners[static_cast<std::size_t>(test::source_corner(cycle, c))];
    const CellSweep other(moved, 0);
    const int image = other.piece_at({point.y, point.z, point.x});
    ASSERT_GE(image, 0) << "case " << i << " after seed 19";
    for (int edge = 0; edge < kCellEdges; ++edge) {
      if (other.piece_of_edge(edge) != image) continue;
      const CellEdge e = cell_edge(edge);
      const int source =
          edge_between(test::source_corner(cycle, e.corner), test::source_corner(cycle, e.corner + (1 << e.axis)));
      ASSERT_EQ(sweep.piece_of_edge(source), piece) << "case " << i << " after seed 19";
    }
    ++checked;
  }
  EXPECT_GT(checked, 1000);
}

}  // namespace
}  // namespace deliso

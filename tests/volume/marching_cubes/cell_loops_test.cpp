#include "volume/marching_cubes/cell_loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "volume/marching_cubes/marching_cubes.h"

namespace deliso {
namespace {

TEST(CellLoops, EdgesShareAFaceWhenItHasAllTheirCorners) {
  for (int a = 0; a < kCellEdges; ++a) {
    for (int b = 0; b < kCellEdges; ++b) {
      bool expected = false;
      for (int face = 0; face < kCellFaces; ++face) {
        const std::array<int, 4> corners = face_corners(face);
        const auto has = [&](int corner) { return std::find(corners.begin(), corners.end(), corner) != corners.end(); };
        const auto contains = [&](int edge) {
          const CellEdge e = cell_edge(edge);
          return has(e.corner) && has(e.corner + (1 << e.axis));
        };
        expected |= contains(a) && contains(b);
      }
      EXPECT_EQ(have_common_face(a, b), expected) << a << " and " << b;
    }
  }
}

// Whatever the faces decide: each crossing lies on one loop, and neighbours on a loop share a face.
TEST(CellLoops, PartitionTheCrossings) {
  for (unsigned pattern = 1; pattern < 255; ++pattern) {
    for (unsigned joined = 0; joined < 1u << kCellFaces; ++joined) {
      const auto p = static_cast<std::uint8_t>(pattern);
      std::array<CellLoop, kMaxCellPieces> loops;
      const std::size_t count = split_into_loops(edge_successors(p, joined), loops);
      unsigned seen = 0;
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_GE(loops[i].size, 3u);
        for (std::size_t k = 0; k < loops[i].size; ++k) {
          const int edge = loops[i].edges[k];
          EXPECT_EQ(seen >> edge & 1u, 0u) << pattern;
          seen |= 1u << edge;
          EXPECT_TRUE(have_common_face(edge, loops[i].edges[(k + 1) % loops[i].size])) << pattern;
        }
      }
      EXPECT_EQ(seen, crossed_edges(p)) << pattern;
    }
  }
}

// The chords that a simple cell may draw depend on its signs alone: one cell of each pattern shows that they suffice.
TEST(CellLoops, OfSimpleCellsNeedNoInnerPoint) {
  int simple = 0;
  for (unsigned pattern = 1; pattern < 255; ++pattern) {
    const auto p = static_cast<std::uint8_t>(pattern);
    if (!is_simple(p)) continue;
    ++simple;
    std::vector<double> samples;
    for (int c = 0; c < 8; ++c) samples.push_back((pattern >> c & 1u) != 0 ? 1 : -1);
    const MarchingCubesMesh mesh = marching_cubes(ScalarGrid({2, 2, 2}, samples), 0);
    EXPECT_EQ(simple_loop(p).size, static_cast<std::size_t>(std::popcount(crossed_edges(p)))) << pattern;
    EXPECT_EQ(mesh.points.size(), mesh.crossing_count) << pattern;
    EXPECT_EQ(mesh.triangles.size(), mesh.crossing_count - 2) << pattern;
  }
  EXPECT_GT(simple, 100);
}

}  // namespace
}  // namespace deliso

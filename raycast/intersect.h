// Figure 12 of the paper (Dey and Levine, section 4) in plain code: the points in which a segment r meets the
// isosurface of a volume O at isovalue kappa.
//
//   Intersect(O, kappa, r):  V = CollectVoxels(O, kappa, r);  X = FindIntersections(V, kappa, r);  return X
//
// Isosurface::all_hits does both steps in one pass over the voxel cells, without recursion and without lists. It gives
// the same hits to the last bit (tests/raycast/intersect_test.cpp).
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "raycast/cell_hits.h"
#include "raycast/cell_walk.h"
#include "raycast/line_segment.h"
#include "raycast/min_max_kdtree.h"
#include "raycast/search_options.h"
#include "volume/scalar_grid.h"

namespace deliso {

// A node that the traversal comes to (Figure 13), and whether it is left at once because it cannot hold the isovalue.
struct NodeVisit {
  int level = 0;  // of the tree; a single cell has level 0 or less
  CellBlock block;
  bool is_pruned = false;
};

// Section 4.1: the voxel cells that the segment passes and that can hold the isovalue, front to back, each with the
// crossings between which the segment is in it. `tree` is that of the grid. If `nodes` is given, it receives the nodes
// in the order of the traversal. Precondition: no sample equals `isovalue`.
std::vector<CellVisit> collect_voxels(const ScalarGrid& grid, const MinMaxKdTree& tree, double isovalue,
                                      const LineSegment& r, std::vector<NodeVisit>* nodes = nullptr);

// Section 4.2: the hits in these voxel cells, ascending: the roots of a cubic in each.
std::vector<Hit> find_intersections(std::span<const CellVisit> voxels, const ScalarGrid& grid, double isovalue,
                                    CubicSolver solver, const LineSegment& r);

// Figure 12: all hits of the segment, ascending.
std::vector<Hit> intersect(const ScalarGrid& grid, const MinMaxKdTree& tree, double isovalue, CubicSolver solver,
                           const LineSegment& r);

// The step that both forms share: appends the hits in one voxel cell.
inline void find_intersections_in(const CellVisit& voxel, const ScalarGrid& grid, double isovalue, CubicSolver solver,
                                  const LineSegment& r, std::vector<Hit>& hits) {
  const CellHits found = solve_cell(grid, isovalue, solver, r.line, voxel, r.low, r.high);
  for (int i = 0; i < found.changes.count; ++i)
    hits.push_back({std::clamp(found.t(r.line, i), r.t0, r.t1), found.falling(i)});
}

}  // namespace deliso

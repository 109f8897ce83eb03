// Polygons and triangle strips as VTK stores them: the numbers of all corners, one after another, and where each ends.
// And the values of these cells that we keep: labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// Throws the error that it makes of what was expected and what was found.
using FailExpecting = std::function<void(const std::string& expected, std::int64_t found)>;

// The name of the array of cells that holds labels.
inline constexpr std::string_view kLabelArray = "label";

// Cells of a file or of a piece of one, which are numbered: first single vertices and lines, then polygons, then
// strips.
struct CellNumbers {
  std::size_t before = 0;                // single vertices and lines
  std::vector<std::size_t> of_triangle;  // of each triangle of the piece the number of its cell after those
};

// Appends fans of the polygons, or the triangles of strips with every other one turned over. `base` is added to each
// corner. `ends`: of each polygon in `corners`, ascending. Calls `fail` when a corner is below 0 or not below `points`,
// or a polygon has fewer than three.
void append_polygons(std::span<const std::int64_t> corners, std::span<const std::int64_t> ends, bool are_strips,
                     std::int64_t base, std::int64_t points, const FailExpecting& fail, TriangleMesh& mesh,
                     CellNumbers& cells);

// Gives the last triangles of the mesh, those of `cells`, the labels of their cells. Triangles before them that have
// none get 0, as do cells that `labels` does not reach.
void append_labels(const CellNumbers& cells, std::span<const double> labels, TriangleMesh& mesh);

}  // namespace deliso

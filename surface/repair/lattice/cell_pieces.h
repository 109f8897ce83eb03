// Flat voxel cells in pieces about as long as they are wide.
//
// Where spacings differ, as in scans of thick slices, the crossings of a cell's edges are as far apart as the largest
// spacing, and triangles between them are needles. So the lattice takes lines between the slices, too, and marching
// cubes, where a component comes from it, runs on samples between them. Without that, repair makes nothing right in
// cells of 1:1:5 and more, and the needles of marching cubes cost RefineGeom and the last stage a hundred times as much
// as the rest (smooth noise of 24^3 samples at 1:1:12: 200 seconds instead of 3).
#pragma once

#include <array>
#include <cstdint>

#include "raycast/isosurface.h"

namespace deliso {

// The number of pieces along each axis, 63 at most, so that a piece is at most 1.5 times the smallest spacing and all
// lines of the lattice have coordinates of kCoordinateBits. It is odd: halfway between two samples of a mask, or of
// integers, the interpolant often is the isovalue.
std::array<std::int32_t, 3> cell_pieces(const Isosurface& isosurface);

inline constexpr int kCoordinateBits = 20;  // of a line, in units of the lattice's finest part
inline constexpr int kFinestParts = 8;      // of a piece

}  // namespace deliso

// Isovalues that equal no sample, which the mesher needs: where a sample equals the isovalue, the isosurface may be no
// surface there.
#pragma once

#include <utility>

#include "volume/scalar_grid.h"

namespace deliso {

// A regular isovalue: never equal to a sample. It is `isovalue` itself unless some sample equals it, or does so up to
// rounding: where samples are in steps, 0.6 and the float next to it; or samples that are nearer to it by 2^44 times
// than all others. (A field that is 0 on a plane has 1e-17 there. All edges at such a sample would be crossed at one
// point.) Then it is lowered by 1 % of the gap to the next lower sample value, or, where such a sample has lower ones
// on both sides along an axis, by 38.2 %. (There 1 % leaves walls, wires and grains a hundredth of a voxel thin: with a
// whole number for isovalue, on most scans of integers, everywhere. Distances to a box on grid planes have no such
// samples, and hardly move.) If there is no lower sample, it is lowered by 1 % of the gap to the next higher one, or,
// where it lies just above the lowest one, raised by that; if all samples are equal, lowered by 1 % of their amount and
// 0.01 at least. When a gap is too narrow to hold a double, the next gap below is taken; throws InputError when none is
// left. A layer around walls() is no part of the volume, and does not count.
//
// Within 1e-6 of samples that are integers, an isovalue is moved away from them likewise, but stays on the side of them
// that it is on: 0.999999999 is lowered, 1.000000001 raised. (The surface would pinch at each of them.)
double regular_isovalue(const ScalarGrid& grid, double isovalue);

// A value lowered by 1 % of the gap to the next lower sample value. It lies between the same sample values, so the same
// samples lie above it.
double lowered_isovalue(const ScalarGrid& grid, double isovalue);

// The largest sample below a value and the smallest above it; infinite where there is none.
std::pair<double, double> samples_around(const ScalarGrid& grid, double value);

}  // namespace deliso

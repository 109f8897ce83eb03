// The isosurface closed where its solid meets the box of the volume: the boundary of the solid within the box.
#pragma once

#include "volume/scalar_grid.h"

namespace deliso {

// Which side of the isosurface is the solid: where the field is above the isovalue, or where it is below.
enum class Inside { kAbove, kBelow };

struct ClosedGrid {
  ScalarGrid grid;
  double isovalue = 0;  // equals no sample
};

// Whether the solid has a sample, so that its boundary within the box has a point. A sample that equals the isovalue
// counts as above it.
bool has_solid(const ScalarGrid& grid, double isovalue, Inside inside);

// The volume with a layer of samples around it that lie so far on the other side of the isovalue that the surface runs
// along the faces of the box: outside it by at most 2^-30 of a spacing, which walls() of the grid allows to be taken
// off. It meets the isosurface at a crease. The samples become floats or doubles, without loss.
// Precondition: has_solid.
ClosedGrid closed_grid(const ScalarGrid& grid, double isovalue, Inside inside);

}  // namespace deliso

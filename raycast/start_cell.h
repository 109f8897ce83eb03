// The hit of a line close to where a search begins, without walks from cell to cell.
#pragma once

#include <optional>

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The parameter t of the falling hit nearest to t = 0 on the line u + t d through a cell, in the cell's own parameters;
// `relative` are its corners less the isovalue. Nothing when it may lie in another cell, or when the interpolant is not
// seen to fall all the way from -|t| to |t|: then there may be other hits.
std::optional<double> falling_hit_around(const CellCorners& relative, const Vec3& u, const Vec3& d);

}  // namespace deliso

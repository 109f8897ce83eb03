// The positions of a vertex on an edge that several pairs of triangles share.
//
// A mesh needs the first position alone; the others are asked for once its copies are moved apart (pinch_separation.h),
// which happens to few of the meshes that repair builds.
#pragma once

#include <cstddef>
#include <vector>

#include "raycast/isosurface.h"
#include "surface/extract/pinch_groups.h"

namespace deliso {

// The first `most` of the positions near the surface, best first: the hits along the triangles' common normal or down
// the gradient, from the middle of the edge to near its ends; then hits where the surface has the opposite orientation;
// last the midpoint itself.
std::vector<Vec3> positions_on(const SubdividedEdge& edge, const Isosurface& isosurface, std::size_t most);

// Finds the other positions of all copies on edges.
void find_other_positions(std::vector<PinchGroup>& groups, const Isosurface& isosurface);

}  // namespace deliso

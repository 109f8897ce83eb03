// Whether the restricted facets bound a set of tetrahedra. With the rule kSigns they always do; with FacetRule::kHits,
// where each facet is decided by the hits of its own dual edge, they need not.
#pragma once

#include <optional>
#include <vector>

#include "surface/mesh/surface_mesh.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// The side of every tetrahedron, by slot, such that the surface falls through (falls_through) exactly the
// facets that lead from above to below. Nothing when there is no such choice: then around some edge the restricted
// facets are odd in number, or two of them disagree about the side.
std::optional<TetSigns> signs_from_facets(const SignedDelaunay& restricted);

// The facets that the surface falls through, counterclockwise seen from below, as a mesh that is no manifold in
// general. Only points and triangles of the mesh are set; vertices without triangles are left out.
SurfaceMesh facets_alone(const SignedDelaunay& restricted, int threads = 1);

}  // namespace deliso

// BuildTriMesh (Dey and Levine, section 3.2): from restricted facets to a manifold mesh.
#pragma once

#include <vector>

#include "surface/extract/facet_pairing.h"
#include "surface/extract/pinch_separation.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

struct BuiltMesh {
  SurfaceMesh mesh;                   // without balls and pole heights
  std::vector<VertexId> vertex_of;    // of each mesh vertex; for a vertex on a subdivided edge, an end of that edge
  std::vector<std::uint32_t> copies;  // mesh vertices that share their vertex with another one, ascending
  std::vector<PinchGroup> groups;     // of copies, and of vertices on the same subdivided edge
};

// Builds the mesh from the paired facets (facet_pairing.h). A vertex of the triangulation becomes one mesh vertex for
// each fan of paired triangles. An edge that two pairs of facets still share afterwards is subdivided in each pair. So
// the result is an oriented manifold with boundary, by construction. Vertices without triangles are left out. The mesh
// touches itself at the copies until separate_pinches moves them apart.
BuiltMesh build_triangle_mesh(const FacetPairing& pairing);
// The same from triangles that were paired before; the present signs of `restricted` do not matter.
BuiltMesh build_triangle_mesh(const SignedDelaunay& restricted, PairedTriangles paired);
BuiltMesh build_triangle_mesh(const SignedDelaunay& restricted, int threads = 1);

}  // namespace deliso

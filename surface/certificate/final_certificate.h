// The certificate at the end of a run: it checks the counts, the assignment of pieces to components, and whether
// rounding to the volume's own coordinates made triangles cross.
#pragma once

#include "surface/base/exact_surface.h"
#include "surface/certificate/certificate.h"
#include "surface/certificate/component_assignment.h"
#include "surface/mesh/mesh_topology.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// For a mesh with these assignment faults. If the facets bound no set of tetrahedra, the certificate is kDifferent,
// whatever the counts.
Certificate final_certificate(const MeshTopology& mesh, const IsosurfaceTopology& topology,
                              const AssignmentFaults& faults, bool bounds_a_solid);

// Whether the volume's own coordinates are those of mesh space but for powers of two, so that nothing is rounded when a
// mesh is written in them. Where they are not, triangles that all but touch may come to cross.
bool is_exact_in_world(const Isosurface& isosurface);

}  // namespace deliso

// The certificate that a run ends with: counts, places, and what rounding to the volume's own coordinates leaves of
// them.
#pragma once

#include "surface/base/exact_surface.h"
#include "surface/certificate/certificate.h"
#include "surface/certificate/component_assignment.h"
#include "surface/mesh/triangle_mesh.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// Of a mesh whose pieces are placed with these faults. Facets that bound no set of tetrahedra are no isosurface,
// whatever their counts.
Certificate final_certificate(const TriangleMesh& mesh, const IsosurfaceTopology& topology,
                              const AssignmentFaults& faults, bool bounds_a_solid, int threads = 1);

// For a mesh in world coordinates whose triangles do not cross in mesh space: sheets that all
// but touch may cross when an origin or a spacing rounds them, and then the certificate holds no more. Where
// coordinates stay as they are, but for powers of two, there is nothing to look for.
void refute_crossing(const TriangleMesh& mesh, const ExactSurface& surface, Certificate& certificate);

}  // namespace deliso

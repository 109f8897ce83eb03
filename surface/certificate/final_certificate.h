// The certificate at the end of a run: it checks the counts, the assignment of pieces to components, and whether
// rounding to the volume's own coordinates made triangles cross.
#pragma once

#include "surface/base/exact_surface.h"
#include "surface/certificate/certificate.h"
#include "surface/certificate/component_assignment.h"
#include "surface/mesh/triangle_mesh.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// For a mesh with these assignment faults. If the facets bound no set of tetrahedra, the certificate is kDifferent,
// whatever the counts.
Certificate final_certificate(const TriangleMesh& mesh, const IsosurfaceTopology& topology,
                              const AssignmentFaults& faults, bool bounds_a_solid, int threads = 1);

// For a mesh in world coordinates whose triangles do not cross in mesh space. Sheets that nearly touch may cross when
// origin or spacing round their coordinates; then the certificate is withdrawn. If the coordinates change by powers of
// two alone, nothing needs to be checked.
void refute_crossing(const TriangleMesh& mesh, const ExactSurface& surface, Certificate& certificate);

}  // namespace deliso

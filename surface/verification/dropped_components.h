// Components of the isosurface that a mesh leaves out on purpose (Promise::dropped_components): which they are, and
// what the rest of the mesh is compared with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/certificate/certificate.h"
#include "surface/certificate/component_assignment.h"
#include "surface/certificate/promise.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/triangle_mesh.h"
#include "surface/verification/isosurface_probe.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// Of each component: whether it is left out; empty unless as many have no piece of the mesh as were left out. They are
// those without a piece: all others must have one.
std::vector<std::uint8_t> components_left_out(const TriangleMesh& mesh, const ScalarGrid& grid,
                                              const RegularTopology& truth, const Promise& promise);
// Says of a certificate that the number of components without a piece is another one.
void refuse_dropped(std::int64_t count, Certificate& certificate);

// The certificate against the components that are not left out, and their crossings of grid edges, in voxel space.
Certificate certify_kept(const TriangleMesh& mesh, const IsosurfaceTopology& truth,
                         std::span<const std::uint8_t> is_dropped);
std::vector<Vec3> kept_crossings(const IsosurfaceProbe& probe, const IsosurfaceTopology& truth,
                                 std::span<const std::uint8_t> is_dropped);

}  // namespace deliso

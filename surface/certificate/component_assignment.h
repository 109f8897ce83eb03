// Whether every exact component has a piece of the mesh of its own, in its place.
//
// Counts do not tell: a piece that has swallowed two components, beside one of them made a second time, counts right.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/certificate/certificate.h"
#include "surface/mesh/surface_mesh.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// A mesh in pieces, and where these lie.
struct AssignedPieces {
  std::span<const std::uint32_t> piece_of;      // of each vertex; beyond the number of pieces for one without triangles
  std::span<const std::uint32_t> component_of;  // of each vertex; kNoComponent (mesh_pieces.h) for one off them all
  std::span<const ComponentTopology> topology;  // of each piece
  std::span<const ComponentTopology> components;  // the exact ones
};

// A piece counts for the component that most of its vertices lie on.
struct AssignmentFaults {
  std::vector<std::uint32_t> without;   // components for which no piece counts
  std::vector<std::uint32_t> repeated;  // those for which several do
  std::vector<std::uint32_t> unlike;    // those whose piece has another topology
  // Those whose piece has as many vertices on some other component as that one's own piece has, or more.
  std::vector<std::uint32_t> overrunning;

  [[nodiscard]] bool is_empty() const {
    return without.empty() && repeated.empty() && unlike.empty() && overrunning.empty();
  }
};
AssignmentFaults assignment_faults(const AssignedPieces& pieces);

// A certificate whose counts are right is right no more where places are not: a sentence for each kind of fault.
void add_assignment_faults(const AssignmentFaults& faults, Certificate& certificate);

// The exact component of each point, given in index space; kNoComponent for one that lies on none.
std::vector<std::uint32_t> components_of(std::span<const Vec3> points, const ScalarGrid& grid, double isovalue,
                                         const IsosurfaceTopology& topology, int threads = 1);

// Of a mesh in mesh space (raycast/isosurface.h).
AssignmentFaults assignment_faults(const SurfaceMesh& mesh, const ExactSurface& surface);

}  // namespace deliso

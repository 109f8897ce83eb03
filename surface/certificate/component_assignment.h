// Whether every exact component has a piece of the mesh of its own at its own position.
//
// Counts alone cannot tell: they are right, too, for a mesh in which one piece covers two components and one of these
// components is meshed a second time.
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

// The pieces of a mesh, and the exact components on which their vertices lie.
struct AssignedPieces {
  std::span<const std::uint32_t> piece_of;      // of each vertex; a number beyond the pieces for one without triangles
  std::span<const std::uint32_t> component_of;  // of each vertex; kNoComponent (mesh_pieces.h) for one off them all
  std::span<const ComponentTopology> topology;  // of each piece
  std::span<const ComponentTopology> components;  // the exact ones
  std::span<const Vec3> points = {};              // of each vertex, in index space; may be left out
};

// A piece is assigned to the component that most of its vertices lie on.
struct AssignmentFaults {
  std::vector<std::uint32_t> without;   // components without an assigned piece
  std::vector<std::uint32_t> repeated;  // components with several pieces
  std::vector<std::uint32_t> unlike;    // components whose piece has another topology
  // Components whose piece has at least as many vertices on some other component as that component's own piece has. One
  // whose own piece is smaller than vertices may be off the isosurface does not count as such another: beside it
  // vertices do not tell what they lie on.
  std::vector<std::uint32_t> overrunning;

  [[nodiscard]] bool is_empty() const {
    return without.empty() && repeated.empty() && unlike.empty() && overrunning.empty();
  }
};
AssignmentFaults assignment_faults(const AssignedPieces& pieces);

// Turns a certificate whose counts are right into kDifferent if there are assignment faults; adds a sentence for each
// kind of fault.
void add_assignment_faults(const AssignmentFaults& faults, Certificate& certificate);

// The exact component of each point, given in index space; a number beyond all components for a point that lies on
// none.
std::vector<std::uint32_t> components_of(std::span<const Vec3> points, const ScalarGrid& grid, double isovalue,
                                         const IsosurfaceTopology& topology, int threads = 1);

// For a mesh in mesh space (raycast/isosurface.h).
AssignmentFaults assignment_faults(const SurfaceMesh& mesh, const ExactSurface& surface);

}  // namespace deliso

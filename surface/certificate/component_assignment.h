// Whether every exact component has a piece of the mesh of its own at its own position.
//
// Counts alone cannot tell: they are right, too, for a mesh in which one piece covers two components and one of these
// components is meshed a second time.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/certificate/certificate.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/mesh/triangle_mesh.h"
#include "volume/scalar_grid.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// The pieces of a mesh, and the exact components on which their vertices lie.
struct AssignedPieces {
  std::span<const std::uint32_t> piece_of;      // of each vertex; a number beyond the pieces for one without triangles
  std::span<const std::uint32_t> component_of;  // of each vertex; kNoComponent (mesh_pieces.h) for one off them all
  std::span<const ComponentTopology> topology;  // of each piece
  std::span<const ComponentTopology> components;  // the exact ones
  // Whether some other component passes as near to a vertex as it may be off the isosurface: it does not tell what it
  // lies on then. May be left out.
  std::function<bool(std::uint32_t)> is_doubtful = {};
  // Of each component: whether it is left out on purpose and has no piece. Empty: none is.
  std::span<const std::uint8_t> is_dropped = {};

  [[nodiscard]] bool is_wanted(std::uint32_t component) const {
    return is_dropped.empty() || is_dropped[component] == 0;
  }
};

// A piece is assigned to the component that most of its vertices lie on.
struct AssignmentFaults {
  std::vector<std::uint32_t> without;   // components without an assigned piece
  std::vector<std::uint32_t> repeated;  // components with several pieces
  std::vector<std::uint32_t> unlike;    // components whose piece has another topology
  // Components whose piece has at least as many vertices on some other component as that component's own piece has.
  // Doubtful ones do not count.
  std::vector<std::uint32_t> overrunning;

  [[nodiscard]] std::size_t count() const {
    return without.size() + repeated.size() + unlike.size() + overrunning.size();
  }
  [[nodiscard]] bool is_empty() const { return count() == 0; }
  // Marks the components that have a fault of any kind.
  void mark(std::vector<bool>& is_marked) const {
    for (const auto* components : {&without, &repeated, &unlike, &overrunning}) {
      for (const std::uint32_t c : *components) is_marked[c] = true;
    }
  }
};
AssignmentFaults assignment_faults(const AssignedPieces& pieces);

// Turns a certificate whose counts are right into kDifferent if there are assignment faults; adds a sentence for each
// kind of fault.
void add_assignment_faults(const AssignmentFaults& faults, Certificate& certificate);

// The exact component of each point, given in index space; kNoComponent (mesh_pieces.h) for one that lies on none,
// unless only one component passes through the blocks around it.
std::vector<std::uint32_t> components_of(std::span<const Vec3> points, const ScalarGrid& grid, double isovalue,
                                         const IsosurfaceTopology& topology, int threads = 1);

// For a mesh in mesh space (raycast/isosurface.h), with its topology; no faults for one that is no manifold.
AssignmentFaults assignment_faults(const SurfaceMesh& mesh, const MeshTopology& pieces, const ExactSurface& surface);
AssignmentFaults assignment_faults(const SurfaceMesh& mesh, const ExactSurface& surface);

// The same for a mesh in the coordinates of the volume.
AssignmentFaults assignment_faults(const TriangleMesh& mesh, const MeshTopology& pieces, const ScalarGrid& grid,
                                   double isovalue, const IsosurfaceTopology& topology,
                                   std::span<const std::uint8_t> is_dropped);

}  // namespace deliso

// The last resort: components whose mesh does not keep what is promised after stage 2 come from marching cubes that are
// finer where they have to be, or on a finer grid.
#pragma once

#include "surface/base/exact_surface.h"
#include "surface/certificate/component_assignment.h"
#include "surface/certificate/geometry_check.h"
#include "surface/intersection/self_intersection.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/repair/finish/nearer_cubes.h"

namespace deliso {

// What is wrong with a mesh.
struct MeshFaults {
  GeometryCheck geometry;
  SelfIntersections
      crossing;  // and touching, of its triangles, in the world's coordinates; up to kMostPairsAtLast are listed
  MeshTopology pieces;
  AssignmentFaults places;  // of these pieces

  [[nodiscard]] std::int64_t count() const {
    return geometry.vertices_off + geometry.mesh_off + geometry.reversed_components + crossing.meeting_pairs() +
           static_cast<std::int64_t>(geometry.missed_points.size() + geometry.off_box_edges.size() + places.count());
  }
};

// The triangles that cross once the mesh is in the world's coordinates.
SelfIntersections crossing_in_world(const SurfaceMesh& mesh, const Isosurface& isosurface, int threads);

// Replaces the components that have faults, and those marked, by finer cubes, and marks them. Returns the number of
// components replaced. In mesh space. `cube`: how long the diagonals of the cubes may be.
std::int64_t replace_faulty_components(SurfaceMesh& mesh, const ExactSurface& surface, const MeshFaults& faults,
                                       double cube, std::vector<bool>& is_marked);

// The same by marching cubes that are finer only where that brings them near enough (nearer_cubes.h).
std::int64_t replace_by_nearer_cubes(SurfaceMesh& mesh, const ExactSurface& surface, const MeshFaults& faults,
                                     const CubeNearness& wanted, std::vector<bool>& is_marked);

}  // namespace deliso

// How far the mesh of a run lies from its isosurface, both ways, and whether its vertices lie on it: the mesher's own
// answer, by the sides of points, to what the verification measures by distances.
//
// A point is within D of the isosurface when another at distance D from it lies on the other side of the isosurface
// (point_nearness.h). Large triangles are divided until all of them is shown to be near (triangle_nearness.h).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/certificate/cells/missed_places.h"
#include "surface/certificate/promise.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

struct GeometryCheck {
  std::int64_t vertices_off = 0;             // farther than promise.max_residual from the isosurface
  std::vector<std::uint32_t> off_vertices;   // these, ascending
  std::int64_t mesh_off = 0;                 // parts of triangles not shown to be within promise.max_distance of it
  std::vector<std::uint32_t> far_triangles;  // that have such parts, ascending
  std::vector<std::int64_t> far_parts;       // how many of each of these
  std::vector<Vec3> missed_points;  // of the isosurface, farther than promise.max_distance from every triangle:
  std::vector<std::uint32_t> missed_numbers;     // these crossings, indices into topology.crossings, ascending,
  std::vector<MissedPlace> missed_places;        // and these, where cells are looked into
  std::int64_t reversed_components = 0;          // that face higher values on the whole
  std::vector<std::uint32_t> reversed_vertices;  // one of each of these
  std::vector<MeshEdge> off_box_edges;           // of the boundary, that lie on no face of the box

  [[nodiscard]] bool is_near() const { return mesh_off == 0 && missed_points.empty(); }
};

// What a check of an earlier mesh tells of this one (repeated_check.h).
struct KnownBefore {
  std::vector<std::int32_t> far_parts;     // of each triangle; -1: not known
  std::vector<std::uint32_t> missed;       // crossings known to be missed, ascending
  std::vector<std::uint32_t> asked;        // crossings of which nothing is known, ascending; none of `missed`
  std::vector<MissedPlace> missed_places;  // known, in the order of their cells
  std::vector<std::uint64_t> asked_cells;  // of which nothing is known, ascending; none of these
};

// Of a mesh in mesh space with the exact topology's crossings: how far the two lie apart, both ways, alone. The same
// for any number of threads.
GeometryCheck check_distances(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise,
                              const KnownBefore* known = nullptr);

// That and the rest.
GeometryCheck check_geometry(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise,
                             const KnownBefore* known = nullptr);

}  // namespace deliso

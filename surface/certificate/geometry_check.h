// How far the mesh of a run lies from its isosurface, both ways, and whether its vertices lie on it: the mesher's own
// answer, by the sides of points, to what the verification measures by distances.
//
// A point is within D of the isosurface when two points at distance D on either side of it, one in some direction and
// one against it, lie on different sides of the isosurface. That costs two values of the field.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/certificate/promise.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

struct GeometryCheck {
  std::int64_t vertices_off = 0;             // farther than promise.max_residual from the isosurface
  std::vector<std::uint32_t> off_vertices;   // these, ascending
  std::int64_t mesh_off = 0;                 // sampled points of triangles farther than promise.max_distance from it
  std::vector<std::uint32_t> far_triangles;  // that such points lie on, ascending
  std::vector<std::int64_t> far_samples;     // how many lie on each of these
  std::vector<Vec3> missed_crossings;        // of the isosurface, farther than promise.max_distance from every triangle
  std::vector<std::uint32_t> missed_numbers;     // of these crossings: indices into topology.crossings, ascending
  std::int64_t reversed_components = 0;          // that face higher values on the whole
  std::vector<std::uint32_t> reversed_vertices;  // one of each of these
  std::vector<MeshEdge> off_box_edges;           // of the boundary, that lie on no face of the box

  [[nodiscard]] bool is_near() const { return mesh_off == 0 && missed_crossings.empty(); }
};

// How many samples of a triangle are farther than `most` from the isosurface, by the check below; counted up to
// `enough`.
std::int64_t count_far_samples(const Isosurface& isosurface, const std::array<Vec3, 3>& corners, double most,
                               std::int64_t enough = std::numeric_limits<std::int64_t>::max());

// What a check of an earlier mesh tells of this one (repeated_check.h).
struct KnownBefore {
  std::vector<std::int64_t> far_samples;  // of each triangle; -1: not known
  std::vector<std::uint32_t> missed;      // crossings known to be missed, ascending
  std::vector<std::uint32_t> asked;       // crossings of which nothing is known, ascending; none of `missed`
};

// Of a mesh in mesh space with the exact topology's crossings. Triangles are sampled where the distances of their
// corners do not tell, at points one voxel apart. The same for any number of threads.
GeometryCheck check_geometry(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise,
                             const KnownBefore* known = nullptr);

}  // namespace deliso

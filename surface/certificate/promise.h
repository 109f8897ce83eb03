// What a proven mesh is: the one list of conditions that `mesh` and `verify` judge by, and their bounds.
//
// Each of them measures with code of its own; here stands what they measure, and what it has to be.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "surface/certificate/certificate.h"

namespace deliso {

// Lengths in voxels: units of the smallest spacing.
struct Promise {
  double max_distance = 1;     // of any point of the mesh from the isosurface, and the other way
  bool within_cells = false;   // the other way also within voxel cells, and not on their edges alone
  double max_residual = 1e-3;  // of a vertex from the isosurface
  double on_box = 1e-3;        // of a boundary edge from the face of the box that it lies on
  // So many components of the isosurface are left out on purpose: they have no piece of the mesh, and all others one.
  std::int64_t dropped_components = 0;
};

// The mesher proves that all points of triangles are within the distance (triangle_nearness.h), and all points of the
// isosurface too where an error is stated or a distance below a voxel is promised (missed_places.h); else only its
// crossings with the edges of the grid are asked for. The verification measures at points: of a triangle at its
// centroid, at those of a lattice, and where the faces between voxel cells cut it; of the isosurface at its crossings
// with the edges of the grid, for distances below 0.75 voxel also with those of a finer one. A lattice has at most so
// many points along an edge.
inline constexpr int kMostSamplesPerEdge = 64;

// What was found of a mesh. A count of 0 is right.
struct PromiseFigures {
  std::int64_t triangles = 0;
  bool is_manifold = false;
  std::string manifold_faults;           // what keeps it from being one, if that is known
  std::int64_t misoriented_edges = 0;    // whose two triangles disagree
  std::int64_t reversed_components = 0;  // that face higher values
  std::int64_t off_box_edges = 0;        // boundary edges that do not lie on one face of the box
  Verdict topology = Verdict::kNotChecked;
  std::int64_t crossing_pairs = 0;       // of triangles, in the coordinates as they are written
  std::int64_t touching_pairs = 0;       // the same, beyond corners and edges that they share
  std::int64_t zero_area_triangles = 0;  // with corners in line: they cross nothing, but fit no promise
  std::int64_t vertices_off = 0;         // farther than max_residual from the isosurface
  std::int64_t mesh_off = 0;             // places of triangles farther than max_distance from the isosurface
  std::int64_t isosurface_off = 0;       // places of the isosurface farther than max_distance from the mesh
  // The largest of these distances, where they were measured.
  std::optional<double> worst_vertex, worst_mesh, worst_isosurface;
};

// One sentence for each condition that does not hold; none: the mesh is proven.
std::vector<std::string> broken_promises(const PromiseFigures& figures, const Promise& promise);

// The sentence for what a run that was stopped has not looked at, so that its mesh is not proven.
std::string unchecked_when_stopped();

}  // namespace deliso

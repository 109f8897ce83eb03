// How far a mesh is from an isosurface and the isosurface from the mesh, in voxels, by sampling both.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"
#include "surface/mesh/triangle_mesh.h"
#include "surface/verification/isosurface_probe.h"

namespace deliso {

struct DistanceFigure {
  double max_voxels = 0;
  double mean_voxels = 0;
  Vec3 worst;  // where the maximum is: the sampled point
};

// The distance of each vertex to the isosurface; nothing for a vertex without a triangle. All in voxel space. A
// distance above `most` is searched completely.
std::vector<std::optional<double>> vertex_distances(const TriangleMesh& mesh, IsosurfaceProbe& probe, double most = 0);
// The figure of these distances; the mean is over vertices.
DistanceFigure vertices_to_isosurface(const TriangleMesh& mesh, std::span<const std::optional<double>> distances);

// Triangles to the isosurface. Sampled are the centroid of each triangle and the points of a lattice without its
// corners, at least the edge midpoints: a voxel apart, or 2 `most` where that is less, but not below a quarter of a
// voxel (kMostSamplesPerEdge in promise.h has the most). Of triangles that reach farther than `most` from their corners
// also the points where faces between voxel cells cut their edges, and the one midway between two. The mean is over
// area, by the lattice and the centroid. Vertices are not sampled here. `beyond`, if given, gets the number of samples
// that are farther than `most`, after a complete search.
DistanceFigure triangles_to_isosurface(const TriangleMesh& mesh, IsosurfaceProbe& probe, double most = 0,
                                       std::int64_t* beyond = nullptr);

// The given points to the mesh: to their nearest triangles, exactly but for rounding. For a mesh without triangles the
// distance is `if_empty`. `most` and `beyond` as above.
DistanceFigure points_to_mesh(std::span<const Vec3> points, const TriangleMesh& mesh, double if_empty, double most = 0,
                              std::int64_t* beyond = nullptr);

}  // namespace deliso

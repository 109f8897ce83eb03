// Judges any triangle mesh as an image of an isosurface.
//
// Shared with the mesher are the exact topology, the comparison with it (certificate/), the exact tests for triangles
// that meet (intersection/), and the tree of boxes that finds near triangles (search/box_tree.h). Residuals, distances
// both ways, normals and orientation are measured by code of its own, without the mesher's ray search.
//
// Every check is plain data: whether it passed, and its figures. Lengths are in voxels: units of the smallest spacing.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "surface/certificate/certificate.h"
#include "surface/certificate/promise.h"
#include "surface/intersection/self_intersection.h"
#include "surface/mesh/mesh_quality.h"
#include "surface/mesh/triangle_mesh.h"
#include "surface/verification/delaunay_balls.h"
#include "surface/verification/surface_distance.h"
#include "volume/scalar_grid.h"

namespace deliso {

struct ManifoldCheck {
  bool pass = false;                       // the next three are zero
  std::int64_t non_manifold_edges = 0;     // edges with three or more triangles
  std::int64_t non_manifold_vertices = 0;  // vertices with more than one umbrella
  std::int64_t repeated_vertices = 0;      // triangles that name a vertex twice
  std::int64_t duplicate_triangles = 0;    // triangles with the same three vertices as an earlier one
  std::int64_t zero_area_triangles = 0;    // triangles whose corners are exactly collinear
  std::int64_t unreferenced_vertices = 0;  // vertices without a triangle
  std::int64_t components = 0;
  std::int64_t euler_characteristic = 0;
  std::int64_t boundary_loops = 0;
};

struct OrientationCheck {
  bool pass = false;                   // manifold, neighbours agree, and every component faces lower values
  std::int64_t misoriented_edges = 0;  // edges whose two triangles disagree
  // Components whose normals point to higher values on the whole, where they pass grid edges (facing_votes.h).
  std::int64_t reversed_components = 0;
  std::vector<Vec3> reversed_at;  // a vertex of each of the first ten, in the world
};

struct BoundaryCheck {
  bool pass = false;  // every boundary edge has both ends on one face of the box, within 1e-3 voxel
  std::int64_t boundary_edges = 0;
  std::int64_t off_box_edges = 0;     // boundary edges elsewhere
  std::int64_t outside_vertices = 0;  // vertices that lie outside the box by more than 1e-3 voxel
};

struct SelfIntersectionCheck {
  bool pass = false;  // no crossing pair (touching pairs are reported only)
  SelfIntersections found;
};

// In a DistanceFigure `worst` is in the world.
struct ResidualCheck {
  bool pass = false;        // max <= 1e-3 voxel
  DistanceFigure distance;  // of the referenced vertices to the isosurface
};

struct DistanceCheck {
  bool pass = false;                  // both at most promise.max_distance
  DistanceFigure mesh_to_isosurface;  // points sampled on the triangles
  DistanceFigure isosurface_to_mesh;  // its crossings with grid edges; below 0.75 voxel also with those of a finer grid
};

struct NormalCheck {
  bool pass = false;         // no triangle faces higher values
  std::int64_t against = 0;  // triangles whose normal has a negative cosine with the descent direction of g
  double fraction_against = 0;
  double min_cosine = 1;  // the smallest of those cosines; at the point of the isosurface next to the centroid
  double mean_cosine = 1;
};

struct Verification {
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  double isovalue = 0;       // as asked
  double isovalue_used = 0;  // differs only when a sample, or a saddle, equals the isovalue

  ManifoldCheck manifold;
  OrientationCheck orientation;
  BoundaryCheck boundary;
  Certificate topology;  // verdict kHomeomorphic passes
  SelfIntersectionCheck self_intersection;
  ResidualCheck residual;
  DistanceCheck distance;
  NormalCheck normals;
  DelaunayBallCheck delaunay_balls;
  MeshQuality quality;

  // All conditions of promise.h hold. Normals, shape and Delaunay balls do not count: they are further figures of
  // merit.
  bool proven = false;
  std::vector<std::string> failures;  // one sentence for each condition of `proven` that fails
  double seconds = 0;
};

// Called when a step begins, with the fraction of the steps that are done.
using VerificationProgress = std::function<void(double share, std::string_view step)>;

// `written`: the points as the mesh's file has them, where `mesh` is in the grid's own coordinates; triangles that
// cross are looked for there. Empty: the same.
//
// Precondition: finite coordinates. Throws InputError when a triangle names a vertex out of range or the isovalue is
// outside the range of the volume.
Verification verify_mesh(const TriangleMesh& mesh, const ScalarGrid& grid, double isovalue, const Promise& promise = {},
                         const VerificationProgress& progress = {}, std::span<const Vec3> written = {});

}  // namespace deliso

// Keeps stage 2 from making triangles that cross others, where two sheets of the surface are close to each other.
//
// Replacing a disk by a star moves the mesh by no more than the disk was off the surface. So the mesh can meet another
// sheet only if the distance between the sheets is no larger than its triangles. The guard stores a bound of that
// distance at every vertex, its clearance: the pole height, but no more than the distance along edges to a doubled
// vertex (clearances.h). A triangle is tight if it is larger than its clearance, or has a suspect vertex. Suspect
// vertices are the corners of a triangle that is so thin or steep that the surface lies far from it: other triangles
// may fold over it. Only tight triangles are stored by position. Only stars with tight triangles are tested against
// them, exactly. A star that moves far can also fold over the triangles next to it; this is tested where the mesh turns
// sharply at an edge of the rim.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/refine/disk/refinement_disk.h"
#include "surface/refine/disk/refinement_mesh.h"
#include "surface/refine/guard/triangle_hash_grid.h"

namespace deliso {

class CrossingGuard {
 public:
  // Keeps a reference to a mesh with clearances, and a few bytes for each of its triangles.
  CrossingGuard(RefinementMesh& mesh, int threads);

  // Whether the star of p over the rim of a disk meets itself beyond what its triangles share, or meets tight triangles
  // of the mesh outside the disk, or folds over its neighbours. `moved`: a bound of the distance by which the mesh
  // moves; `up`: approximate normal of the star. Also computes p's clearance.
  bool crosses(const Vec3& p, const Vec3& up, double moved, const RefinementDisk& disk);
  // Whether two triangles at a flipped edge, given by their corners, meet tight triangles of the mesh other than the
  // two whose place they take.
  [[nodiscard]] bool crosses_flipped(const std::array<std::uint32_t, 3>& s, const std::array<std::uint32_t, 3>& t,
                                     std::uint32_t old_s, std::uint32_t old_t);
  [[nodiscard]] float new_clearance() const { return new_clearance_; }

  // forget(): call before a triangle is removed. learn(): call after a triangle was added.
  void forget(std::uint32_t triangle);
  void learn(std::uint32_t triangle);
  void learn(std::uint32_t triangle, double squared_longest);  // given the triangle's longest edge
  // Call when a triangle is not refined: its corners become suspect if the surface lies far from it.
  void mark_if_far_off(std::uint32_t triangle);

 private:
  // A triangle, of the mesh or of a star, with its corner points and box.
  struct PlacedTriangle {
    std::array<std::uint32_t, 3> corners;
    std::array<Vec3, 3> points;
    Box3 box;
  };

  float clearance_at(const Vec3& p, std::span<const RimEdge> rim);
  [[nodiscard]] bool lies_around(const Vec3& p, const Vec3& up) const;
  [[nodiscard]] bool star_meets_itself() const;
  [[nodiscard]] bool folds(const Vec3& p, std::span<const RimEdge> rim);
  [[nodiscard]] PlacedTriangle star_triangle(const Vec3& p, const RimEdge& edge) const;
  [[nodiscard]] PlacedTriangle placed(const std::array<std::uint32_t, 3>& corners) const;
  [[nodiscard]] PlacedTriangle placed(std::uint32_t triangle) const {
    return placed(mesh_.triangles[triangle].corners);
  }
  [[nodiscard]] bool is_tight(std::uint32_t triangle) const;
  // 0 for a suspect vertex.
  [[nodiscard]] float effective_clearance(std::uint32_t vertex) const {
    const RefinementMesh::Vertex& v = mesh_.vertices[vertex];
    return v.is_suspect ? 0 : v.clearance;
  }
  // The least effective clearance of a triangle's corners.
  [[nodiscard]] float effective_clearance(const std::array<std::uint32_t, 3>& corners) const {
    return std::min(
        {effective_clearance(corners[0]), effective_clearance(corners[1]), effective_clearance(corners[2])});
  }
  [[nodiscard]] static bool meets(const PlacedTriangle& s, const PlacedTriangle& t);

  RefinementMesh& mesh_;
  TriangleHashGrid tight_;
  float new_clearance_ = 0;
  std::vector<PlacedTriangle> star_;
  std::vector<std::size_t> tight_in_star_;
  std::vector<std::uint32_t> near_;
};

}  // namespace deliso

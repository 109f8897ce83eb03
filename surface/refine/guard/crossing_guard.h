// Keeps stage 2 from making triangles that cross others, where the surface comes near to itself.
//
// Replacing a disk by a star moves the mesh by no more than the disk was off the surface, so it can meet another sheet
// only where the distance between the sheets is no larger than its triangles. The guard knows a bound of that distance
// at every vertex, its clearance: the pole height, but no more than the distance to a vertex that has another one on
// top of it. Triangles larger than their clearance are tight, and so are those at a suspect vertex, a corner of a
// triangle that is so thin or steep that the surface lies far from it: others may fold over it. Only tight triangles
// are kept by place, and only stars that would have such triangles are tested against them, exactly. A star that moves
// far can also fold over the triangles beside it, which is tested where an edge of the rim turns sharp.
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

  // Whether the star of p over the rim of a disk meets itself or tight triangles of the mesh outside the disk beyond
  // what they share, or folds over its neighbours. `moved`: how far the mesh moves at most; `up`: about a normal of the
  // star. Also finds p's clearance.
  bool crosses(const Vec3& p, const Vec3& up, double moved, const RefinementDisk& disk);
  [[nodiscard]] float new_clearance() const { return new_clearance_; }

  // Before a triangle goes; after a triangle has come.
  void forget(std::uint32_t triangle);
  void learn(std::uint32_t triangle);
  void learn(std::uint32_t triangle, double squared_longest);  // whose longest edge is known
  // A triangle stays as it is: its corners become suspect if the surface lies far from it.
  void distrust(std::uint32_t triangle);

 private:
  // A triangle, of the mesh or of a star, that is tested against others.
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
  [[nodiscard]] PlacedTriangle placed(std::uint32_t triangle) const;
  [[nodiscard]] bool is_tight(std::uint32_t triangle) const;
  [[nodiscard]] float trusted_clearance(std::uint32_t vertex) const {
    const RefinementMesh::Vertex& v = mesh_.vertices[vertex];
    return v.is_suspect ? 0 : v.clearance;
  }
  // The least of a triangle's corners.
  [[nodiscard]] float trusted_clearance(const std::array<std::uint32_t, 3>& corners) const {
    return std::min({trusted_clearance(corners[0]), trusted_clearance(corners[1]), trusted_clearance(corners[2])});
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

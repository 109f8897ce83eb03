// The triangles of a mesh by place: whether points of the surface lie near them.
#pragma once

#include <cstdint>
#include <span>

#include "delaunay/base/box3.h"
#include "surface/box_tree.h"
#include "surface/surface_mesh.h"

namespace deliso {

class MeshCover {
 public:
  // Keeps a reference to the mesh. Many questions are answered faster when its triangles have neighbours.
  explicit MeshCover(const SurfaceMesh& mesh, int threads = 1);

  // Whether p lies within 0.8 mesh-space units of some triangle, or within 0.3 circumradii of the nearest one (of a
  // sliver, 0.3 longest edges): a coarse triangle may well be that far off the surface that it approximates. The search
  // begins at the triangle `guess`, which becomes the one that covers p, if any: a good guess for a point nearby. The
  // answer does not depend on it, unless triangles of different radii are equally near, to rounding.
  [[nodiscard]] bool covers(const Vec3& p, std::uint32_t& guess) const { return look(p, guess) != Cover::kNone; }
  // The same, and whether it is within 0.5 units.
  enum class Cover : std::uint8_t { kNone, kFar, kClose };
  [[nodiscard]] Cover look(const Vec3& p, std::uint32_t& guess) const;
  // covers[i] = look(points[i]), with the same reservation: faster than one by one where points that follow each other
  // lie near each other and triangles are large.
  void look_at_all(std::span<const Vec3> points, std::span<Cover> covers) const;

 private:
  // A triangle and its squared distance from some point.
  struct Nearest {
    std::uint32_t triangle = 0;
    double squared = 0;
  };
  class Candidates;
  [[nodiscard]] double squared_distance_to(const Vec3& p, std::uint32_t triangle) const;
  // Where a walk over the mesh that comes ever nearer to p ends, or was given up.
  [[nodiscard]] Nearest walk_towards(const Vec3& p, std::uint32_t start) const;
  [[nodiscard]] Cover cover_by(const Nearest& nearest) const;
  [[nodiscard]] bool is_coarse(std::uint32_t triangle) const;
  bool look_together(std::span<const Vec3> run, const Box3& box, std::span<Cover> covers, std::uint32_t& guess) const;

  const SurfaceMesh& mesh_;
  BoxTree tree_;
};

}  // namespace deliso

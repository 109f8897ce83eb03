// Whether points of the surface lie near triangles of a mesh, by spatial search.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/search/box_tree.h"
#include "surface/search/distance_bounds.h"

namespace deliso {

class CoverageQuery {
 public:
  // Keeps a reference to the mesh.
  explicit CoverageQuery(const SurfaceMesh& mesh, int threads = 1);

  // Whether p lies within 0.8 mesh-space units of some triangle, or within 0.3 circumradii of the nearest one (for a
  // sliver, 0.3 longest edges): a coarse triangle may be that far off the surface that it approximates. `guess` is a
  // triangle that may be near. It is replaced by a nearer one, if any, which is a good guess for a point nearby. The
  // answer does not depend on it.
  [[nodiscard]] bool covers(const Vec3& p, std::uint32_t& guess) const { return look(p, guess) != Cover::kNone; }
  // The same, with a distinction: kClose is within 0.5 units.
  enum class Cover : std::uint8_t { kNone, kFar, kClose };
  [[nodiscard]] Cover look(const Vec3& p, std::uint32_t& guess) const;
  // covers[i] = look(points[i]). Much faster than single calls if consecutive points lie near each other.
  void look_at_all(std::span<const Vec3> points, std::span<Cover> covers) const;

 private:
  // A triangle and its squared distance from some point.
  struct Nearest {
    std::uint32_t triangle = 0;
    double squared = std::numeric_limits<double>::infinity();
  };
  // A triangle, and a box that holds everything it is near to.
  struct Near {
    std::uint32_t triangle = 0;
    Box3 box;
    TrianglePlanes planes;
  };
  // Scratch data for a group of points that lie near each other.
  struct Work {
    std::vector<Near> near;         // triangles near any point of the group
    std::vector<std::size_t> left;  // indices of points that have no near triangle
    std::uint32_t guess = 0;        // the nearest triangle of an earlier point
  };
  class Candidates;
  [[nodiscard]] double squared_distance_to(const Vec3& p, std::uint32_t triangle) const;
  [[nodiscard]] Cover cover_by(const Nearest& nearest) const;
  [[nodiscard]] bool is_coarse(std::uint32_t triangle) const;
  void look_at_group(std::span<const Vec3> group, const Box3& box, std::span<Cover> covers, Work& work) const;
  void find_near(const Box3& box, Work& work) const;
  static DistanceBounds bounds_of(std::span<const Vec3> points, const Vec3& middle, const Work& work);
  [[nodiscard]] Cover cover_by_near(const Vec3& p, const Work& work) const;
  void look_at_left(std::span<const Vec3> group, std::span<Cover> covers, Work& work) const;
  bool look_together(std::span<const Vec3> run, const Box3& box, std::span<const std::size_t> places,
                     std::span<Cover> covers, std::uint32_t& guess) const;

  const SurfaceMesh& mesh_;
  BoxTree tree_;
};

}  // namespace deliso

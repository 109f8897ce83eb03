// The triangles of a mesh by place: whether points of the surface lie near them.
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

  // Whether p lies within nearness::kCrossing (nearness.h) of some triangle, or within nearness::kOfCircumradius of the
  // nearest one (of a sliver, as much of its longest edge): a coarse triangle may well be that far off the surface that
  // it approximates. `guess` is a triangle that may be near, and becomes one that is nearer, if any: a good guess for a
  // point nearby. The answer does not depend on it.
  [[nodiscard]] bool covers(const Vec3& p, std::uint32_t& guess) const { return look(p, guess) != Cover::kNone; }
  // The same, and whether it is within nearness::kClose.
  enum class Cover : std::uint8_t { kNone, kFar, kClose };
  [[nodiscard]] Cover look(const Vec3& p, std::uint32_t& guess) const;
  // covers[i] = look(points[i]): much faster than one by one where points that follow each other lie near each other.
  void look_at_all(std::span<const Vec3> points, std::span<Cover> covers) const;

 private:
  // A triangle and its squared distance from some point.
  struct Nearest {
    std::uint32_t triangle = 0;
    double squared = std::numeric_limits<double>::infinity();
  };
  // A triangle; what it is near to lies in the box.
  struct Near {
    std::uint32_t triangle = 0;
    Box3 box;
    TrianglePlanes planes;
  };
  // What is known of a group of points that lie near each other.
  struct Work {
    std::vector<Near> near;         // triangles, to any of them
    std::vector<std::size_t> left;  // places of points that have none near
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

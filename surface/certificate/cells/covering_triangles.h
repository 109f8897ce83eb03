// Whether several triangles together lie over a convex body, all of it near them: what one triangle alone seldom does
// beside its edges.
//
// Seen along a direction n, let a triangle near the body be apart from it when an edge of the triangle separates the
// two. Suppose that all others face n, that each has a neighbour across every edge, that the corners of the body are
// within D of their planes along n, and that one of them lies over a point of the body. Then every point of the body is
// within D of a triangle. Where the part of the body that is covered ended, it would end at an edge, less than D along
// n from a point of the body: so the triangle across that edge is near the body too, and it faces n, so that it covers
// what comes next. The distance along n is linear over the body, so it is largest at corners.
//
// Needed where errors are stated: in the search of cells (missed_places.h) it takes two thirds of the boxes away, since
// a box beside an edge has no single triangle near all of it before it is about as small as D.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/certificate/cells/surface_hull.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

class CoveringTriangles {
 public:
  // Keeps a reference to the mesh.
  CoveringTriangles(const SurfaceMesh& mesh, double most);

  // Whether all of a hull (in mesh space) is within `most` of `near`: all triangles that are within that of the hull,
  // and maybe others. `falling`: the direction n, which triangles face; of any length. False tells nothing.
  [[nodiscard]] bool cover(const SurfaceHull& hull, const Vec3& falling, std::span<const std::uint32_t> near) const;

 private:
  enum class Place { kApart, kBeside, kOverMiddle };
  [[nodiscard]] Place place_of(const std::array<Vec3, 3>& corners, const SurfaceHull& hull, const Vec3& middle,
                               const Vec3& n) const;

  const SurfaceMesh& mesh_;
  double most_;
  std::vector<std::uint8_t> is_open_;  // of each triangle: whether it has no neighbour across an edge
};

}  // namespace deliso

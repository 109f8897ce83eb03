// Whether all of a triangle lies within a distance of the isosurface, by a proof: no points are left out.
//
// The distance from a surface changes no faster than the place, so a part of a triangle within R of its centroid is
// within D of the isosurface when the centroid is within D - R. And where all of a part, moved by D along some
// direction, is on one side of the isosurface, and moved against it on the other, a way of length D leads from each of
// its points to the isosurface. The first settles parts that are not much larger than D, the second all others that the
// isosurface is not too crooked beside. Parts that neither settles are divided (branch and bound).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"
#include "surface/base/exact_surface.h"
#include "surface/certificate/promise.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

// How many parts of a triangle are not shown to be within `most` of the isosurface, counted up to `enough`; their
// middles are appended to `places`. None: all of it is. Corners are taken for points of the isosurface; where they are
// not quite, `most` is less (TriangleReaches). Where the distance is more than three quarters of `most`, it may not be
// shown. In mesh space.
std::int64_t count_far_parts(const Isosurface& isosurface, const std::array<Vec3, 3>& corners, double most,
                             std::int64_t enough = std::numeric_limits<std::int64_t>::max(),
                             std::vector<Vec3>* places = nullptr);

// How near the points on the isosurface at its corners a triangle has to be, so that all of it keeps what is promised:
// nearer where corners are copies, a hair off the isosurface. That counts where promises are small; a fortieth of them
// does not.
class TriangleReaches {
 public:
  // Keeps a reference to the mesh.
  TriangleReaches(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise);

  [[nodiscard]] double operator[](std::size_t triangle) const;

 private:
  const SurfaceMesh& mesh_;
  double most_;
  std::vector<double> offsets_;  // of the vertices from the isosurface; empty where none counts
};

}  // namespace deliso

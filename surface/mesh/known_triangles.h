// Triangles that are known again in a mesh changed since, whose numbers are others: by their corners' places.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>

#include "surface/mesh/surface_mesh.h"

namespace deliso {

class KnownTriangles {
 public:
  // Whether it was not known.
  bool add(const SurfaceMesh& mesh, std::uint32_t triangle) {
    return places_.insert(corners_of(mesh, triangle)).second;
  }
  [[nodiscard]] bool has(const SurfaceMesh& mesh, std::uint32_t triangle) const {
    return places_.contains(corners_of(mesh, triangle));
  }

 private:
  using Corners = std::array<std::array<double, 3>, 3>;

  // From the least on, in their order: a triangle put back may begin at another corner.
  static Corners corners_of(const SurfaceMesh& mesh, std::uint32_t triangle) {
    Corners corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = mesh.points[mesh.triangles[triangle][i]];
      corners[i] = {p.x, p.y, p.z};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
  }

  std::set<Corners> places_;
};

}  // namespace deliso

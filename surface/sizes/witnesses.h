// Points of the isosurface that the mesh has to stay near while it gets fewer vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"
#include "surface/base/exact_surface.h"
#include "surface/shape/patch.h"

namespace deliso {

// Each witness belongs to a triangle, and is within the error allowed of it: the crossings of the isosurface with edges
// of the grid from the beginning, where the error is small also those with the edges of a finer grid, and each vertex
// from when it is removed. So what is near the isosurface at witnesses is so both ways, and a chain of steps cannot
// wear off a thin part.
class Witnesses {
 public:
  // For the vertices of a mesh, the crossings, and other points of the isosurface; those farther than `reach` from all
  // of the mesh are left out.
  Witnesses(const Patch& mesh, const ExactSurface& surface, double reach, std::span<const Vec3> others);

  [[nodiscard]] const Vec3& point(std::uint32_t witness) const { return points_[witness]; }
  // Calls visit(witness) for those of a triangle.
  template <class Visit>
  void for_each(std::uint32_t triangle, const Visit& visit) const {
    if (triangle >= first_.size()) return;
    for (std::uint32_t w = first_[triangle]; w != kNone; w = next_[w]) visit(w);
  }
  // Gives all witnesses of some triangles, and a vertex that goes, to the nearest of others; those are `mesh`'s from
  // `first_added` on. Precondition: there are any.
  void pass_on(std::span<const std::uint32_t> removed, std::uint32_t vertex, std::uint32_t first_added,
               const Patch& mesh);

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  void give(std::uint32_t witness, std::uint32_t triangle);

  std::vector<Vec3> points_;          // the vertices, then those of the isosurface
  std::vector<std::uint32_t> first_;  // of each triangle: its first witness,
  std::vector<std::uint32_t> next_;   // and of each witness: the next of the same triangle
};

}  // namespace deliso

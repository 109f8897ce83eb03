// Where a mesh and the exact surface differ in topology, when there are so many places that sweeps along the axes lose
// their way.
//
// By the theorem of Gauss and Bonnet the Euler characteristic of a mesh is the sum of the angles that are missing to a
// full turn at its vertices (to half a turn on the boundary), in turns. Flat parts add nothing, however they are
// triangulated, and two meshes of the same bend add the same. So within a window with soft sides the sums of a mesh and
// of one with the exact topology are nearly the same, unless a handle or a piece more or less lies in it. That also
// finds places whose effects on the whole cancel.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "surface/mesh/surface_mesh.h"
#include "surface/repair/diagnosis/index_ranges.h"

namespace deliso {

class AngleDefectGrid {
 public:
  // Over a volume with so many samples; `step` is the size of a voxel in mesh space.
  AngleDefectGrid(const std::array<std::int32_t, 3>& dims, const Vec3& step);

  // Adds the curvature at the vertices of some pieces of a mesh, as often as `factor` says. `is_taken(vertex)` is the
  // same for all vertices of a piece.
  void add(const SurfaceMesh& mesh, const std::function<bool(std::uint32_t)>& is_taken, float factor);

  // The windows with at least half a handle in sum, of this sign: the largest first, none close to a larger one, at
  // most so many.
  [[nodiscard]] std::vector<IndexBox> places(bool is_positive, std::size_t most) const;

 private:
  [[nodiscard]] std::vector<float> window_sums() const;
  void spread(const Vec3& p, float amount);

  std::array<std::int32_t, 3> dims_;
  Vec3 nodes_per_unit_;
  std::array<std::size_t, 3> nodes_{};  // along each axis; the outer ones lie beyond the volume
  std::vector<float> sums_;             // at the nodes, x fastest
};

}  // namespace deliso

// Where a mesh and the exact surface differ in topology, if they differ in so many places that Euler curves are
// unclear. Without it the noise of some scans (ENGINE at 10.3) takes all rounds and leaves components to marching
// cubes.
//
// By the theorem of Gauss and Bonnet the Euler characteristic of a mesh is the sum of the angle defects of its
// vertices, in turns: what their angles lack to a full turn, or to half a turn on the boundary. A flat part has the sum
// 0, however it is triangulated. Two meshes of one curved part have nearly the same sum. So the sums of a mesh and of
// one with the exact topology are nearly the same in a window, unless the window holds a handle or a piece more or
// less. Differences are found, too, whose effects on the whole cancel.
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

  // Adds the angle defects of the vertices of some pieces of a mesh. `is_taken(vertex)` is the same for all vertices of
  // a piece.
  void add(const SurfaceMesh& mesh, const std::function<bool(std::uint32_t)>& is_taken);

  // Subtracts the defects of another grid over the same volume.
  void subtract(const AngleDefectGrid& other);

  // The windows whose sum is at least half a handle and has this sign: the largest first, none close to a larger one,
  // and at most `most`.
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

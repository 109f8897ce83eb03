// The boxes around badly shaped triangles, and which patch of which pass each belongs to.
//
// Boxes that overlap one after the other are one patch, which one thread works on. In noise most of the surface would
// be one. Such a crowd of boxes is worked on in several passes, in each by blocks of space that are apart: a pass's
// blocks fill space, those of the next pass are shifted, and a box belongs to the first pass of which one block holds
// it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/shape/box_set.h"

namespace deliso {

class PatchBoxes {
 public:
  // The boxes of one pass.
  struct Pass {
    BoxSet boxes;
    std::vector<std::uint32_t> patch_of;  // of each box: patches in the order of their first boxes
  };

  // A box reaches `reach` longest edges beyond its triangles, those that begin in one voxel, and at least two voxels.
  // Patches of more than `most_boxes` are divided.
  PatchBoxes(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double reach, std::size_t most_boxes);

  // Each has boxes.
  [[nodiscard]] const std::vector<Pass>& passes() const { return passes_; }
  // The box of the pass for a triangle, of the mesh then or of one changed since; none where there was no bad triangle
  // or it belongs to another pass.
  [[nodiscard]] std::optional<std::uint32_t> box_of(const SurfaceMesh& mesh, std::uint32_t triangle,
                                                    std::size_t pass) const;

 private:
  struct Place {
    std::size_t pass = 0;
    std::uint32_t box = 0;
  };
  using Cube = std::array<double, 3>;
  static Cube cube_of(const SurfaceMesh& mesh, std::uint32_t triangle);
  BoxSet share_boxes(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double reach);
  void divide(const BoxSet& all, std::size_t most_boxes);

  std::map<Cube, std::uint32_t> box_at_;  // of the boxes of all passes
  std::vector<Place> places_;             // of those
  std::vector<Pass> passes_;
};

}  // namespace deliso

// Stage 2 in parts: slabs of the volume that are refined apart from each other, each with a mesh of its own.
//
// Planes across the longest axis cut the mesh into parts with about as many triangles each. Triangles that a plane
// meets are frozen: every part that they reach into has them, but replaces none. A star belongs to a part only when it
// lies strictly between its planes, so what one part does can neither cross nor change what another does. Once the
// parts are joined, what is left (what touches the frozen triangles) is refined in the whole. The cut depends on the
// mesh alone, so the result does not depend on how many threads refine the parts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "surface/refinement_mesh.h"

namespace deliso {

struct RefinementPart {
  RefinementMesh mesh;
  std::uint32_t frozen = 0;  // the first triangles are
  std::size_t axis = 0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool contains(const Vec3& p) const { return low < p[axis] && p[axis] < high; }
};

class RefinementSlabs {
 public:
  // Cuts a mesh whose balls are known into at most 8 parts of `slab_triangles` or more, about; a small one is one
  // part.
  RefinementSlabs(const RefinementMesh& whole, std::size_t slab_triangles);

  [[nodiscard]] std::vector<RefinementPart>& parts() { return parts_; }

  // Puts the refined parts together in place of what was cut; they are empty afterwards. Old vertices keep their
  // places.
  void join(RefinementMesh& whole);

 private:
  static constexpr std::uint32_t kFrozen = 0xFFFFFFFFu;

  void choose_planes(const RefinementMesh& whole);
  void assign(const RefinementMesh& whole);
  void fill(const RefinementMesh& whole, std::uint32_t part);

  std::vector<RefinementPart> parts_;
  std::vector<std::uint32_t> part_of_;                   // of each triangle of the whole: its part, or kFrozen
  std::vector<std::uint32_t> frozen_;                    // triangles of the whole
  std::vector<std::vector<std::uint32_t>> frozen_in_;    // of each part: places in frozen_
  std::vector<std::vector<std::uint32_t>> vertices_in_;  // of each part: vertices of the whole
};

}  // namespace deliso

// Stage 2 in parts: slabs of the volume that are refined apart from each other, each with a mesh of its own.
//
// Triangles that lie strictly within a slab belong to its part. Those that its planes meet are frozen: the part has
// them, but replaces none. A star belongs to a part only when it lies strictly between its planes, so what one part
// does can neither cross nor change what another does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/refinement_mesh.h"
#include "surface/refinement_planes.h"

namespace deliso {

struct RefinementPart {
  RefinementMesh mesh;
  std::uint32_t frozen = 0;  // the first triangles are
  Slab slab;
};

class RefinementSlabs {
 public:
  // Cuts the parts in disjoint slabs out of a mesh whose balls are known. `work` estimates the insertions that each
  // triangle needs: there is room for them.
  RefinementSlabs(const RefinementMesh& whole, const std::vector<Slab>& slabs, std::span<const float> work,
                  int threads);

  [[nodiscard]] std::vector<RefinementPart>& parts() { return parts_; }

  // Puts the refined parts back in place of what was cut out; they are empty afterwards. Old vertices keep their
  // places.
  void join(RefinementMesh& whole, int threads);

 private:
  // Where the first triangles and vertices of a part are in the whole.
  struct Origin {
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint32_t> vertices;
  };

  void find_triangles(const RefinementMesh& whole);
  void fill(const RefinementMesh& whole, std::span<const float> work, std::size_t part);
  static void put_back(const RefinementPart& part, const Origin& origin, RefinementMesh& whole, int threads);

  std::vector<RefinementPart> parts_;
  std::vector<Origin> origins_;
};

}  // namespace deliso

// Where the meshes of repair differ from the surface in topology, as far as Euler curves tell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "surface/repair/diagnosis/euler_curve.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "surface/repair/diagnosis/index_ranges.h"
#include "surface/repair/diagnosis/matched_mesh.h"

namespace deliso {

// A jump of an Euler curve tells a layer. Where there are several jumps along each axis, the boxes in which they meet
// are all taken: most of them by chance, which costs samples but misses nothing. None where an axis has no jump, or
// where there would be more than `most`.
std::vector<IndexBox> boxes_at(const std::array<std::vector<std::int32_t>, 3>& jumps, std::size_t most);

class EulerDifferences {
 public:
  // Keeps a reference.
  explicit EulerDifferences(const ExactSurfaceCache& facts) : facts_(facts) {}

  // For each component that is not done and whose main piece has another topology: the boxes in which the two part,
  // none where there are more than `most`. Known when asked for again.
  const std::vector<std::vector<IndexBox>>& find(const std::shared_ptr<MatchedMesh>& mesh,
                                                 const std::vector<bool>& done, std::size_t most);

 private:
  void find_for(const MatchedMesh& mesh, std::span<const std::uint32_t> components);

  const ExactSurfaceCache& facts_;
  std::vector<std::vector<IndexBox>> boxes_;  // as last found
  std::weak_ptr<MatchedMesh> of_;             // in this mesh,
  std::size_t most_ = 0;                      // no more than this
};

}  // namespace deliso

// Where the meshes of repair differ from the surface in topology, as far as Euler curves or angle defects tell.
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

  // How hard boxes are to be looked for: by Euler curves, if those tell of no more than so many; and, where they tell
  // of none, of many or of wide ones, by angle defects as well (angle_defect_grid.h), which takes longer.
  struct Effort {
    std::size_t most_boxes = 0;
    bool takes_angle_defects = false;
    friend bool operator==(const Effort&, const Effort&) = default;
  };
  // For each component that is not done and whose main piece has another topology: the boxes in which the two part.
  // Known when asked for again.
  const std::vector<IndexRanges>& find(const std::shared_ptr<MatchedMesh>& mesh, const std::vector<bool>& done,
                                       const Effort& effort);

 private:
  void find_for(const MatchedMesh& mesh, std::span<const std::uint32_t> components);
  void add_by_angle_defects(const MatchedMesh& mesh, std::uint32_t component);

  const ExactSurfaceCache& facts_;
  std::vector<IndexRanges> boxes_;  // as last found
  std::weak_ptr<MatchedMesh> of_;   // in this mesh,
  Effort effort_;                   // as hard as this
};

}  // namespace deliso

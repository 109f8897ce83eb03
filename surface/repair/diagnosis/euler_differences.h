// Where the meshes of repair differ from the surface in topology, as far as sweeps along the axes or curvature tell.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surface/repair/diagnosis/euler_boxes.h"
#include "surface/repair/diagnosis/euler_curve.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "surface/repair/diagnosis/matched_mesh.h"

namespace deliso {

class EulerDifferences {
 public:
  // Keeps a reference.
  explicit EulerDifferences(const ExactSurfaceCache& facts) : facts_(facts) {}

  // How hard places are to be looked for: by sweeps, if those tell of no more places than so many in all; and, where
  // they tell of none, of many or of wide ones, by curvature as well (angle_defect_grid.h), which takes longer.
  struct Effort {
    std::size_t most_places = 0;
    bool takes_curvature = false;
    friend bool operator==(const Effort&, const Effort&) = default;
  };
  // For each component that is not done and whose main piece has another topology: the places at which the two part.
  // Known when asked for again.
  const std::vector<IndexRanges>& find(const std::shared_ptr<MatchedMesh>& mesh, const std::vector<bool>& done,
                                       const Effort& effort);

 private:
  void find_for(const MatchedMesh& mesh, std::span<const std::uint32_t> components);
  // `boxes`: of the parts with several places.
  void count_in_boxes(const MatchedMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex,
                      const std::vector<std::uint32_t>& part_of_component,
                      std::vector<std::optional<EulerBoxes>>& boxes) const;

  void add_by_curvature(const MatchedMesh& mesh, std::uint32_t component);

  const ExactSurfaceCache& facts_;
  std::vector<IndexRanges> places_;  // as last found
  std::weak_ptr<MatchedMesh> of_;    // in this mesh,
  Effort effort_;                    // as hard as this
};

}  // namespace deliso

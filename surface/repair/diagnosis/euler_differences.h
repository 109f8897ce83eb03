// Where the topology of repair's meshes differs from the surface's, according to Euler curves and angle defects.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "surface/repair/diagnosis/angle_defect_grid.h"
#include "surface/repair/diagnosis/euler_boxes.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "surface/repair/diagnosis/index_ranges.h"
#include "surface/repair/diagnosis/matched_mesh.h"

namespace deliso {

class EulerDifferences {
 public:
  // Keeps a reference.
  explicit EulerDifferences(const ExactSurfaceCache& cache) : cache_(cache) {}

  // How much is done to find boxes. Euler curves are always compared; they give none if there are more than
  // `most_boxes`. Angle defects (angle_defect_grid.h) take longer. They are compared for displaced components, and
  // where Euler curves give no box, many boxes or wide ones.
  struct Effort {
    std::size_t most_boxes = 0;
    bool takes_angle_defects = false;
    friend bool operator==(const Effort&, const Effort&) = default;
  };
  // Marks as displaced the components, of those not done, whose main piece has the right topology in all, but not
  // everywhere: from one place on Euler curves differ, and from another on no more. (A tube between two walls of a head
  // where they nearly meet, and a handle missing elsewhere.) Not those with more than so many boxes.
  void find_displaced(MatchedMesh& mesh, const std::vector<bool>& done, std::size_t most_boxes) const;
  // For each component that is not done and whose main piece has another topology, or is displaced: the boxes in which
  // the two differ.
  // The last result is stored and returned for equal arguments.
  const std::vector<IndexRanges>& find(const std::shared_ptr<MatchedMesh>& mesh, const std::vector<bool>& done,
                                       const Effort& effort);

 private:
  // For some components, as parts of a mesh: the part of each vertex, their jumps.
  struct Parts {
    std::vector<std::uint32_t> part_of_vertex;
    std::vector<std::array<std::vector<std::int32_t>, 3>> jumps;
  };
  [[nodiscard]] Parts compare(const MatchedMesh& mesh, std::span<const std::uint32_t> components) const;
  void find_for(const MatchedMesh& mesh, std::span<const std::uint32_t> components);
  // `boxes`: of the parts with several boxes.
  void sum_changes(const MatchedMesh& mesh, const std::vector<std::uint32_t>& part_of_vertex,
                   const std::vector<std::uint32_t>& part_of_component,
                   std::vector<std::optional<EulerBoxes>>& boxes) const;
  void add_by_angle_defects(const MatchedMesh& mesh, std::uint32_t component);
  const AngleDefectGrid& exact_angle_defects(std::uint32_t component);

  const ExactSurfaceCache& cache_;
  std::vector<IndexRanges> boxes_;                                             // the last result
  std::weak_ptr<MatchedMesh> of_;                                              // for this mesh
  Effort effort_;                                                              // with this effort
  std::deque<std::pair<std::uint32_t, AngleDefectGrid>> exact_angle_defects_;  // of components of the isosurface
};

}  // namespace deliso

// Corrects the topology of a component by flipping the signs of single tetrahedra.
//
// A sign rule that is right nearly everywhere leaves a few handles too many or too few, and finer sampling does not
// always help. Euler curves or angle defects show about where these handles are, and each depends on few tetrahedra. So
// the signs of tetrahedra near there that have no sign constraint are flipped one after the other. Only flips that
// change the Euler characteristic in the right direction are tried. Nearly all flips do not, which is computed without
// building a mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "surface/base/controls.h"
#include "surface/repair/diagnosis/index_ranges.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/rounds/round.h"

namespace deliso {

class SignSearch {
 public:
  // Keeps references. `boxes`: for each component the boxes in which it differs from its main piece.
  SignSearch(RepairRound& round, const IsosurfaceTopology& topology, const CellLevels& cells,
             const std::vector<IndexRanges>& boxes)
      : round_(round), topology_(topology), cells_(cells), boxes_(boxes) {}

  // Called with a mesh that is better than the one before; the round's signs are those of this mesh. Returns whether it
  // is good enough.
  using Improved = std::function<bool(std::shared_ptr<MatchedMesh>)>;
  // Tries flips near the likely boxes of a component. `mesh` is the mesh of the round's present signs; afterwards the
  // signs are those of the best mesh.
  void mend(std::uint32_t component, std::shared_ptr<MatchedMesh> mesh, const Improved& improved, Controls& controls);

 private:
  void find_undecided();
  [[nodiscard]] bool is_worth_trying(TetId t, const ComponentTopology& lacks);
  [[nodiscard]] ComponentTopology missing(const MatchedMesh& mesh, std::uint32_t component) const;

  RepairRound& round_;
  const IsosurfaceTopology& topology_;
  const CellLevels& cells_;
  const std::vector<IndexRanges>& boxes_;
  // Of each component: the tetrahedra near its boxes without a sign constraint, the nearest first. Filled when first
  // needed.
  std::vector<std::vector<TetId>> undecided_;
};

}  // namespace deliso

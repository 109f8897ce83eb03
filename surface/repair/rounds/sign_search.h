// Mends the topology of a component by turning over the signs of single tetrahedra.
//
// A rule that is right nearly everywhere leaves a few handles too many or too few, and sampling more finely does not
// always help there. Euler curves or angle defects tell about where they are, and each is a matter of a few tetrahedra.
// So tetrahedra near there of whose side nothing is known are turned over one after the other, but only those that
// change the Euler characteristic the right way: nearly all do not, which is seen without building a mesh.
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
  // Keeps references. `boxes`: of each component, those in which its main piece parts from it.
  SignSearch(RepairRound& round, const IsosurfaceTopology& topology, const CellLevels& cells,
             const std::vector<IndexRanges>& boxes)
      : round_(round), topology_(topology), cells_(cells), boxes_(boxes) {}

  // Gets a mesh that is better than the one before, the round's signs being its own; returns whether that is enough.
  using Improved = std::function<bool(std::shared_ptr<MatchedMesh>)>;
  // Tries near the likely boxes of a component. `mesh` is the mesh of the round's signs; afterwards the signs are those
  // of the best mesh.
  void mend(std::uint32_t component, std::shared_ptr<MatchedMesh> mesh, const Improved& improved, Controls& controls);

 private:
  void find_undecided();
  [[nodiscard]] bool is_worth_trying(TetId t, const ComponentTopology& lacks);
  [[nodiscard]] ComponentTopology missing(const MatchedMesh& mesh, std::uint32_t component) const;

  RepairRound& round_;
  const IsosurfaceTopology& topology_;
  const CellLevels& cells_;
  const std::vector<IndexRanges>& boxes_;
  // Of each component, when first needed: tetrahedra very near its boxes of whose side nothing is known, the nearest
  // first.
  std::vector<std::vector<TetId>> undecided_;
};

}  // namespace deliso

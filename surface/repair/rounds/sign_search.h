// Mends the topology of a component by turning over signs on which the rules disagree.
//
// A rule that is right nearly everywhere leaves a few handles too many or too few, and sampling more finely does not
// always help there. Sweeps tell about where they are, and each is a matter of a few tetrahedra. So clusters of
// tetrahedra near those places are turned over one after the other, but only those that change the Euler characteristic
// the right way: nearly all do not, which is seen without building a mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "surface/base/controls.h"
#include "surface/repair/diagnosis/index_ranges.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/rounds/round.h"
#include "surface/repair/signs/sign_disagreement.h"

namespace deliso {

class SignSearch {
 public:
  // Keeps references. `places`: of each component, those at which its main piece parts from it.
  SignSearch(RepairRound& round, const IsosurfaceTopology& topology, const CellLevels& cells,
             std::span<const SignRule> rules, const std::vector<IndexRanges>& places);

  // Gets a mesh that is better than the one before, the round's signs being its own; returns whether that is enough.
  using Improved = std::function<bool(std::shared_ptr<MatchedMesh>)>;
  // Tries near the likely places of a component: disputed clusters, then single tetrahedra of whose side nothing is
  // known. `mesh` is the mesh of the round's signs; afterwards the signs are those of the best mesh.
  void mend(std::uint32_t component, std::shared_ptr<MatchedMesh> mesh, const Improved& improved, Controls& controls);

 private:
  bool try_all(const std::vector<DisagreementCluster>& clusters, int most, std::uint32_t component,
               std::shared_ptr<MatchedMesh>& mesh, const Improved& improved, Controls& controls);
  void find_undecided();
  [[nodiscard]] ComponentTopology missing(const MatchedMesh& mesh, std::uint32_t component) const;
  [[nodiscard]] std::vector<DisagreementCluster> clusters_near(const IndexRanges& places) const;

  RepairRound& round_;
  const IsosurfaceTopology& topology_;
  const CellLevels& cells_;
  const std::vector<IndexRanges>& places_;
  std::vector<TetSigns> signs_by_rule_;
  struct Single {
    TetId tet;
    std::int32_t layers = 0;  // to the nearest place
  };
  // Of each component, when first needed: tetrahedra very near of whose side nothing is known, the nearest first.
  std::vector<std::vector<Single>> undecided_;
};

}  // namespace deliso

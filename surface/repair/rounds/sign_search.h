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

  // Called with a mesh that is better than the one before; the round's signs are those of this mesh.
  using Improved = std::function<void(std::shared_ptr<MatchedMesh>)>;
  // Tries flips near the likely boxes of the components that are not done and lack little; a few tetrahedra of each of
  // these components at a time, all with one mesh, and one by one where a few together did not help. `mesh` is the mesh
  // of the round's present signs; afterwards the signs are those of the best mesh. `done`: of each component; may
  // change while improved() is called.
  void mend(std::shared_ptr<MatchedMesh> mesh, const std::vector<bool>& done, const Improved& improved,
            Controls& controls);

 private:
  // The tetrahedra near the boxes of a component without a sign constraint, the nearest first.
  struct Queue {
    std::uint32_t component;
    std::vector<TetId> tets;
    std::size_t next = 0;
    std::size_t tried_from = 0;  // where the tetrahedra tried last begin
    int trials = 0;
    bool one_by_one = false;  // a few together did not help
  };
  // A tetrahedron whose sign is flipped for the sake of a component.
  struct Flip {
    std::size_t queue;
    std::uint32_t component;
    TetId tet;
    std::int64_t change;  // of the Euler characteristic, if it were flipped alone
  };
  [[nodiscard]] std::vector<Queue> queues(const MatchedMesh& mesh, const std::vector<bool>& done) const;
  std::vector<Flip> next_flips(const MatchedMesh& mesh, const std::vector<bool>& done, std::vector<Queue>& queues);
  void append_flips(const MatchedMesh& mesh, std::size_t number, Queue& queue, std::vector<Flip>& flips);
  static void put_back(const std::vector<Flip>& tried, const std::vector<Flip>& kept, std::vector<Queue>& queues);
  std::shared_ptr<MatchedMesh> flipped(const std::vector<Flip>& flips, const MatchedMesh& before);
  [[nodiscard]] std::vector<Flip> helpful_of(const std::vector<Flip>& flips, const MatchedMesh& before,
                                             const MatchedMesh& trial) const;
  [[nodiscard]] std::vector<std::int64_t> errors(const MatchedMesh& mesh) const;
  [[nodiscard]] std::int64_t useful_change(TetId t, std::int64_t lacks);
  [[nodiscard]] ComponentTopology missing(const MatchedMesh& mesh, std::uint32_t component) const;

  RepairRound& round_;
  const IsosurfaceTopology& topology_;
  const CellLevels& cells_;
  const std::vector<IndexRanges>& boxes_;
};

}  // namespace deliso

// The rounds of repair: from one triangulation of samples to the next, until every component has been made right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surface/base/controls.h"
#include "surface/base/stage_stats.h"
#include "surface/intersection/self_intersection.h"
#include "surface/repair/diagnosis/euler_differences.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/lattice/sample_lattice.h"
#include "surface/repair/lattice/samples.h"
#include "surface/repair/rounds/component_selection.h"
#include "surface/repair/rounds/round.h"

namespace deliso {

class RepairRounds {
 public:
  // `restricted` is what stage 1 left: its mesh is the first one kept. Keeps references to facts and counts.
  RepairRounds(const ExactSurfaceCache& facts, std::unique_ptr<SignedDelaunay> restricted, RepairStats& stats);

  // Until every component is done, there have been `max_rounds`, or ends(), asked before each of them, says so: true
  // for that.
  bool mend(std::int32_t max_rounds, const std::function<bool()>& ends, Controls& controls);
  // Reopens the components of some crossings that the mesh leaves out, with a round that samples the surface around
  // these. Then mend() may go on.
  void mend_around(std::span<const std::uint32_t> crossings, Controls& controls);
  // The grid-edge crossings (places in topology.crossings) of the cells in which triangles of a mesh meet, ascending;
  // of the components that corners of these lie on.
  [[nodiscard]] std::vector<std::uint32_t> crossings_at(std::span<const TrianglePair> pairs,
                                                        const SurfaceMesh& mesh) const;

  // ComputePoles, for what the rounds have kept so far.
  void give_poles() {
    if (!round_) return;
    kept_.give_poles(*round_);
    round_->rest();
  }
  // What the rounds have kept. To be put together once it has pole heights.
  [[nodiscard]] const ComponentSelection& selection() const { return kept_; }
  // Whether another round may follow a mesh that seemed to be right.
  [[nodiscard]] bool may_go_on(std::int32_t max_rounds) const {
    return round_ && stats_.rounds > 0 && stats_.rounds < max_rounds;
  }
  [[nodiscard]] bool is_done() const { return kept_.is_done(); }
  [[nodiscard]] bool is_done_but_for_mixing() const { return kept_.is_done_but_for_mixing(); }
  // There will be no more of them: what they would need goes.
  void end() {
    mesh_.reset();
    round_.reset();
  }
  // The first mesh, right or not, of a run that had to end before any round.
  SurfaceMesh as_it_is();

 private:
  void mend_once(std::vector<CellName> cells, Controls& controls);
  void reopen(std::span<const std::uint32_t> crossings);
  void resample();
  void take_signs();
  void try_signs(Controls& controls);

  const ExactSurface& surface_;
  RepairStats& stats_;
  std::int64_t rounds_around_ = 0;  // of them by mend_around()
  SampleLattice lattice_;
  CellLevels raised_;
  std::optional<RepairRound> round_;
  RepairSamples samples_;              // its vertices
  std::shared_ptr<MatchedMesh> mesh_;  // the latest
  ComponentSelection kept_;
  EulerDifferences differences_;
};

}  // namespace deliso

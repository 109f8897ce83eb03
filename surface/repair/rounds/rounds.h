// The rounds of repair: each round changes samples and signs of the triangulation, until every component is right.
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
#include "surface/repair/diagnosis/euler_differences.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/diagnosis/spanning_triangles.h"
#include "surface/repair/finish/nearer_cubes.h"
#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/lattice/sample_lattice.h"
#include "surface/repair/lattice/samples.h"
#include "surface/repair/rounds/component_selection.h"
#include "surface/repair/rounds/round.h"
#include "surface/repair/rounds/sample_budget.h"

namespace deliso {

struct RoundsOptions {
  // Samples at these points stay in refined cells.
  std::span<const Vec3> fixed = {};
  // Whether components are given up (sample_budget.h).
  bool may_give_up = true;
  double max_distance = 1;  // mesh-space units: what is promised
  // Of components that come from marching cubes in the end: none where whole cells will do.
  std::optional<CubeNearness> nearness = {};
};

class RepairRounds {
 public:
  // `restricted` is the result of stage 1; its mesh is the first mesh kept. Keeps references to the cache and the
  // counters.
  RepairRounds(const ExactSurfaceCache& cache, std::unique_ptr<SignedDelaunay> restricted, RepairStats& stats,
               const RoundsOptions& options = {});

  // Makes rounds until every component is done or given up (sample_budget.h), or there have been `max_rounds`. Before
  // each round it asks ends(), and stops if that is true. Returns whether ends() stopped it.
  bool mend(std::int32_t max_rounds, const std::function<bool()>& ends, Controls& controls);
  // ComputePoles for the meshes kept so far.
  void give_poles() {
    if (!round_) return;
    kept_.give_poles(*round_);
    round_->drop_pairing();
  }
  // The meshes kept so far. Their components can be assembled once the meshes have pole heights.
  [[nodiscard]] const ComponentSelection& selection() const { return kept_; }
  [[nodiscard]] bool is_done_but_for_mixing() const { return kept_.is_done_but_for_mixing(); }
  // No further round will follow: frees the triangulation and the mesh.
  void end() {
    mesh_.reset();
    round_.reset();
  }
  // The mesh of stage 1, right or wrong, for a run that was stopped before the first round.
  SurfaceMesh unrepaired_mesh();

 private:
  std::vector<IndexRanges> differing_boxes(std::int64_t round);
  void mend_once(std::vector<CellName> cells, Controls& controls);
  void give_up();
  void resample();
  void take_mesh();

  const ExactSurface& surface_;
  RepairStats& stats_;
  SampleLattice lattice_;
  CellLevels cell_levels_;
  std::optional<RepairRound> round_;
  RepairSamples samples_;              // the vertices of its triangulation
  std::shared_ptr<MatchedMesh> mesh_;  // the latest mesh
  ComponentSelection kept_;
  std::vector<std::uint8_t> rounds_displaced_;  // of each exact component: since its best mesh is a displaced one
  EulerDifferences differences_;
  double max_distance_;
  std::vector<SpanningTriangle> spanning_;  // of the latest mesh
  std::optional<SampleBudget> budget_;      // none if no component may be given up
};

}  // namespace deliso

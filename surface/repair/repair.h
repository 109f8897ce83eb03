// Repair: resamples the surface where its mesh differs from the exact topology, and only there.
//
// Input are the triangulation of stage 1 and the exact topology. A component of the surface is done when its main piece
// has its topology, has no foreign vertex, and lies near all samples of the component. A round treats the other ones:
//  1. flag the voxel cells near their defects (defect_cells.h), found also by Euler curves (euler_differences.h) and,
//     from the third round on, by angle defects (angle_defect_grid.h);
//  2. refine each flagged cell by one level: its free samples leave, lattice samples come (cell_levels.h, samples.h);
//  3. set the signs by the rule for refined cells (sign_rule.h), build the mesh, match its pieces with the components;
//  4. flip single signs where a few handles are wrong (sign_search.h).
// Rounds end when every component is done, when only foreign vertices are left and can be removed (foreign_vertices.h),
// after `max_rounds`, or when the run is stopped. Each component is then taken from the latest mesh that agrees with it
// best (component_selection.h), and inverted umbrellas are removed (inverted_umbrellas.h). While they help, further
// rounds sample around missed crossings (missed_crossings.h) and crossing triangles. A component without a right mesh,
// or whose triangles still cross others, is taken from marching cubes and reported (marching_cubes_fallback.h).
// Guaranteed, unless the run is stopped: every component has its exact topology, and no triangles cross (but for the
// crossings that marching cubes rounds to samples, see volume/marching_cubes/marching_cubes.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "surface/base/controls.h"
#include "surface/base/exact_surface.h"
#include "surface/base/stage_stats.h"
#include "surface/extract/recovered_surface.h"
#include "surface/intersection/self_intersection.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "surface/repair/rounds/component_selection.h"
#include "surface/repair/rounds/rounds.h"
#include "surface/restricted/signed_delaunay.h"

namespace deliso {

// The steps of repair around ComputePoles and BuildTriMesh: mend_topology() comes before them, mend() after them. The
// result is the same for any number of threads.
class Repair : public RecoveredSurface {
 public:
  // `restricted` is the result of stage 1. Keeps references to `cache`, `controls` and `stats`.
  Repair(const ExactSurfaceCache& cache, std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds,
         const RoundsOptions& options, Controls& controls, RepairStats& stats);

  // Rounds with new samples and signs, until the mesh has the exact topology or the limit of rounds is reached.
  void mend_topology();
  // The pole heights of each vertex, from the triangulation that its component's mesh was made of.
  void compute_poles() override;
  SurfaceMesh build_triangle_mesh() override;
  // Removes foreign vertices and inverted umbrellas. If triangles cross or crossings are missed, it makes further
  // rounds, each with ComputePoles and BuildTriMesh of its own. Last it takes marching cubes where nothing else helps.
  void mend(SurfaceMesh& mesh) override;
  [[nodiscard]] double inner_poles_seconds() const override { return inner_poles_.seconds; }
  [[nodiscard]] double inner_build_seconds() const override { return inner_build_.seconds; }

 private:
  // The result of the rounds so far.
  struct State {
    AssembledMesh result;
    std::vector<bool> is_polygonized;  // of each component: taken from marching cubes
    std::vector<Box3> inverted;        // boxes around the inverted umbrellas left in it
    bool is_crossing_free = false;
    RepairStats stats;
  };

  void mend_by_rounds();
  void build();
  void mend_vertices();
  void mend_crossing();
  void mend_missed_crossings();
  std::optional<State> mend_around(std::span<const std::uint32_t> crossings);
  [[nodiscard]] SelfIntersections crossing_triangles() const;
  [[nodiscard]] std::vector<std::uint32_t> missed(std::span<const Box3> boxes) const;
  [[nodiscard]] bool polygonizes_no_more_than(const std::vector<bool>& before) const;
  State take_state();
  void restore(State state);
  bool ends_without_foreign_vertices();
  bool assemble();
  void polygonize_rest();
  bool take_foreign_vertices_out();

  const ExactSurfaceCache& cache_;
  const ExactSurface& surface_;
  std::int32_t max_rounds_;
  Controls& controls_;
  RepairStats& stats_;
  RepairRounds rounds_;
  AssembledMesh result_;              // the final mesh
  std::vector<bool> is_polygonized_;  // of each component: taken from marching cubes
  std::vector<Box3> inverted_;        // boxes around the inverted umbrellas left in it
  bool is_crossing_free_ = false;     // its triangles are known not to cross; removing vertices keeps this
  bool is_assembled_ = false;         // the rounds ended with result_ assembled, its foreign vertices removed
  // The run was stopped before the first round: the mesh of stage 1 is output unchanged.
  bool is_unrepaired_ = false;
  StageStats inner_poles_, inner_build_;
};

}  // namespace deliso

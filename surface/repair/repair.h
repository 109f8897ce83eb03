// Repair: resamples the surface where its mesh differs from the exact topology, and only there.
//
// Input are the triangulation of stage 1 and the exact topology. A component of the surface is done when its main piece
// has its topology, has no foreign vertex, and lies near all samples of the component. A round treats the other ones:
//  1. flag the voxel cells near their defects (defect_cells.h), found also by Euler curves (euler_differences.h) and,
//     from the third round on, by angle defects (angle_defect_grid.h);
//  2. refine each flagged cell by one level: its free samples leave, lattice samples come (cell_levels.h, samples.h);
//  3. set the signs by the rule for refined cells (sign_rule.h), build the mesh, match its pieces with the components.
// Rounds end when every component is done, when only foreign vertices are left and can be removed (foreign_vertices.h),
// after `max_rounds`, or when the run is stopped. Each component is then taken from the latest mesh that agrees with it
// best (component_selection.h), and inverted umbrellas are removed (inverted_umbrellas.h). A component without a right
// mesh, or whose triangles cross others, is taken from marching cubes and reported (marching_cubes_fallback.h).
// Guaranteed, unless the run is stopped: every component has its exact topology, and no triangles cross (but for the
// crossings that marching cubes rounds to samples, see volume/marching_cubes/marching_cubes.h).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "surface/base/controls.h"
#include "surface/base/exact_surface.h"
#include "surface/base/stage_stats.h"
#include "surface/extract/recovered_surface.h"
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
  // Removes foreign vertices and inverted umbrellas, and takes marching cubes where pieces are out of place or cross.
  void mend(SurfaceMesh& mesh) override;
  [[nodiscard]] double inner_poles_seconds() const override { return inner_poles_.seconds; }
  [[nodiscard]] double inner_build_seconds() const override { return inner_build_.seconds; }

 private:
  void mend_vertices();
  bool ends_without_foreign_vertices();
  bool assemble();
  void polygonize_rest();
  bool take_foreign_vertices_out();

  const ExactSurfaceCache& cache_;
  const ExactSurface& surface_;
  std::int32_t max_rounds_;
  const std::optional<CubeNearness> nearness_;
  Controls& controls_;
  RepairStats& stats_;
  RepairRounds rounds_;
  AssembledMesh result_;              // the final mesh
  std::vector<bool> is_polygonized_;  // of each component: taken from marching cubes
  bool is_crossing_free_ = false;     // its triangles are known not to cross; removing vertices keeps this
  bool is_assembled_ = false;         // the rounds ended with result_ assembled, its foreign vertices removed
  // The run was stopped before the first round: the mesh of stage 1 is output unchanged.
  bool is_unrepaired_ = false;
  StageStats inner_poles_, inner_build_;
};

}  // namespace deliso

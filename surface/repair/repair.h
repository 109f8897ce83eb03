// Repair: resample the surface where its mesh differs from the exact topology, and only there, until nothing differs.
//
// Rounds of: flag the voxel cells near the defects of the components that are not right yet (defect_cells.h); raise
// each flagged cell one level of the sample lattice and exchange samples in the triangulation (its free samples go,
// lattice samples come); take signs (sign_rule.h) and match the pieces of the mesh with the exact components; where a
// few handles are wrong, find the boxes in which they are (euler_differences.h; from the third round on
// angle_defect_grid.h) and turn over single signs there (sign_search.h). A component is done when its main piece has
// its topology, holds no vertex of another component and lies near all of its samples. At the end each component is
// taken from the latest mesh that has it at its best; one that no mesh has right is meshed by marching cubes, whose
// topology is exact, and reported. Vertices of other components (foreign_vertices.h) and inverted umbrellas
// (inverted_umbrellas.h) are removed from what that makes; when the former are all that is wrong, that is the end.
// Where inverted umbrellas that have to stay leave parts of the surface out (missed_crossings.h), the rounds go on,
// with samples around these. Components whose triangles cross others are meshed by marching cubes, too, until none do
// (marching_cubes_fallback.h).
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

// Stands around ComputePoles and BuildTriMesh: mend_topology() before them, mend() after them. The same for any number
// of threads.
class Repair : public RecoveredSurface {
 public:
  // `restricted` is what stage 1 left. Keeps references to `cache`, `controls` and `stats`.
  Repair(const ExactSurfaceCache& cache, std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds,
         Controls& controls, RepairStats& stats);

  // New samples and signs, until the mesh to be has the exact topology or there have been enough rounds.
  void mend_topology();
  // Each in the triangulation that its component is taken from.
  void compute_poles() override;
  SurfaceMesh build_triangle_mesh() override;
  // Takes out what is in the wrong place. Goes on with rounds, ComputePoles and BuildTriMesh where triangles cross or
  // parts of the surface are missed.
  void mend(SurfaceMesh& mesh) override;
  [[nodiscard]] double inner_poles_seconds() const override { return inner_poles_.seconds; }
  [[nodiscard]] double inner_build_seconds() const override { return inner_build_.seconds; }

 private:
  // What rounds have led to.
  struct Ending {
    AssembledMesh result;
    std::vector<bool> is_polygonized;  // of each component in it
    std::vector<Box3> inverted;        // umbrellas left in it
    bool is_apart = false;
    RepairStats stats;
  };

  void mend_by_rounds();
  void build();
  void mend_vertices();
  void mend_crossing();
  void mend_left_out();
  std::optional<Ending> mend_around(std::span<const std::uint32_t> crossings);
  [[nodiscard]] SelfIntersections crossing_triangles() const;
  [[nodiscard]] std::vector<std::uint32_t> missed(std::span<const Box3> boxes) const;
  Ending take_ending();
  void return_to(Ending ending);
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
  AssembledMesh result_;              // at last
  std::vector<bool> is_polygonized_;  // of each component in it
  std::vector<Box3> inverted_;        // umbrellas left in it
  bool is_apart_ = false;             // its triangles are known not to cross; taking vertices out keeps that
  bool is_assembled_ = false;         // rounds ended with it, foreign vertices taken out
  bool is_as_it_was_ = false;         // the run had to end before any round
  StageStats inner_poles_, inner_build_;
};

}  // namespace deliso

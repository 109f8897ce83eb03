// A run of the mesher: what its steps share. The lines of the paper are in deliso.cpp, what comes after RefineGeom in
// pipeline_end.cpp.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surface/base/controls.h"
#include "surface/base/exact_surface.h"
#include "surface/base/sizes.h"
#include "surface/certificate/component_assignment.h"
#include "surface/certificate/promise.h"
#include "surface/certificate/repeated_check.h"
#include "surface/deliso.h"
#include "surface/extract/recovered_surface.h"
#include "surface/mesh/known_triangles.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/repair/diagnosis/exact_surface_cache.h"
#include "surface/repair/finish/last_resort.h"
#include "surface/restricted/restricted_delaunay.h"

namespace deliso {

class CellsNearFaults;

// One run. What the paper does not have stands between its lines: the exact topology, which a certificate needs, first;
// coverage after Recover; repair around ComputePoles and BuildTriMesh; the certificate at the end.
class Pipeline {
 public:
  // Keeps references to all of them.
  Pipeline(const ScalarGrid& grid, const MeshingOptions& options, MeshingResult& result);

  void run(double isovalue);

 private:
  // How freely steps leave the isosurface to bring triangles near it: with more, crossings of one component would be
  // reached from another that is near.
  static constexpr double kFreeSteps = 2;

  // Less than the promised distance, for the mesh moves by rounding when it is written.
  [[nodiscard]] double kept_distance() const { return promised_distance(parameters_) - rounding_; }
  void note_promised();
  [[nodiscard]] Promise stated() const;  // the promise as others are told of it

  using DelS = std::unique_ptr<RestrictedDelaunay>;  // Del S restricted to the isosurface

  void find_exact_surface(double isovalue);
  // Init, Recover, repair and BuildTriMesh. Recover takes in these samples, too, where the mesh of a first time has
  // been too far from the isosurface.
  SurfaceMesh stage1(std::span<const Vec3> samples);
  DelS recover_topology(DelS del_s0, std::span<const Vec3> samples);
  SurfaceMesh mended_mesh(DelS del_s1, std::span<const Vec3> samples);
  SurfaceMesh refine(SurfaceMesh mesh);
  std::unique_ptr<RecoveredSurface> mended(DelS del_s1, std::span<const Vec3> samples);
  void take_inner_seconds(const RecoveredSurface& recovered);

  // After RefineGeom (pipeline_end.cpp, pipeline_faults.cpp, pipeline_error.cpp, pipeline_sizes.cpp).
  void finish(SurfaceMesh& mesh, const RefineOptions& options);
  void improve(SurfaceMesh& mesh, int most_rounds);
  bool come_near(SurfaceMesh& mesh, const RefineOptions& options);
  void improve_near(SurfaceMesh& mesh);
  void refine_by_distance(SurfaceMesh& mesh, RefineOptions options, RepeatedCheck& check);
  void bring_near_by_steps(SurfaceMesh& mesh, RepeatedCheck& check);
  void improve_while_near(SurfaceMesh& mesh, RepeatedCheck& check);
  void drop_components(SurfaceMesh& mesh);
  void limit_edges(SurfaceMesh& mesh, RefineOptions options);
  void fit_sizes(SurfaceMesh& mesh, const RefineOptions& options);
  void take_steps_nearer(SurfaceMesh& mesh, RepeatedCheck& check, double freedom);
  void replace_far_triangles(SurfaceMesh& mesh, RepeatedCheck& check);
  void bring_decimated_near(SurfaceMesh& mesh, std::span<const Vec3> witnesses);
  void fit_promise(const SurfaceMesh& mesh, const RepeatedCheck& check);
  bool refine_to_error(SurfaceMesh& mesh, RefineOptions options);
  void take_nearer_cubes(SurfaceMesh& mesh);
  void begin_again(SurfaceMesh& mesh);
  void bring_again_near(SurfaceMesh& mesh);
  bool take_nearer_mesh(std::span<const Vec3> samples, SurfaceMesh& mesh, SurfaceMesh& recovered,
                        CellsNearFaults& cells);
  void refine_to_count(SurfaceMesh& mesh, RefineOptions options, std::size_t count);
  bool is_right_within(const SurfaceMesh& mesh, double error);
  void decimate_mesh(SurfaceMesh& mesh, std::span<const Vec3> witnesses, double share);
  void improve_within_promise(SurfaceMesh& mesh, std::span<const Vec3> witnesses, KnownTriangles left = {});
  [[nodiscard]] bool is_compared() const;
  void look_in_world(SurfaceMesh& mesh);
  void separate_in_world(SurfaceMesh& mesh);
  void uncross_by_steps(SurfaceMesh& mesh);
  void find_last_faults(SurfaceMesh& mesh);
  bool merge_in_world(SurfaceMesh& mesh) const;
  MeshFaults shaped_cubes(SurfaceMesh& mesh);
  void take_back_shape(const ShapeStats& before);
  void bring_cubes_near(SurfaceMesh& mesh, MeshFaults& faults);
  MeshFaults faults_of(const SurfaceMesh& mesh);
  void find_places(const SurfaceMesh& mesh, MeshFaults& faults);
  void drop_crossings();
  void certify(SurfaceMesh mesh);

  const ScalarGrid& grid_;
  const MeshingOptions& options_;
  const Parameters& parameters_;
  Controls controls_;
  MeshingResult& result_;

  IsosurfaceTopology topology_;  // empty where nothing needs it
  std::unique_ptr<Isosurface> isosurface_;
  std::optional<ExactSurface> surface_;       // the two
  Box3 r_min_box_;                            // its smallest side is what r_min is a fraction of
  std::unique_ptr<ExactSurfaceCache> cache_;  // what repair compares with; none where nothing is repaired
  std::vector<Vec3> coverage_targets_;        // for RefineGeom
  std::int32_t cube_parts_ = 2;               // of cells of marching cubes, where these have to be nearer
  double rounding_ = 0;                       // see MeshingOptions
  Promise promise_;                           // what is kept before rounding
  MeshFaults last_;                           // of the mesh that RefineGeom has made
  KnownTriangles left_bad_;                   // by the shape stage
};

}  // namespace deliso

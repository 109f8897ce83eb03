// Runs of stage 2 for its tests: on the meshes that stage 1 hands over, with options for small volumes.
#pragma once

#include <utility>
#include <vector>

#include "surface/extract/build_triangle_mesh.h"
#include "surface/recover/recover.h"
#include "surface/refine/refine.h"
#include "surface/restricted/poles.h"
#include "tests/support/surface_fields.h"

namespace deliso::testing {

// What stage 1 hands over.
inline SurfaceMesh stage1_mesh(const Scene& scene) {
  RestrictedDelaunay restricted(*scene.isosurface, scene.start());
  RecoverOptions options;
  options.geometry.r_min = 0.1;
  options.size_bound = 0.3;
  Controls controls(BudgetParameters{}, nullptr, {});
  RecoverStats stats;
  recover(restricted, options, controls, stats);
  BuiltMesh built = build_triangle_mesh(restricted);
  const std::vector<double> heights = compute_poles(restricted);
  for (const VertexId v : built.vertex_of) built.mesh.pole_heights.push_back(heights[v.index()]);
  return std::move(built.mesh);
}

inline RefineOptions fine_options() {
  RefineOptions options;
  options.r_min = 0.25;
  options.slab_triangles = 100;
  return options;
}

inline RefineStats run(SurfaceMesh& mesh, const Scene& scene, const RefineOptions& options,
                       std::vector<SurfaceDelaunayBall>* balls = nullptr) {
  Controls controls(BudgetParameters{}, nullptr, {});
  RefineStats stats;
  refine_geometry(mesh, *scene.isosurface, options, controls, stats, balls);
  return stats;
}

}  // namespace deliso::testing

// The pipeline (Dey and Levine, Figure 4): a volume and an isovalue in, a Delaunay surface mesh out.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "surface/base/controls.h"
#include "surface/base/observer.h"
#include "surface/base/parameters.h"
#include "surface/base/stage_stats.h"
#include "surface/certificate/certificate.h"
#include "surface/mesh/triangle_mesh.h"
#include "surface/recover/recover_options.h"
#include "surface/refine/refine_options.h"
#include "surface/shape/shape_options.h"
#include "surface/sizes/component_filter.h"
#include "surface/sizes/decimation_options.h"
#include "volume/scalar_grid.h"

namespace deliso {

struct MeshingOptions {
  Parameters parameters;
  std::uint64_t seed = 1;
  std::int32_t threads = 1;
  std::function<void(const Progress&)> progress;  // may be empty
  const std::atomic<bool>* stop = nullptr;        // set to true from outside: finish early with a valid partial mesh
  std::string_view stop_cause = "a signal";       // who sets it, for the report
  bool keep_stage1_mesh = false;
  Observer* observer = nullptr;  // told of every step, see there
  // How far points of the mesh may move when it is written, in smallest spacings: so much less than the promised
  // distances is kept, but for at most half of them.
  double rounding = 0;
};

inline constexpr double kMostForRounding = 0.5;  // of the promised distance

struct BuildStats : StageStats {
  // False only without one sign per tetrahedron: the restricted facets bound no set of tetrahedra, so they are the mesh
  // as they are, and stage 2 is left out.
  bool bounds_a_solid = true;
};

struct MeshingResult {
  TriangleMesh mesh;
  std::optional<TriangleMesh> stage1_mesh;  // after Recover, when asked for
  double isovalue_used = 0;
  double share_near_samples = 0;  // of the crossings with grid edges: within a hundredth of the edge of a sample
  double r_min_voxels = 0;        // r_min of stage 2 in smallest spacings
  std::string_view stopped_in;    // the stage in which it stopped (controls.h); else empty
  StageStats index, topology, initial, poles, certify_stage;  // topology: the exact one, found from the grid
  SearchCounters initial_search;                              // of the random rays
  RecoverStats recover;
  BuildStats build;
  RepairStats repair;
  RefineStats refine;
  ShapeStats shape;
  DecimationStats decimation;
  std::vector<DroppedPiece> dropped;    // pieces left out, the largest first; their places are in the world
  std::int64_t dropped_components = 0;  // of the isosurface, on which they lie; fewer where one is in several pieces
  Certificate certificate;
  double longest_edge = 0;       // of the mesh, in smallest spacings
  double promised_distance = 1;  // of mesh and isosurface, in smallest spacings: that of the parameters, or a larger
                                 // one that size.target_vertices took
  double total_seconds = 0;

  [[nodiscard]] bool stopped_early() const { return !stopped_in.empty(); }
};

// Throws InputError when the isovalue is not finite, lies outside the data's range, or the surface has no point.
MeshingResult mesh_isosurface(const ScalarGrid& grid, double isovalue, const MeshingOptions& options);

}  // namespace deliso

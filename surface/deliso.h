// The pipeline (Dey and Levine, Figure 4): a volume and an isovalue in, a Delaunay surface mesh out.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "delaunay/base/counters.h"
#include "surface/certificate.h"
#include "surface/parameters.h"
#include "surface/triangle_mesh.h"
#include "volume/scalar_grid.h"

namespace deliso {

struct StageStats {
  double seconds = 0;
};

struct RecoverStats : StageStats {
  std::int64_t insertions = 0;
  std::int64_t multi_intersect = 0;
  std::int64_t extract_manifold = 0;
  std::int64_t approximate_geometry = 0;
  std::int64_t boundary_splits = 0;        // points of boundary curves among the insertions
  std::int64_t refused_by_size_bound = 0;  // violations left alone because the size bound forbids their point
  SearchCounters search;
  double restricted_seconds = 0;  // time spent deciding which facets are restricted
};

// Why an insertion of stage 2 was refused.
enum class Refusal { kNoHit, kNotADisk, kRepeatedVertex, kExistingEdge, kFlippedTriangle, kTooClose, kCount };
inline constexpr std::array<std::string_view, static_cast<std::size_t>(Refusal::kCount)> kRefusalNames = {
    "no_hit", "not_a_disk", "repeated_vertex", "existing_edge", "flipped_triangle", "too_close"};

struct RefineStats : StageStats {
  std::int64_t insertions = 0;
  std::int64_t boundary_splits = 0;
  std::array<std::int64_t, static_cast<std::size_t>(Refusal::kCount)> refused{};
  std::int64_t stopped_at_r_min = 0;  // triangles that violate a criterion but are not larger than r_min
  SearchCounters search;
};

// What a caller may watch and stop. Called now and then from the mesher's own thread.
struct Progress {
  std::string_view stage;  // "index", "initial", "recover", "poles", "build", "refine", "certify"
  std::int64_t vertices = 0;
  std::int64_t queued = 0;  // violations still waiting
};

struct MeshingOptions {
  Parameters parameters;
  std::uint64_t seed = 1;
  std::int32_t threads = 1;
  std::function<void(const Progress&)> progress;  // may be empty
  const std::atomic<bool>* stop = nullptr;        // set to true from outside: finish early with a valid partial mesh
  bool keep_stage1_mesh = false;
};

struct MeshingResult {
  TriangleMesh mesh;
  std::optional<TriangleMesh> stage1_mesh;  // after Recover, when asked for
  double isovalue_used = 0;
  double r_min_voxels = 0;  // r_min of stage 2 in smallest spacings
  bool stopped_early = false;
  StageStats index, initial, poles, build, certify_stage;
  RecoverStats recover;
  RefineStats refine;
  Certificate certificate;
  double total_seconds = 0;
};

// Throws InputError when the isovalue is not finite, lies outside the data's range, or the surface has no point.
MeshingResult mesh_isosurface(const ScalarGrid& grid, double isovalue, const MeshingOptions& options);

}  // namespace deliso

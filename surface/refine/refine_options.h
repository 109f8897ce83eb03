// The options of stage 2, and its counters.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"
#include "surface/base/criteria.h"
#include "surface/base/observer.h"
#include "surface/base/parameters.h"
#include "surface/base/stage_stats.h"

namespace deliso {

struct RefineOptions {
  double epsilon1 = 0.1;  // largest h / r
  double epsilon2 = 0.2;  // largest r / mean pole height
  double rho = 2;         // largest r / l
  double r_min = 0;       // no refinement of triangles at or below this circumradius, in mesh-space units
  double max_distance = std::numeric_limits<double>::infinity();  // largest h, in mesh-space units
  double h_min = 0;          // criteria 1 and 2 lapse at or below this h where r is no larger than a voxel; 0: never
  int smoothing_passes = 0;  // over the vertices, at the end (smoothing.cpp)
  QueueOrder order = QueueOrder::kWorstFirst;
  // If triangles came to meet, refine again with smaller clearances around them (refine.cpp).
  bool restart_at_crossings = true;
  Criterion2 criterion2 = Criterion2::kCircumradius;
  NewPole new_pole = NewPole::kMean;
  bool store_hits = true;
  // Also keep pole heights; otherwise the refined mesh has only points and triangles.
  bool keep_neighbours = true;
  std::span<const Vec3> coverage_targets;  // points of the surface that the mesh is to come near (coverage_targets.h)
  // If above 0, targets farther than this from all triangles are missed, in mesh-space units; else those at about a
  // voxel.
  double target_reach = 0;
  int threads = 1;                    // the result is the same for any number
  Observer* observer = nullptr;       // of a mesh that is one slab
  std::size_t slab_triangles = 6144;  // approximate number of triangles of stage 1 in a slab (refinement_slabs.h)
};

// The options of RefineGeom from a run's parameters. r_min becomes absolute by a box in mesh space.
RefineOptions refine_options(const Parameters& parameters, const Box3& box, std::span<const Vec3> coverage_targets,
                             int threads);

// The thresholds of RefineGeom.
inline Criteria criteria_of(const RefineOptions& options) {
  return {.epsilon = options.epsilon1,
          .rho = options.rho,
          .r_min = options.r_min,
          .max_distance = options.max_distance,
          .epsilon2 = options.epsilon2,
          .criterion2 = options.criterion2,
          .h_min = options.h_min};
}

// Why an insertion was refused.
enum class Refusal {
  kNoHit,
  kNotADisk,
  kRepeatedVertex,
  kFlippedTriangle,
  kTooClose,
  kTooFar,
  kCrossingTriangle,
  kCount
};
inline constexpr std::array<std::string_view, static_cast<std::size_t>(Refusal::kCount)> kRefusalNames = {
    "no_hit", "not_a_disk", "repeated_vertex", "flipped_triangle", "too_close", "too_far", "crossing_triangle"};

struct RefineStats : StageStats {
  std::int64_t insertions = 0;
  std::int64_t boundary_splits = 0;   // of them on boundary edges
  std::int64_t coverage_targets = 0;  // of them coverage targets that the mesh had missed (coverage_targets.h)
  std::int64_t halvings = 0;          // of them on the longest edge of a coarse triangle whose x_sigma was refused
  std::int64_t flips = 0;             // of edges across folds, which insert nothing
  std::int64_t moves = 0;             // of vertices to where the angles around them are larger
  std::array<std::int64_t, static_cast<std::size_t>(Refusal::kCount)> refused{};  // attempts
  std::int64_t stopped_at_r_min = 0;  // triangles that fail a criterion but are not larger than r_min
  std::int64_t restarts = 0;          // of a slab, or of a round in the whole mesh
  std::int64_t meeting_pairs = 0;     // of triangles that cross or touch, left after the last restart
  SearchCounters search;

  // Adds the counters of a part of the mesh.
  void add(const RefineStats& part) {
    insertions += part.insertions;
    boundary_splits += part.boundary_splits;
    halvings += part.halvings;
    flips += part.flips;
    moves += part.moves;
    coverage_targets += part.coverage_targets;
    for (std::size_t i = 0; i < refused.size(); ++i) refused[i] += part.refused[i];
    restarts += part.restarts;
    meeting_pairs += part.meeting_pairs;
    search += part.search;
  }
};

}  // namespace deliso

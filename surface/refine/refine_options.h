// What stage 2 is asked for, and what it tells of its work.
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
#include "surface/base/parameters.h"
#include "surface/base/stage_stats.h"

namespace deliso {

struct RefineOptions {
  double epsilon1 = 0.1;  // largest h / r
  double epsilon2 = 0.2;  // largest r / mean pole height
  double rho = 2;         // largest r / l
  double r_min = 0;       // no refinement of triangles at or below this circumradius, in mesh-space units
  double max_distance = std::numeric_limits<double>::infinity();  // largest h, in mesh-space units
  QueueOrder order = QueueOrder::kWorstFirst;
  bool restart_at_crossings = true;  // where triangles came to meet, begin again with more care around them
  Criterion2 criterion2 = Criterion2::kCircumradius;
  NewPole new_pole = NewPole::kMean;
  bool store_hits = true;
  bool keep_neighbours = true;             // and pole heights; or else the refined mesh has points and triangles alone
  std::span<const Vec3> coverage_targets;  // points of the surface that the mesh is to come near (coverage_targets.h)
  int threads = 1;                         // the result is the same for any number
  std::size_t slab_triangles = 6144;       // of stage 1 in a slab (refinement_slabs.h), about
};

// What RefineGeom is asked for by a run's parameters; lengths are made absolute by the volume's box (in mesh space).
RefineOptions refine_options(const Parameters& parameters, const Box3& box, std::span<const Vec3> coverage_targets,
                             int threads);

// The thresholds of RefineGeom.
inline Criteria criteria_of(const RefineOptions& options) {
  return {.epsilon = options.epsilon1,
          .rho = options.rho,
          .r_min = options.r_min,
          .max_distance = options.max_distance,
          .epsilon2 = options.epsilon2,
          .criterion2 = options.criterion2};
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
  std::int64_t coverage_targets = 0;  // of them points that the mesh had missed (coverage_targets.h)
  std::int64_t halvings = 0;          // of them on the longest edge of a coarse triangle, x_sigma having been refused
  std::array<std::int64_t, static_cast<std::size_t>(Refusal::kCount)> refused{};  // attempts
  std::int64_t stopped_at_r_min = 0;  // triangles that fail a criterion but are not larger than r_min
  std::int64_t restarts = 0;          // of a slab, or of what is done in the whole
  SearchCounters search;

  // Adds what is counted in a part of the mesh.
  void add(const RefineStats& part) {
    insertions += part.insertions;
    boundary_splits += part.boundary_splits;
    halvings += part.halvings;
    coverage_targets += part.coverage_targets;
    for (std::size_t i = 0; i < refused.size(); ++i) refused[i] += part.refused[i];
    restarts += part.restarts;
    search += part.search;
  }
};

}  // namespace deliso

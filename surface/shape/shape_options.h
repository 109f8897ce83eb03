// The options of the shape stage, and its counters.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

#include "delaunay/base/vec3.h"
#include "raycast/isosurface.h"
#include "surface/base/parameters.h"
#include "surface/base/stage_stats.h"

namespace deliso {

struct ShapeOptions {
  double min_angle = 0;      // radians: triangles with a smaller angle are improved
  int rounds = 0;            // 0: none are
  double max_height = 0.25;  // mesh-space units: no new triangle's centroid is farther from the isosurface, unless one
                             // of the triangles that it replaces was
  double max_edge = std::numeric_limits<double>::infinity();    // mesh-space units: no new edge is longer, unless one
                                                                // that it replaces was
  double max_sample = std::numeric_limits<double>::infinity();  // mesh-space units: no part of a new triangle is
                                                                // farther, unless some of what it replaces was
  double max_distance = 0.75;   // mesh-space units: crossings of the isosurface that the mesh is so near stay so
  std::vector<Vec3> witnesses;  // other points of the isosurface for which the same holds
};

ShapeOptions shape_options(const Parameters& parameters);

// What takes the place of a few triangles (shape_steps.h).
enum class ShapeStep { kFlip, kRemove, kMove, kMerge, kSplit, kInsert, kCount };
inline constexpr std::array<std::string_view, static_cast<std::size_t>(ShapeStep::kCount)> kShapeStepNames = {
    "flips", "removals", "moves", "merges", "splits", "insertions"};

// A triangle that is left with an angle below min_angle.
struct BadTriangle {
  double sine = 0;  // of its smallest angle
  Vec3 centroid;    // in mesh space; in the world in the result of a run

  [[nodiscard]] double degrees() const { return std::asin(std::min(1.0, sine)) * 180 / std::numbers::pi; }
};

struct ShapeStats : StageStats {
  std::int64_t bad_before = 0;  // triangles with an angle below min_angle
  std::int64_t bad_after = 0;
  std::vector<BadTriangle> worst;  // of those left, the worst first
  std::array<std::int64_t, static_cast<std::size_t>(ShapeStep::kCount)> steps{};
  std::size_t turns = 0;  // of iterated search, as planned, over all triangles searched for
  SearchCounters search;

  // Adds the counters of steps and searches of a patch.
  void add(const ShapeStats& part) {
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] += part.steps[i];
    search += part.search;
  }
  void keep_worst(std::size_t most) {
    std::stable_sort(worst.begin(), worst.end(),
                     [](const BadTriangle& a, const BadTriangle& b) { return a.sine < b.sine; });
    worst.resize(std::min(worst.size(), most));
  }
};

}  // namespace deliso

// The options of stage 1, and its counters.
#pragma once

#include <cstdint>

#include "delaunay/base/box3.h"
#include "raycast/isosurface.h"
#include "surface/base/criteria.h"
#include "surface/base/parameters.h"
#include "surface/base/stage_stats.h"

namespace deliso {

struct RecoverOptions {
  Criteria geometry;                  // when a restricted triangle is too coarse
  NewPole new_pole = NewPole::kMean;  // of a new vertex, where pole heights are known
  double size_bound = 0;              // no insertion nearer than this to a vertex
  QueueOrder order = QueueOrder::kWorstFirst;
  int threads = 1;  // the result is the same for any number
};

// The options of Recover from a run's parameters. r_min becomes absolute by a box in mesh space.
RecoverOptions recover_options(const Parameters& parameters, const Box3& box, int threads);
// The same for Recover to the thresholds of stage 2, without a stage 2 (the "3D" column of the paper's Table 2).
RecoverOptions full3d_options(const Parameters& parameters, const Box3& box);

struct RecoverStats : StageStats {
  std::int64_t insertions = 0;
  std::int64_t multi_intersect = 0;  // insertions by each of the three steps
  std::int64_t extract_manifold = 0;
  std::int64_t approximate_geometry = 0;
  std::int64_t uncovered = 0;        // crossings far from the mesh
  std::int64_t boundary_splits = 0;  // points of boundary curves among the insertions
  std::int64_t in_slabs = 0;         // insertions in slabs of the volume that several threads refine
  // How often the size bound forbade the point that a violation asked for. One violation may ask more than once.
  std::int64_t refused_by_size_bound = 0;
  std::int64_t hits_against_signs = 0;  // dual edges whose hits contradicted the signs at their ends
  SearchCounters search;
  double restricted_seconds = 0;  // time spent deciding which facets are restricted

  // Adds the counters of a part.
  void add(const RecoverStats& part) {
    insertions += part.insertions;
    multi_intersect += part.multi_intersect;
    extract_manifold += part.extract_manifold;
    approximate_geometry += part.approximate_geometry;
    boundary_splits += part.boundary_splits;
    refused_by_size_bound += part.refused_by_size_bound;
    search += part.search;
  }
};

}  // namespace deliso

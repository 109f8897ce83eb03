// Stage 1 (Dey and Levine, section 3.1): refine the restricted Delaunay triangulation until it has the surface's
// topology.
//
// The paper's three steps run as one loop over a queue of violations, in the priority MultiIntersect, ExtractManifold,
// ApproximateGeom. Every insertion keeps a distance from all vertices (the size bound), without which the loop does not
// end at the creases of the trilinear interpolant.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "surface/controls.h"
#include "surface/parameters.h"
#include "surface/restricted_delaunay.h"

namespace deliso {

// When a restricted triangle larger than r_min is too coarse. Lengths in mesh-space units.
struct GeometryCriterion {
  double epsilon = 0.2;  // largest h / r
  double rho = 2;        // largest r / l
  double r_min = 0;
  double max_distance = std::numeric_limits<double>::infinity();  // largest h
  double epsilon2 = std::numeric_limits<double>::infinity();      // largest r / mean pole height; needs pole heights
  Criterion2 criterion2 = Criterion2::kCircumradius;              // or l / mean pole height
  NewPole new_pole = NewPole::kMean;
};

struct RecoverOptions {
  GeometryCriterion geometry;
  double size_bound = 0;  // no insertion nearer than this to a vertex
  QueueOrder order = QueueOrder::kWorstFirst;
  int threads = 1;  // the result is the same for any number
};

struct StageStats {
  double seconds = 0;
};

struct RecoverStats : StageStats {
  std::int64_t insertions = 0;
  std::int64_t multi_intersect = 0;  // insertions by each of the three steps
  std::int64_t extract_manifold = 0;
  std::int64_t approximate_geometry = 0;
  std::int64_t uncovered = 0;              // crossings far from the mesh
  std::int64_t boundary_splits = 0;        // points of boundary curves among the insertions
  std::int64_t in_slabs = 0;               // insertions in parts of the volume that several threads refine
  std::int64_t refused_by_size_bound = 0;  // violations left alone because the size bound forbids their point
  std::int64_t hits_against_signs = 0;     // dual edges whose hits contradicted the signs at their ends
  SearchCounters search;
  double restricted_seconds = 0;  // time spent deciding which facets are restricted

  // Adds what a part has done.
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

// Runs until no violation is left that the size bound lets us mend, or `controls` say stop. `pole_heights`, one for
// each vertex, is needed for a finite epsilon2; new vertices inherit from their neighbours (new_pole).
void recover(RestrictedDelaunay& restricted, const RecoverOptions& options, Controls& controls, RecoverStats& stats,
             std::vector<double>* pole_heights = nullptr);

// Inserts points of the surface, as far as the size bound lets it, and runs until no violation is left that they have
// caused: for a triangulation that recover() has left without others, with the same options. Returns how many of the
// points went in; they count as `uncovered`.
std::int64_t recover_with(RestrictedDelaunay& restricted, std::span<const Vec3> points, const RecoverOptions& options,
                          Controls& controls, RecoverStats& stats);

}  // namespace deliso

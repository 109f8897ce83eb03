// Repair: resample the surface where its mesh differs from the exact topology, and only there, until nothing differs.
//
// Rounds of: build the mesh; match its pieces with the exact components; flag the voxel cells near the trouble of those
// that do not match; raise each flagged cell one level of the sample lattice (its free samples go, lattice samples
// come); take the sign of small tetrahedra in flagged cells at their centroid, because the circumcenter of a flat
// tetrahedron in a thin wedge lies far outside the wedge. Each component keeps its piece of the first round in which it matches.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "surface/build_triangle_mesh.h"
#include "surface/component_match.h"
#include "surface/controls.h"
#include "surface/recover.h"
#include "surface/signed_delaunay.h"
#include "volume/exact_topology.h"

namespace deliso {

struct RepairStats : StageStats {
  std::int64_t rounds = 0;         // resamplings made
  std::int64_t best_round = 0;     // the one kept; 0 is the mesh as it came
  std::int64_t points_before = 0;  // vertices of the triangulation before and after
  std::int64_t points_after = 0;
  std::int64_t unmatched_before = 0;  // exact components without their match, before and after
  std::int64_t unmatched_after = 0;
};

// `restricted` is what stage 1 left; it is replaced round by round to save memory.
SurfaceMesh repair(const ScalarGrid& grid, const IsosurfaceTopology& topology,
                    std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds, Controls& controls,
                    RepairStats& stats);

}  // namespace deliso

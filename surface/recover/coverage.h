// Whether a mesh covers the isosurface. A thin finger of the surface may lie within one Voronoi cell, so that no dual
// edge meets it and the topology of the mesh does not show it.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/base/controls.h"
#include "surface/base/exact_surface.h"
#include "surface/recover/recover_options.h"
#include "surface/restricted/restricted_delaunay.h"

namespace deliso {

// Returns the grid-edge crossings that the mesh of the triangulation does not cover (see CoverageQuery), for insertion
// by stage 1. `suspects` are the crossings to query (indices into topology.crossings); the uncovered ones stay in it.
// `coverage_targets`, if given, receives the crossings that are not close to the mesh (CoverageQuery::look), covered or
// not. The same for any number of threads.
std::vector<Vec3> uncovered_points(const RestrictedDelaunay& restricted, const ExactSurface& surface,
                                   std::vector<std::uint32_t>& suspects, std::vector<Vec3>* coverage_targets = nullptr);

// Runs Recover again after inserting samples of the parts that the mesh misses. `restricted` must be the result of
// recover() with the same options. Returns, if wanted, the coverage targets of uncovered_points() before the first
// insertion.
std::vector<Vec3> recover_missed_parts(RestrictedDelaunay& restricted, const ExactSurface& surface,
                                       const RecoverOptions& options, bool wants_targets, Controls& controls,
                                       RecoverStats& stats);

// All crossings, in an order in which neighbours in space are near each other.
std::vector<std::uint32_t> all_crossings(const ExactSurface& surface);

}  // namespace deliso

// Whether a mesh covers the isosurface: a finger of the surface may hide within one Voronoi cell, where neither
// topology nor any dual edge tells of it.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/base/controls.h"
#include "surface/base/exact_surface.h"
#include "surface/recover/recover_options.h"
#include "surface/restricted/restricted_delaunay.h"

namespace deliso {

// The grid-edge crossings that the mesh of the triangulation does not cover (see CoverageQuery): for stage 1 to insert.
// `suspects` are the crossings to ask about (places in topology.crossings); those that are not covered stay in it.
// `coverage targets`, when asked for, gets those that the mesh is not close to (CoverageQuery::look), covered or not.
// The same for any number of threads.
std::vector<Vec3> uncovered_points(const RestrictedDelaunay& restricted, const ExactSurface& surface,
                                   std::vector<std::uint32_t>& suspects, std::vector<Vec3>* coverage_targets = nullptr);

// Recovers again with samples of the parts that the mesh misses: for a triangulation that recover() has left, with the
// same options. Returns, if wanted, the targets of uncovered_points() before anything was inserted.
std::vector<Vec3> recover_missed_parts(RestrictedDelaunay& restricted, const ExactSurface& surface,
                                       const RecoverOptions& options, bool wants_targets, Controls& controls,
                                       RecoverStats& stats);

// All crossings, in an order that keeps neighbours together.
std::vector<std::uint32_t> all_crossings(const ExactSurface& surface);

}  // namespace deliso

// InitTriangulation of the paper: what stage 1 starts from.
#pragma once

#include <cstdint>
#include <memory>

#include "raycast/isosurface.h"
#include "surface/base/controls.h"
#include "surface/base/parameters.h"
#include "surface/restricted/restricted_delaunay.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

// The triangulation of random points of the isosurface, of its boundary curves and of seeds on every component, as
// `parameters` ask for them. Random points end when `controls` say stop. Throws InputError where these points are too
// few. Precondition: `topology` is known where seeds are wanted.
std::unique_ptr<RestrictedDelaunay> initial_triangulation(const ScalarGrid& grid, const Isosurface& isosurface,
                                                          const IsosurfaceTopology& topology,
                                                          const Parameters& parameters, std::uint64_t seed, int threads,
                                                          Controls& controls, SearchCounters& counters);

}  // namespace deliso

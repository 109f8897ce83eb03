// InitTriangulation of the paper: what stage 1 starts from.
#pragma once

#include <cstdint>
#include <memory>

#include "surface/base/controls.h"
#include "surface/base/exact_surface.h"
#include "surface/base/parameters.h"
#include "surface/restricted/restricted_delaunay.h"

namespace deliso {

// The triangulation of random points of the isosurface, of points of its boundary curves, and of seeds on every
// component, as `parameters` say. No more random points are made once `controls` say stop. Throws InputError when there
// are too few points. Precondition: `topology` is known if seeds are wanted.
std::unique_ptr<RestrictedDelaunay> init_triangulation(const ExactSurface& surface, const Parameters& parameters,
                                                       std::uint64_t seed, Controls& controls,
                                                       SearchCounters& counters);

}  // namespace deliso

// Where stage 1 starts: points on every component of the isosurface, or the hits of random rays.
#pragma once

#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "raycast/isosurface.h"
#include "surface/base/controls.h"
#include "surface/base/exact_surface.h"

namespace deliso {

// A component with up to this many grid-edge crossings is seeded with all of them.
inline constexpr std::size_t kSmallComponent = 12;

// Seeds on each component, in mesh space: all crossings of a small one, else its extreme crossings in fourteen
// directions.
std::vector<Vec3> component_seeds(const ExactSurface& surface);

// `count` points of the isosurface hit by random lines through the box, in mesh space (InitTriangulation of the paper).
// Fewer when 1000 lines in a row miss, or when `controls` say stop. `controls` are asked from the 1000th point on, so
// there is always something to start from.
std::vector<Vec3> random_ray_points(const Isosurface& isosurface, std::int32_t count, Rng& rng,
                                    SearchCounters& counters, Controls* controls = nullptr);

}  // namespace deliso

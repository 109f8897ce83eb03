// The order in which points are inserted: random rounds, each along a Hilbert curve.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"

namespace deliso {

// A biased randomized insertion order (Amenta, Choi, Rote: Incremental constructions con BRIO, 2003): a permutation of
// the indices of `points`. Each round is about seven times as large as all rounds before it; within a round, points
// follow a Hilbert curve, refined where many points share one of its cells.
//
// The round of a point is drawn from a hash of its coordinates: no random state, and equal points stay together, in the
// order of their indices. Points must be finite.
std::vector<std::uint32_t> spatial_order(std::span<const Vec3> points);

}  // namespace deliso

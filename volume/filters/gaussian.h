// Smoothing by a Gaussian, for masks and noise.
#pragma once

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso {

// The samples of the convolution with a Gaussian of standard deviation `sigma` (in spacings along each axis; 0 leaves
// an axis as it is). The Gaussian is sampled at the grid's points, cut off at 4 sigma and scaled to the sum 1; beyond
// the box the field goes on as at the nearest point of the box. Sums are of doubles, in an order that depends on
// nothing but sigma, so the result is the same to the last bit for any number of threads, and of a reflected volume it
// is the reflected one. It has floats, or doubles where the samples are doubles or 32-bit integers.
// Throws InputError when a sigma is negative, not finite or above 1000.
ScalarGrid smoothed(const ScalarGrid& grid, const Vec3& sigma, int threads);

// The same standard deviation along all axes, in voxels: smallest components of `spacing`.
Vec3 sigma_in_spacings(double sigma, const Vec3& spacing);

}  // namespace deliso

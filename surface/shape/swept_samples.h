// Whether a step of the shape stage moves the mesh across a sample of the grid. The sides of the samples are what the
// isosurface is made of: a bubble as small as a few hundredths of a voxel stands around a sample, and a mesh that
// leaves that sample out is turned against the field there, however near it lies. Needed by fields of few values, where
// such bubbles are many.
#pragma once

#include <array>
#include <span>

#include "raycast/isosurface.h"

namespace deliso {

// True when such a sample lies between the triangles that a step removes and those that it adds, which have the same
// rim (at the boundary: up to a part of a face of the box), and when it lies on them and its bubble leaves it. Measured
// by solid angles.
bool sweeps_lone_sample(std::span<const std::array<Vec3, 3>> removed, std::span<const std::array<Vec3, 3>> added,
                        const Isosurface& isosurface);

}  // namespace deliso

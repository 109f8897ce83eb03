// The sphere that the tests of pictures look at.
#pragma once

#include "tests/support/mesh_fields.h"

namespace deliso::testing {

inline constexpr double kRadius = 9.3;
inline constexpr Vec3 kCentre{12.1, 11.7, 12.4};

// The distance inwards from the sphere; the isosurface at 0 is the sphere, but for 0.02 voxels or so.
inline ScalarGrid sphere_grid() { return sampled({25, 25, 25}, ball_field(kCentre, kRadius)); }

}  // namespace deliso::testing

// What stage 2 measures of triangles (Dey and Levine, section 3.2), for several of them side by side. Each gets what
// the plain formulas give it alone, to the last bit: circumcircle() of delaunay/constructions.h and
// refine_geometry_badness() of surface/base/criteria.h (tests/surface/refine/triangle_lanes_test.cpp).
#pragma once

#include "delaunay/base/lanes.h"
#include "raycast/line.h"
#include "surface/base/criteria.h"

namespace deliso {

struct TriangleLanes {
  Vec3Lanes a, b, c;  // corners, counterclockwise seen from the side of lower values
  Lanes mean_pole{};

  // From the corners alone.
  LineLanes dual;           // from the circumcenter along the unit normal
  Lanes radius{};           // the circumradius; not finite for a triangle without area
  Lanes shortest{};         // the length of the shortest edge
  Lanes squared_longest{};  // of the longest edge

  Lanes height{};  // where the dual line hits the isosurface

  // From all of these.
  Vec3Lanes x;             // the hit
  Lanes squared_radius{};  // of the ball around it
  Lanes badness{};         // refine_geometry_badness of each
};

void measure_in_planes(TriangleLanes& triangles);
void measure_balls(TriangleLanes& triangles, const Criteria& limits);

}  // namespace deliso

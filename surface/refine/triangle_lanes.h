// What stage 2 measures of triangles (Dey and Levine, section 3.2), for several of them side by side.
#pragma once

#include "delaunay/base/lanes.h"
#include "raycast/line.h"

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
  Lanes badness{};         // the largest of the criteria's ratios to their thresholds: above 1 it is too coarse
};

// The criteria of stage 2 (refine.h).
struct BadnessLimits {
  double epsilon1 = 0, epsilon2 = 0, rho = 0, max_distance = 0;
  bool by_shortest_edge = false;  // the second one compares the shortest edge, not the circumradius
};

void measure_in_planes(TriangleLanes& triangles);
void measure_balls(TriangleLanes& triangles, const BadnessLimits& limits);

}  // namespace deliso

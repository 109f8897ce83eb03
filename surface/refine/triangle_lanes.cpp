#include "surface/refine/triangle_lanes.h"

#include <cmath>

namespace deliso {

namespace {

[[gnu::always_inline]] inline double smaller(double a, double b) { return b < a ? b : a; }

struct MeasureInPlanes {
  [[gnu::always_inline]] static void run(TriangleLanes& triangles) {
    LineLanes dual;
    Lanes radius, shortest, longest;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Vec3 a = triangles.a.at(i), b = triangles.b.at(i), c = triangles.c.at(i);
      const double ab = squared_distance(a, b), bc = squared_distance(b, c), ca = squared_distance(c, a);
      shortest[i] = std::sqrt(smaller(smaller(ab, bc), ca));
      longest[i] = larger(larger(ab, bc), ca);
      // The circumcircle as constructions.h has it: from the corner opposite the longest edge.
      const bool from_b = ca > bc, from_c = ab > larger(ca, bc);
      const Vec3 corner = choose(from_c, c, choose(from_b, b, a));
      const Vec3 u = choose(from_c, a, choose(from_b, c, b)) - corner;
      const Vec3 v = choose(from_c, b, choose(from_b, a, c)) - corner;
      const Vec3 around = cross(u, v);
      const Vec3 offset = cross(squared_norm(u) * v - squared_norm(v) * u, around) / (2 * squared_norm(around));
      radius[i] = norm(offset);
      const Vec3 normal = cross(b - a, c - a);
      dual.set(i, {corner + offset, normal / norm(normal)});
    }
    triangles.dual = dual;
    triangles.radius = radius;
    triangles.shortest = shortest;
    triangles.squared_longest = longest;
  }
};

struct MeasureBalls {
  [[gnu::always_inline]] static void run(TriangleLanes& triangles, const Criteria& limits) {
    const Criteria limit = limits;
    Vec3Lanes x;
    Lanes squared_radius, badness;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double h = std::abs(triangles.height[i]);
      const Vec3 hit = triangles.dual.at(i).at(triangles.height[i]);
      x.set(i, hit);
      squared_radius[i] = squared_distance(hit, triangles.a.at(i));
      badness[i] =
          refine_geometry_badness({h, triangles.radius[i], triangles.shortest[i], triangles.mean_pole[i]}, limit);
    }
    triangles.x = x;
    triangles.squared_radius = squared_radius;
    triangles.badness = badness;
  }
};

}  // namespace

void measure_in_planes(TriangleLanes& triangles) { run_in_lanes<MeasureInPlanes>(triangles); }

void measure_balls(TriangleLanes& triangles, const Criteria& limits) { run_in_lanes<MeasureBalls>(triangles, limits); }

}  // namespace deliso

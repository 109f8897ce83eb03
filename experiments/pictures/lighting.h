// How bright and of what colour a point of a surface is.
#pragma once

#include <array>
#include <cstdint>

#include "delaunay/base/vec3.h"

namespace deliso {

// Linear red, green, blue; 0 to 1.
using Colour = Vec3;

// What is known of a surface point when it gets its colour.
struct LitPoint {
  Vec3 normal;          // of unit length, towards the eye, in the camera's frame: x right, y up, z towards the eye
  bool outside = true;  // seen from the side of lower values: the two sides have two colours
  double openness = 1;  // how much of its surroundings is free, 0 to 1: light from everywhere
  double line = 0;      // how much of it a line covers, 0 to 1
};

// Two lights and some of it from everywhere: one light over the left shoulder, a weaker one from the eye.
Colour lit(const LitPoint& point);

// The eight-bit sRGB values of a linear colour.
std::array<std::uint8_t, 3> srgb(const Colour& colour);

}  // namespace deliso

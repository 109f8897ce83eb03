// The brightness and colour of a point of a surface.
#pragma once

#include <array>
#include <cstdint>

#include "delaunay/base/vec3.h"

namespace deliso {

// Linear red, green, blue; 0 to 1.
using Colour = Vec3;

// The data of a surface point that determine its colour.
struct LitPoint {
  Vec3 normal;          // of unit length, towards the eye, in the camera's frame: x right, y up, z towards the eye
  bool outside = true;  // seen from the side of lower values: the two sides have two colours
  double openness = 1;  // fraction of its surroundings that is free, 0 to 1: weights the ambient light
  double line = 0;      // fraction of it that a line covers, 0 to 1
};

// Ambient light and two lights: one from over the viewer's left shoulder, and a weaker one from the eye.
Colour lit(const LitPoint& point);

// The eight-bit sRGB values of a linear colour.
std::array<std::uint8_t, 3> srgb(const Colour& colour);

}  // namespace deliso

// The part of a segment that lies within a tetrahedron, as far as that is beyond doubt.
#pragma once

#include "delaunay/base/vec3.h"
#include "delaunay/tetrahedralization.h"

namespace deliso {

// From a at s = 0 to b at s = 1.
struct Segment {
  Vec3 a;
  Vec3 b;
};

// The tetrahedron that holds some point of a segment.
struct SegmentClip {
  TetId tet;
  // Points of the segment with 0 <= s <= 1 and from < s < to, as halving rounds them, lie strictly within it; none
  // where from >= to.
  double from = 1;
  double to = 0;

  [[nodiscard]] bool surely_holds(double s) const { return from < s && s < to; }
};

// Precondition: the tetrahedron is finite.
SegmentClip clip_segment(const Tetrahedralization& tets, TetId t, const Segment& segment);

}  // namespace deliso

// Triangles that span what is no isosurface: across a fold or between two sheets that nearly meet.
//
// The topology of a piece may be right with such triangles: a handle is closed at one place, and one too many stands at
// another, along one axis, so that Euler curves do not tell. Stage 2 has no hit to insert there, and no step brings
// them near the isosurface: stage 1 would have to run again (four of eighty runs on scans, thrice as long by it).
#pragma once

#include <cstdint>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/repair/diagnosis/index_ranges.h"
#include "surface/repair/diagnosis/matched_mesh.h"

namespace deliso {

struct SpanningTriangle {
  std::uint32_t component = 0;  // of the isosurface
  IndexBox box{};               // sample layers around the triangle
};

// Those of the main pieces of components not done whose topology is right. A triangle counts when it has a part farther
// than `max_distance` from the isosurface, faces higher values at a corner, and the isosurface is not where it faces:
// no hit along its normal is within half of its longest edge. Components with more than a few of them are left to
// stage 2. Ascending by component. The same for any number of threads.
std::vector<SpanningTriangle> spanning_triangles(const MatchedMesh& mesh, const ExactSurface& surface,
                                                 const std::vector<bool>& done, double max_distance);

}  // namespace deliso

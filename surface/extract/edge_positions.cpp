#include "surface/extract/edge_positions.h"

#include <limits>

namespace deliso {

std::vector<Vec3> positions_on(const SubdividedEdge& edge, const Isosurface& isosurface, std::size_t most) {
  const auto& [a, b, normal] = edge;
  const Box3& box = isosurface.box();
  std::vector<Vec3> positions;
  SearchCounters ignored;
  for (const double facing : {1.0, -1.0}) {
    for (const double weight : {0.5, 0.3, 0.7, 0.15, 0.85, 0.05, 0.95, 0.01, 0.99, 0.002, 0.998}) {
      const Vec3 from = a + weight * (b - a);
      for (Vec3 direction : {facing * normal, -facing * isosurface.gradient(from)}) {
        if (positions.size() == most) return positions;
        for (std::size_t axis = 0; axis < 3; ++axis) {  // a vertex on an edge in a face of the box stays in that face
          if (a[axis] == b[axis] && (a[axis] == box.low[axis] || a[axis] == box.high[axis])) direction[axis] = 0;
        }
        if (!(norm(direction) > 0)) continue;
        const Line line{from, direction / norm(direction)};
        const auto hit = isosurface.nearest_falling_hit(line, distance(a, b), ignored);
        if (hit && box.contains(line.at(*hit))) positions.push_back(line.at(*hit));
      }
    }
  }
  if (positions.size() < most) positions.push_back(0.5 * (a + b));
  return positions;
}

void find_other_positions(std::vector<PinchGroup>& groups, const Isosurface& isosurface) {
  for (PinchGroup& group : groups) {
    for (Copy& copy : group) {
      if (!copy.is_on_edge) continue;
      copy.other_positions = positions_on(copy.edge, isosurface, std::numeric_limits<std::size_t>::max());
      copy.other_positions.erase(copy.other_positions.begin());  // its own
    }
  }
}

}  // namespace deliso

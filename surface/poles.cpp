#include "surface/poles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "delaunay/constructions.h"

namespace deliso {

std::vector<double> compute_poles(const SignedDelaunay& restricted) {
  const Tetrahedralization& delaunay = restricted.delaunay();

  // All four vertices of a tetrahedron are equally far from its Voronoi vertex; that of a ghost lies at infinity.
  std::vector<std::array<double, 2>> farthest(delaunay.vertex_count(), {0, 0});  // squared, below and above
  for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
    const TetId t(i);
    if (!delaunay.is_live(t)) continue;
    const auto& v = delaunay.vertices(t);
    double squared_radius = std::numeric_limits<double>::infinity();
    if (!delaunay.is_ghost(t)) {
      const Vec3 center =
          circumcenter(delaunay.point(v[0]), delaunay.point(v[1]), delaunay.point(v[2]), delaunay.point(v[3]));
      squared_radius = squared_distance(center, delaunay.point(v[0]));
    }
    for (const VertexId q : v) {
      if (delaunay.is_ghost(t) && (q == kInfiniteVertex || restricted.is_on_box(q))) continue;
      double& side = farthest[q.index()][restricted.is_above(t) ? 1 : 0];
      side = std::max(side, squared_radius);
    }
  }

  const double diagonal = restricted.isosurface().box().diagonal();
  std::vector<double> heights(delaunay.vertex_count(), diagonal);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    for (const double squared : farthest[i]) {
      if (squared > 0) heights[i] = std::min(heights[i], std::sqrt(squared));
    }
  }
  return heights;
}

}  // namespace deliso

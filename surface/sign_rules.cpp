#include "surface/sign_rules.h"

#include <algorithm>
#include <array>
#include <vector>

#include "surface/evidence.h"

namespace deliso {

namespace {

// Tetrahedra with an edge longer than this (mesh-space units) keep the sign of their circumcenter everywhere.
constexpr double kLongEdge = 2;
// Gradients at vertices are taken a little towards the centroid: vertices lie on cell sides, where the gradient jumps.
constexpr double kInwards = 1e-5;

struct Shape {
  Vec3 centroid;
  bool is_small = false;
};

// Of a ghost behind a facet on the box: that of the facet, for there the surface's boundary curve is decided.
Shape shape_of(const SignedDelaunay& restricted, TetId t) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  const auto& v = delaunay.vertices(t);
  const bool is_ghost = delaunay.is_ghost(t);
  const unsigned corners = is_ghost ? 3 : 4;
  Vec3 sum;
  double longest = 0;
  for (unsigned a = 0; a < corners; ++a) {
    if (restricted.is_virtual(v[a]) || (is_ghost && !restricted.is_on_box(v[a]))) return {};
    sum += delaunay.point(v[a]);
    for (unsigned b = 0; b < a; ++b) {
      longest = std::max(longest, squared_distance(delaunay.point(v[a]), delaunay.point(v[b])));
    }
  }
  const Vec3 centroid = sum / corners;
  if (is_ghost && !SignedDelaunay::on_box(restricted.isosurface().box(), centroid)) return {};
  return {centroid, longest <= kLongEdge * kLongEdge};
}

bool has_opposed_gradients(const SignedDelaunay& restricted, TetId t, const Vec3& centroid) {
  std::array<Vec3, 4> gradient;
  const unsigned corners = restricted.delaunay().is_ghost(t) ? 3 : 4;
  for (unsigned a = 0; a < corners; ++a) {
    const Vec3& p = restricted.delaunay().point(restricted.delaunay().vertices(t)[a]);
    gradient[a] = restricted.isosurface().gradient(p + kInwards * (centroid - p));
    for (unsigned b = 0; b < a; ++b) {
      if (dot(gradient[a], gradient[b]) < 0) return true;
    }
  }
  return false;
}

// Evidence overrules: a small tetrahedron that segments of one side alone cross takes that side.
void take_signs_from_evidence(SignedDelaunay& restricted, const ScalarGrid& grid, const RaisedCells& raised) {
  const std::vector<std::uint8_t> evidence = evidence_in(restricted, grid, raised);
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    if (evidence[i] != kAbove && evidence[i] != kBelow) continue;
    if (restricted.is_above(TetId(i)) == (evidence[i] == kAbove)) continue;
    if (shape_of(restricted, TetId(i)).is_small) restricted.overturn_sign(TetId(i));
  }
}

}  // namespace

void take_signs(SignedDelaunay& restricted, const ScalarGrid& grid, const RaisedCells& raised,
                const std::vector<bool>& at_circumcenters, SignRule rule) {
  restricted.set_signs(at_circumcenters);
  const auto zone = raised.zone();
  const Tetrahedralization& delaunay = restricted.delaunay();
  for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
    const TetId t(i);
    if (!delaunay.is_live(t) || rule == SignRule::kCircumcenter) continue;
    const Shape shape = shape_of(restricted, t);
    if (!shape.is_small) continue;
    const auto at = zone.find(raised.name(raised.cell_of(shape.centroid)));
    if (at == zone.end()) continue;
    if (rule != SignRule::kCentroidWithRing && at->second == RaisedCells::Zone::kRing) continue;
    if (rule == SignRule::kCentroidWhereOpposed && !has_opposed_gradients(restricted, t, shape.centroid)) continue;
    restricted.take_sign_at(t, shape.centroid);
  }
  take_signs_from_evidence(restricted, grid, raised);
}

}  // namespace deliso

#include "surface/sign_rules.h"

#include <algorithm>
#include <array>
#include <vector>

#include "volume/critical_points.h"

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

Shape shape_of(const SignedDelaunay& restricted, TetId t) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  const auto& v = delaunay.vertices(t);
  if (std::any_of(v.begin(), v.end(), [&](VertexId q) { return restricted.is_virtual(q); })) return {};
  Vec3 sum;
  double longest = 0;
  for (unsigned a = 0; a < 4; ++a) {
    sum += delaunay.point(v[a]);
    for (unsigned b = 0; b < a; ++b) {
      longest = std::max(longest, squared_distance(delaunay.point(v[a]), delaunay.point(v[b])));
    }
  }
  return {sum / 4, longest <= kLongEdge * kLongEdge};
}

bool has_opposed_gradients(const SignedDelaunay& restricted, TetId t, const Vec3& centroid) {
  std::array<Vec3, 4> gradient;
  for (unsigned a = 0; a < 4; ++a) {
    const Vec3& p = restricted.delaunay().point(restricted.delaunay().vertices(t)[a]);
    gradient[a] = restricted.isosurface().gradient(p + kInwards * (centroid - p));
    for (unsigned b = 0; b < a; ++b) {
      if (dot(gradient[a], gradient[b]) < 0) return true;
    }
  }
  return false;
}

void take_signs_from_critical_points(SignedDelaunay& restricted, const ScalarGrid& grid, const RaisedCells& raised) {
  const Isosurface& isosurface = restricted.isosurface();
  std::vector<CriticalPoint> critical;
  TetId hint = restricted.delaunay().incident_tet(VertexId(std::size_t{0}));
  for (const auto& [name, level] : raised.levels()) {
    const CellIndex cell = raised.cell(name);
    critical.clear();
    append_critical_points(grid.cell(cell[0], cell[1], cell[2]), critical);
    for (const CriticalPoint& c : critical) {
      const Vec3 index_point{cell[0] + c.uvw.x, cell[1] + c.uvw.y, cell[2] + c.uvw.z};
      hint = restricted.locate(scaled(index_point, isosurface.step()), hint);
      if (restricted.delaunay().is_ghost(hint) || c.value == isosurface.isovalue()) continue;
      if (restricted.is_above(hint) == (c.value > isosurface.isovalue())) continue;
      if (shape_of(restricted, hint).is_small) restricted.overturn_sign(hint);
    }
  }
}

}  // namespace

void take_signs(SignedDelaunay& restricted, const ScalarGrid& grid, const RaisedCells& raised, SignRule rule) {
  const auto zone = raised.zone();
  const Tetrahedralization& delaunay = restricted.delaunay();
  for (std::size_t i = 0; i < delaunay.tet_slots(); ++i) {
    const TetId t(i);
    if (!delaunay.is_live(t)) continue;
    restricted.take_sign_at_circumcenter(t);
    if (rule == SignRule::kCircumcenter) continue;
    const Shape shape = shape_of(restricted, t);
    if (!shape.is_small) continue;
    const auto at = zone.find(raised.name(raised.cell_of(shape.centroid)));
    if (at == zone.end()) continue;
    if (rule != SignRule::kCentroidWithRing && at->second == RaisedCells::Zone::kRing) continue;
    if (rule == SignRule::kCentroidWhereOpposed && !has_opposed_gradients(restricted, t, shape.centroid)) continue;
    restricted.take_sign_at(t, shape.centroid);
  }
  take_signs_from_critical_points(restricted, grid, raised);
}

}  // namespace deliso

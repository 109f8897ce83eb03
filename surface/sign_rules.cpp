#include "surface/sign_rules.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "surface/blocks.h"
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

}  // namespace

SignRules::SignRules(const SignedDelaunay& restricted, const ScalarGrid& grid, const RaisedCells& raised,
                     std::vector<bool> at_circumcenters, int threads)
    : raised_(raised),
      threads_(threads),
      at_circumcenters_(std::move(at_circumcenters)),
      evidence_(evidence_in(restricted, grid, raised, threads)) {
  for (std::size_t i = 0; i < evidence_.size(); ++i) {
    if (evidence_[i] != kAbove && evidence_[i] != kBelow) continue;
    if (shape_of(restricted, TetId(i)).is_small) overruled_.emplace_back(TetId(i), evidence_[i] == kAbove);
  }
}

void SignRules::find_candidates(const SignedDelaunay& restricted) {
  const auto zone = raised_.zone();
  const Tetrahedralization& delaunay = restricted.delaunay();
  const auto append_if_candidate = [&](std::size_t i, std::vector<Candidate>& candidates) {
    const TetId t(i);
    if (!delaunay.is_live(t)) return;
    const Shape shape = shape_of(restricted, t);
    if (!shape.is_small) return;
    const auto at = zone.find(raised_.name(raised_.cell_of(shape.centroid)));
    if (at == zone.end()) return;
    const bool in_ring = at->second == RaisedCells::Zone::kRing;
    candidates.push_back({t, in_ring, restricted.isosurface().is_above(shape.centroid),
                          !in_ring && has_opposed_gradients(restricted, t, shape.centroid)});
  };
  candidates_ = collect_in_blocks<Candidate>(delaunay.tet_slots(), threads_, append_if_candidate);
  has_candidates_ = true;
}

void SignRules::take_signs(SignRule rule, SignedDelaunay& restricted) {
  restricted.set_signs(at_circumcenters_);
  if (rule != SignRule::kCircumcenter) {
    if (!has_candidates_) find_candidates(restricted);
    for (const Candidate& candidate : candidates_) {
      if (candidate.in_ring && rule != SignRule::kCentroidWithRing) continue;
      if (!candidate.is_opposed && rule == SignRule::kCentroidWhereOpposed) continue;
      restricted.set_sign(candidate.tet, candidate.is_above);
    }
  }
  for (const auto& [tet, is_above] : overruled_) restricted.set_sign(tet, is_above);
}

}  // namespace deliso

#include "surface/repair/signs/sign_rule.h"

#include <optional>
#include <vector>

#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

// A tetrahedron is small if no edge is longer than this (mesh-space units). The others keep the sign of their
// circumcenter everywhere.
constexpr double kLongEdge = 2;

constexpr CellName kNoCell = ~CellName{0};
constexpr CellName kStale = kNoCell - 1;

// The centroid of a small tetrahedron. A ghost behind a facet on the box has that of this facet: its sign decides the
// boundary curve of the surface.
std::optional<Vec3> centroid_of_small(const SignedDelaunay& restricted, TetId t) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  if (!delaunay.is_live(t)) return std::nullopt;
  const auto& v = delaunay.vertices(t);
  const bool is_ghost = delaunay.is_ghost(t);
  const unsigned corners = is_ghost ? 3 : 4;
  Vec3 sum;
  for (unsigned a = 0; a < corners; ++a) {
    if (restricted.is_virtual(v[a]) || (is_ghost && !restricted.is_on_box(v[a]))) return std::nullopt;
    sum += delaunay.point(v[a]);
    for (unsigned b = 0; b < a; ++b) {
      if (squared_distance(delaunay.point(v[a]), delaunay.point(v[b])) > kLongEdge * kLongEdge) return std::nullopt;
    }
  }
  const Vec3 centroid = sum / corners;
  if (is_ghost && !SignedDelaunay::on_box(restricted.isosurface().box(), centroid)) return std::nullopt;
  return centroid;
}

}  // namespace

SignRule::SignRule(SignedDelaunay& restricted, const CellLevels& cell_levels, int threads)
    : restricted_(restricted), cell_levels_(cell_levels), threads_(threads), constraints_(restricted) {
  update();
}

void SignRule::renew(const ExchangedPoints& exchanged) {
  constraints_.renew(exchanged);
  centroid_cells_.resize(restricted_.delaunay().tet_slots(), kStale);
  for (const TetId t : exchanged.renewed) centroid_cells_[t.index()] = kStale;
}

void SignRule::update() {
  constraints_.update(cell_levels_, threads_);
  const std::vector<bool> zone = cell_levels_.zone();
  centroid_cells_.resize(restricted_.delaunay().tet_slots(), kStale);
  centroid_sides_.resize(centroid_cells_.size(), kNoConstraint);
  for_each_block(centroid_cells_.size(), threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      CellName& cell = centroid_cells_[i];
      if (cell == kStale) {
        const std::optional<Vec3> centroid = centroid_of_small(restricted_, TetId(i));
        cell = centroid ? cell_levels_.name(cell_levels_.cell_of(*centroid)) : kNoCell;
        centroid_sides_[i] = kNoConstraint;
      }
      if (cell == kNoCell || centroid_sides_[i] != kNoConstraint || !zone[cell]) continue;
      centroid_sides_[i] =
          restricted_.isosurface().is_above(*centroid_of_small(restricted_, TetId(i))) ? kAbove : kBelow;
    }
  });
}

void SignRule::take_signs(const TetSigns& at_circumcenters) {
  restricted_.set_signs(at_circumcenters);
  for (std::size_t i = 0; i < centroid_cells_.size(); ++i) {
    if (centroid_cells_[i] == kNoCell) continue;
    const std::uint8_t constraint = constraints_.sides()[i];
    const bool is_known = constraint == kAbove || constraint == kBelow;
    const std::uint8_t side = is_known ? constraint : centroid_sides_[i];
    if (side != kNoConstraint) restricted_.set_sign(TetId(i), side == kAbove);
  }
}

}  // namespace deliso

#include "surface/repair/signs/sign_rule.h"

#include <algorithm>
#include <unordered_set>
#include <utility>
#include <vector>

#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

// A tetrahedron is small if no edge is longer than this (mesh-space units). The others keep the sign of their
// circumcenter everywhere.
constexpr double kLongEdge = 2;

struct Shape {
  Vec3 centroid;  // set if it is small
  bool is_small = false;
};

// The shape of a tetrahedron. A ghost behind a facet on the box has the shape of this facet: its sign decides the
// boundary curve of the surface.
Shape shape_of(const SignedDelaunay& restricted, TetId t) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  const auto& v = delaunay.vertices(t);
  const bool is_ghost = delaunay.is_ghost(t);
  const unsigned corners = is_ghost ? 3 : 4;
  Vec3 sum;
  for (unsigned a = 0; a < corners; ++a) {
    if (restricted.is_virtual(v[a]) || (is_ghost && !restricted.is_on_box(v[a]))) return {};
    sum += delaunay.point(v[a]);
    for (unsigned b = 0; b < a; ++b) {
      if (squared_distance(delaunay.point(v[a]), delaunay.point(v[b])) > kLongEdge * kLongEdge) return {};
    }
  }
  const Vec3 centroid = sum / corners;
  if (is_ghost && !SignedDelaunay::on_box(restricted.isosurface().box(), centroid)) return {};
  return {centroid, true};
}

// A set of cells with a bit table in front (a Bloom filter), which rejects nearly all cells that are not in the set.
class CellSet {
 public:
  explicit CellSet(const std::vector<CellName>& cells) : cells_(cells.begin(), cells.end()), sieve_(kHoles, false) {
    for (const CellName cell : cells) sieve_[hole(cell)] = true;
  }
  [[nodiscard]] bool contains(CellName cell) const { return sieve_[hole(cell)] && cells_.contains(cell); }

 private:
  static constexpr unsigned kBits = 18;
  static constexpr std::size_t kHoles = std::size_t{1} << kBits;
  static std::size_t hole(CellName cell) { return (cell * std::uint64_t{0x9E3779B97F4A7C15}) >> (64 - kBits); }

  std::unordered_set<CellName> cells_;
  std::vector<bool> sieve_;
};

}  // namespace

SignRule::SignRule(SignedDelaunay& restricted, const ScalarGrid& grid, const CellLevels& cell_levels, int threads)
    : restricted_(restricted), cell_levels_(cell_levels), threads_(threads), constraints_(restricted, grid) {
  update();
}

void SignRule::renew(const ExchangedPoints& exchanged) {
  constraints_.renew(exchanged);
  renewed_.insert(renewed_.end(), exchanged.renewed.begin(), exchanged.renewed.end());
}

void SignRule::update() {
  constraints_.update(cell_levels_, threads_);
  by_constraint_.clear();
  const std::vector<std::uint8_t>& sides = constraints_.sides();
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] != kAbove && sides[i] != kBelow) continue;
    if (shape_of(restricted_, TetId(i)).is_small) by_constraint_.emplace_back(TetId(i), sides[i] == kAbove);
  }
  update_by_centroid();
}

void SignRule::update_centroid_cells() {
  const auto find_cell = [&](TetId t) {
    const Shape shape = restricted_.delaunay().is_live(t) ? shape_of(restricted_, t) : Shape{};
    centroid_cells_[t.index()] = shape.is_small ? cell_levels_.name(cell_levels_.cell_of(shape.centroid)) : kNoCell;
  };
  const bool is_first = centroid_cells_.empty();
  centroid_cells_.resize(restricted_.delaunay().tet_slots(), kNoCell);
  if (!is_first) {
    for (const TetId t : renewed_) find_cell(t);
    return;
  }
  for_each_block(centroid_cells_.size(), threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) find_cell(TetId(i));
  });
}

// Only the tetrahedra that are new or whose cell has entered the zone need a sign at their centroid.
void SignRule::update_by_centroid() {
  const CellSet added(cell_levels_.extend(zone_));
  update_centroid_cells();
  std::vector<bool> is_renewed(centroid_cells_.size(), false);
  for (const TetId t : renewed_) is_renewed[t.index()] = true;
  renewed_.clear();
  std::erase_if(by_centroid_, [&](const auto& sign) { return is_renewed[sign.first.index()]; });
  const auto append_if_new = [&](std::size_t i, Signs& signs) {
    const TetId t(i);
    if (centroid_cells_[i] == kNoCell) return;
    if (!added.contains(centroid_cells_[i]) && !(is_renewed[i] && zone_.cells.contains(centroid_cells_[i]))) return;
    signs.emplace_back(t, restricted_.isosurface().is_above(shape_of(restricted_, t).centroid));
  };
  const Signs found = collect_in_blocks<Signs::value_type>(centroid_cells_.size(), threads_, append_if_new);
  by_centroid_.insert(by_centroid_.end(), found.begin(), found.end());
}

void SignRule::take_signs(const TetSigns& at_circumcenters) {
  restricted_.set_signs(at_circumcenters);
  for (const auto& [tet, is_above] : by_centroid_) restricted_.set_sign(tet, is_above);
  for (const auto& [tet, is_above] : by_constraint_) restricted_.set_sign(tet, is_above);
}

}  // namespace deliso

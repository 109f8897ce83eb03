#include "surface/repair/signs/sign_rules.h"

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>
#include <vector>

#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

// Tetrahedra with an edge longer than this (mesh-space units) keep the sign of their circumcenter everywhere.
constexpr double kLongEdge = 2;
// Gradients at vertices are taken a little towards the centroid: vertices lie on cell sides, where the gradient jumps.
constexpr double kInwards = 1e-5;

struct Shape {
  Vec3 centroid;  // of a small one
  bool is_small = false;
};

// Of a ghost behind a facet on the box: that of the facet, for there the surface's boundary curve is decided.
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

// A set of cells behind a sieve that holds back nearly all others.
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

SignRules::SignRules(SignedDelaunay& restricted, const ScalarGrid& grid, const CellLevels& raised, int threads)
    : restricted_(restricted), raised_(raised), threads_(threads), evidence_(restricted, grid) {
  update();
}

void SignRules::renew(const ExchangedPoints& exchanged) {
  evidence_.renew(exchanged);
  renewed_.insert(renewed_.end(), exchanged.renewed.begin(), exchanged.renewed.end());
}

void SignRules::update() {
  are_candidates_stale_ = true;
  evidence_.update(raised_, threads_);
  overruled_.clear();
  const std::vector<std::uint8_t>& sides = evidence_.sides();
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] != kAbove && sides[i] != kBelow) continue;
    if (shape_of(restricted_, TetId(i)).is_small) overruled_.emplace_back(TetId(i), sides[i] == kAbove);
  }
}

void SignRules::update_homes() {
  const auto find_home = [&](TetId t) {
    const Shape shape = restricted_.delaunay().is_live(t) ? shape_of(restricted_, t) : Shape{};
    homes_[t.index()] = shape.is_small ? raised_.name(raised_.cell_of(shape.centroid)) : kNoCell;
  };
  const bool is_first = homes_.empty();
  homes_.resize(restricted_.delaunay().tet_slots(), kNoCell);
  if (!is_first) {
    for (const TetId t : renewed_) find_home(t);
    return;
  }
  for_each_block(homes_.size(), threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) find_home(TetId(i));
  });
}

// Only tetrahedra that are new or whose cell is in another zone than before have anything new to say.
void SignRules::update_candidates() {
  if (!are_candidates_stale_) return;
  are_candidates_stale_ = false;
  const CellSet changed(raised_.extend(zones_));
  update_homes();
  std::vector<bool> is_renewed(homes_.size(), false);
  for (const TetId t : renewed_) is_renewed[t.index()] = true;
  renewed_.clear();
  const auto is_stale = [&](TetId t) { return is_renewed[t.index()] || changed.contains(homes_[t.index()]); };
  std::erase_if(candidates_, [&](const Candidate& candidate) { return is_stale(candidate.tet); });
  const auto append_if_candidate = [&](std::size_t i, std::vector<Candidate>& candidates) {
    const TetId t(i);
    if (homes_[i] == kNoCell || !is_stale(t)) return;
    const auto at = zones_.find(homes_[i]);
    if (at == zones_.end()) return;
    const Vec3 centroid = shape_of(restricted_, t).centroid;
    const bool in_ring = at->second == CellLevels::Zone::kRing;
    candidates.push_back({t, in_ring, restricted_.isosurface().is_above(centroid),
                          !in_ring && has_opposed_gradients(restricted_, t, centroid)});
  };
  const std::vector<Candidate> found = collect_in_blocks<Candidate>(homes_.size(), threads_, append_if_candidate);
  candidates_.insert(candidates_.end(), found.begin(), found.end());
}

void SignRules::take_signs(SignRule rule, const TetSigns& start) {
  restricted_.set_signs(start);
  if (rule != SignRule::kCircumcenter && rule != SignRule::kAsBefore) {
    update_candidates();
    for (const Candidate& candidate : candidates_) {
      if (candidate.in_ring && rule != SignRule::kCentroidWithRing) continue;
      if (!candidate.is_opposed && rule == SignRule::kCentroidWhereOpposed) continue;
      restricted_.set_sign(candidate.tet, candidate.is_above);
    }
  }
  for (const auto& [tet, is_above] : overruled_) restricted_.set_sign(tet, is_above);
}

}  // namespace deliso

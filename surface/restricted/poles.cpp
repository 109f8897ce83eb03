#include "surface/restricted/poles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "delaunay/constructions.h"
#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

constexpr std::size_t kTetsAtOnce = 8 * kBlockSize;

// The pole height from the squared distances of the two poles; a side without a Voronoi vertex has 0. Distances above
// `most` count as `most`.
double pole_height(const std::array<double, 2>& squared, double most, PoleHeight rule) {
  const auto height = [most](double squared_height) { return std::min(most, std::sqrt(squared_height)); };
  if (!(squared[0] > 0) && !(squared[1] > 0)) return most;
  if (!(squared[0] > 0)) return height(squared[1]);
  if (!(squared[1] > 0)) return height(squared[0]);
  switch (rule) {
    case PoleHeight::kNearer:
      return height(std::min(squared[0], squared[1]));
    case PoleHeight::kFarther:
      return height(std::max(squared[0], squared[1]));
    case PoleHeight::kMean:
      return (height(squared[0]) + height(squared[1])) / 2;
  }
  return most;
}

}  // namespace

std::vector<double> compute_poles(const SignedDelaunay& restricted, PoleHeight rule) {
  return compute_poles(restricted, std::vector<bool>(restricted.delaunay().vertex_count(), true), rule, 1);
}

std::vector<double> compute_poles(const SignedDelaunay& restricted, const std::vector<bool>& wanted, PoleHeight rule,
                                  int threads) {
  const Tetrahedralization& delaunay = restricted.delaunay();

  // All four vertices of a tetrahedron are equally far from its Voronoi vertex; that of a ghost lies at infinity.
  const auto is_wanted = [&](VertexId q) { return q != kInfiniteVertex && wanted[q.index()]; };
  const auto squared_radius = [&](TetId t) {
    if (delaunay.is_ghost(t)) return std::numeric_limits<double>::infinity();
    const auto& v = delaunay.vertices(t);
    const Vec3 center =
        circumcenter(delaunay.point(v[0]), delaunay.point(v[1]), delaunay.point(v[2]), delaunay.point(v[3]));
    return squared_distance(center, delaunay.point(v[0]));
  };
  // For a block of tetrahedra at a time: all threads compute the radii, then each vertex takes the largest ones.
  using Radius = std::pair<TetId, double>;                                       // squared
  std::vector<std::array<double, 2>> farthest(delaunay.vertex_count(), {0, 0});  // squared, below and above
  for (std::size_t first = 0; first < delaunay.tet_slots(); first += kTetsAtOnce) {
    const std::size_t count = std::min(kTetsAtOnce, delaunay.tet_slots() - first);
    const auto append_if_wanted = [&](std::size_t i, std::vector<Radius>& found) {
      const TetId t(first + i);
      if (!delaunay.is_live(t)) return;
      const auto& v = delaunay.vertices(t);
      if (std::any_of(v.begin(), v.end(), is_wanted)) found.emplace_back(t, squared_radius(t));
    };
    for (const auto& [t, squared] : collect_in_blocks<Radius>(count, threads, append_if_wanted)) {
      for (const VertexId q : delaunay.vertices(t)) {
        if (delaunay.is_ghost(t) && (q == kInfiniteVertex || restricted.is_on_box(q))) continue;
        double& side = farthest[q.index()][restricted.is_above(t) ? 1 : 0];
        side = std::max(side, squared);
      }
    }
  }

  const double diagonal = restricted.isosurface().box().diagonal();
  std::vector<double> heights;
  heights.reserve(farthest.size());
  for (const auto& both : farthest) heights.push_back(pole_height(both, diagonal, rule));
  return heights;
}

void KnownPoles::forget_around(TetId t) {
  if (!restricted_.delaunay().is_live(t)) return;
  for (const VertexId v : restricted_.delaunay().vertices(t)) {
    if (v != kInfiniteVertex) is_known_[v.index()] = false;
  }
}

void KnownPoles::renew(const ExchangedPoints& exchanged) {
  if (signs_.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < exchanged.renamed.size(); ++i) {
    if (exchanged.renamed[i].is_none()) continue;
    heights_[kept] = heights_[i];
    is_known_[kept++] = is_known_[i];
  }
  heights_.resize(restricted_.delaunay().vertex_count());
  is_known_.resize(kept);
  is_known_.resize(heights_.size(), false);
  signs_.resize(restricted_.delaunay().tet_slots(), 0);
  for (const TetId t : exchanged.renewed) {
    signs_[t.index()] = restricted_.is_above(t) ? 1 : 0;
    forget_around(t);
  }
}

const std::vector<double>& KnownPoles::heights(const std::vector<bool>& wanted, int threads) {
  if (signs_.empty()) {
    signs_.assign(restricted_.delaunay().tet_slots(), 0);
    heights_.resize(restricted_.delaunay().vertex_count());
    is_known_.assign(heights_.size(), false);
  }
  restricted_.for_each_change(signs_, [&](TetId t) { forget_around(t); });
  std::vector<bool> missing = wanted;
  for (std::size_t v = 0; v < missing.size(); ++v) missing[v] = wanted[v] && !is_known_[v];
  if (std::find(missing.begin(), missing.end(), true) == missing.end()) return heights_;
  const std::vector<double> found = compute_poles(restricted_, missing, PoleHeight::kNearer, threads);
  for (std::size_t v = 0; v < missing.size(); ++v) {
    if (!missing[v]) continue;
    heights_[v] = found[v];
    is_known_[v] = true;
  }
  return heights_;
}

}  // namespace deliso

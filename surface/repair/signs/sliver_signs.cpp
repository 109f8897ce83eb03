#include "surface/repair/signs/sliver_signs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

// A tetrahedron is flat when its height is below this fraction of its size. This is far more than the rounding of a
// plane, and far less than the height from which signs are meaningful.
constexpr double kFlatness = 1e-9;
// The cost of changing a sign, as a fraction of the area of the tetrahedron's facets: more than the rounding of equal
// areas.
constexpr double kWorthOfKeeping = 1e-6;

double twice_area(const Tetrahedralization& delaunay, FacetId f) {
  const std::array<VertexId, 3> v = delaunay.facet_vertices(f);
  const Vec3& a = delaunay.point(v[0]);
  return norm(cross(delaunay.point(v[1]) - a, delaunay.point(v[2]) - a));
}

bool is_flat(const Tetrahedralization& delaunay, TetId t) {
  if (!delaunay.is_live(t) || delaunay.is_ghost(t)) return false;
  const auto& v = delaunay.vertices(t);
  const Vec3& a = delaunay.point(v[0]);
  const Vec3 b = delaunay.point(v[1]) - a, c = delaunay.point(v[2]) - a, d = delaunay.point(v[3]) - a;
  const double determinant = std::abs(dot(cross(b, c), d));  // the height over any facet times twice its area
  // Most tetrahedra are far from flat. No edge is longer than 2 size, so twice the area of a facet is at most 4 size^2.
  const double size = std::sqrt(std::max({squared_norm(b), squared_norm(c), squared_norm(d)}));
  if (determinant > 4 * kFlatness * size * size * size) return false;
  double largest = 0;
  for (unsigned face = 0; face < 4; ++face) largest = std::max(largest, twice_area(delaunay, FacetId(t, face)));
  return determinant < kFlatness * size * largest;
}

// The index of t in an ascending array.
std::optional<std::uint32_t> index_of(std::span<const TetId> tets, TetId t) {
  const auto at = std::lower_bound(tets.begin(), tets.end(), t);
  if (at == tets.end() || *at != t) return std::nullopt;
  return static_cast<std::uint32_t>(at - tets.begin());
}

// The signs of some tetrahedra for which the restricted facets have the least area, with the signs around them fixed.
// This is a minimum cut between above and below in the graph whose nodes are the tetrahedra and whose edges are their
// facets. It is found by augmenting flow along shortest paths, all those of one length before longer ones (Dinic 1970):
// layers may have thousands of tetrahedra.
class LeastCut {
 public:
  // `tets`: ascending.
  LeastCut(const SignedDelaunay& restricted, std::span<const TetId> tets) : arcs_of_(kFirst + tets.size()) {
    const Tetrahedralization& delaunay = restricted.delaunay();
    for (std::uint32_t i = 0; i < tets.size(); ++i) {
      double all = 0;
      for (unsigned face = 0; face < 4; ++face) {
        const double area = twice_area(delaunay, FacetId(tets[i], face));
        const TetId across = delaunay.neighbour(tets[i], face);
        all += area;
        if (const auto j = index_of(tets, across); !j) {
          join(i, restricted.is_above(across), area);
        } else if (*j > i) {
          add_arcs(kFirst + i, kFirst + *j, area, area);
        }
      }
      join(i, restricted.is_above(tets[i]), kWorthOfKeeping * all);
    }
    reached_by_.assign(arcs_of_.size(), kNone);
    while (finds_levels()) {
      while (finds_path()) send_along();
    }
  }

  [[nodiscard]] bool is_above(std::size_t i) const { return level_[kFirst + i] != kNone; }

 private:
  static constexpr std::uint32_t kAbove = 0, kBelow = 1, kFirst = 2;  // nodes
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  struct Arc {
    std::uint32_t to = 0;
    double room = 0;
  };

  // The reverse arc has the next number.
  void add_arcs(std::uint32_t from, std::uint32_t to, double there, double back) {
    arcs_of_[from].push_back(static_cast<std::uint32_t>(arcs_.size()));
    arcs_.push_back({to, there});
    arcs_of_[to].push_back(static_cast<std::uint32_t>(arcs_.size()));
    arcs_.push_back({from, back});
  }
  void join(std::uint32_t i, bool to_above, double area) {
    if (to_above) {
      add_arcs(kAbove, kFirst + i, area, 0);
    } else {
      add_arcs(kFirst + i, kBelow, area, 0);
    }
  }

  // The number of arcs with room on the shortest path from above to each node. Returns whether below is reached.
  bool finds_levels() {
    level_.assign(arcs_of_.size(), kNone);
    level_[kAbove] = 0;
    std::vector<std::uint32_t> open = {kAbove};
    for (std::size_t at = 0; at < open.size(); ++at) {
      for (const std::uint32_t arc : arcs_of_[open[at]]) {
        const auto& [to, room] = arcs_[arc];
        if (!(room > 0) || level_[to] != kNone) continue;
        level_[to] = level_[open[at]] + 1;
        if (to != kBelow) open.push_back(to);
      }
    }
    next_.assign(arcs_of_.size(), 0);
    return level_[kBelow] != kNone;
  }
  // Walks from level to level until below is reached. An arc that leads nowhere is not looked at again: next_.
  bool finds_path() {
    std::uint32_t node = kAbove;
    while (node != kBelow) {
      if (next_[node] == arcs_of_[node].size()) {
        if (node == kAbove) return false;
        node = arcs_[reached_by_[node] ^ 1U].to;
        ++next_[node];
        continue;
      }
      const std::uint32_t arc = arcs_of_[node][next_[node]];
      const auto& [to, room] = arcs_[arc];
      if (room > 0 && level_[to] == level_[node] + 1) {
        reached_by_[to] = arc;
        node = to;
      } else {
        ++next_[node];
      }
    }
    return true;
  }
  void send_along() {
    double flow = std::numeric_limits<double>::infinity();
    const auto for_each_arc = [&](const auto& visit) {
      for (std::uint32_t node = kBelow; node != kAbove; node = arcs_[reached_by_[node] ^ 1U].to) {
        visit(reached_by_[node]);
      }
    };
    for_each_arc([&](std::uint32_t arc) { flow = std::min(flow, arcs_[arc].room); });
    for_each_arc([&](std::uint32_t arc) {
      arcs_[arc].room -= flow;
      arcs_[arc ^ 1U].room += flow;
    });
  }

  std::vector<Arc> arcs_;
  std::vector<std::vector<std::uint32_t>> arcs_of_;  // of each node
  std::vector<std::uint32_t> level_;                 // of each node; kNone where no path with room leads
  std::vector<std::size_t> next_;                    // of each node: its first arc that may lead on
  std::vector<std::uint32_t> reached_by_;            // of each node on the path at hand: the arc
};

}  // namespace

SliverSigns::SliverSigns(const SignedDelaunay& restricted, int threads) : restricted_(restricted) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  flat_ = collect_in_blocks<TetId>(delaunay.tet_slots(), threads, [&](std::size_t i, std::vector<TetId>& found) {
    if (is_flat(delaunay, TetId(i))) found.push_back(TetId(i));
  });
  find_layers();
}

void SliverSigns::renew(const ExchangedPoints& exchanged) {
  flat_.insert(flat_.end(), exchanged.renewed.begin(), exchanged.renewed.end());
  std::sort(flat_.begin(), flat_.end());
  flat_.erase(std::unique(flat_.begin(), flat_.end()), flat_.end());
  std::erase_if(flat_, [&](TetId t) { return !is_flat(restricted_.delaunay(), t); });
  find_layers();
}

void SliverSigns::find_layers() {
  layers_.clear();
  std::vector<bool> is_in_layer(flat_.size(), false);
  for (std::uint32_t seed = 0; seed < flat_.size(); ++seed) {
    if (is_in_layer[seed]) continue;
    std::vector<TetId> layer;
    const auto take = [&](std::uint32_t i) {
      is_in_layer[i] = true;
      layer.push_back(flat_[i]);
    };
    take(seed);
    for (std::size_t at = 0; at < layer.size(); ++at) {
      for (unsigned face = 0; face < 4; ++face) {
        const auto next = index_of(flat_, restricted_.delaunay().neighbour(layer[at], face));
        if (next && !is_in_layer[*next]) take(*next);
      }
    }
    std::sort(layer.begin(), layer.end());
    layers_.push_back(std::move(layer));
  }
}

void SliverSigns::settle(SignedDelaunay& restricted) const {
  const auto meets_surface = [&](TetId t) {
    const auto is_restricted = [&](unsigned face) { return restricted.is_restricted(FacetId(t, face)); };
    return is_restricted(0) || is_restricted(1) || is_restricted(2) || is_restricted(3);
  };
  for (const std::vector<TetId>& layer : layers_) {
    if (std::none_of(layer.begin(), layer.end(), meets_surface)) continue;
    const LeastCut cut(restricted, layer);
    for (std::size_t i = 0; i < layer.size(); ++i) restricted.set_sign(layer[i], cut.is_above(i));
  }
}

}  // namespace deliso

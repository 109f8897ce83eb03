#include "surface/repair/signs/sliver_signs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "delaunay/base/disjoint_sets.h"
#include "delaunay/base/minimum_cut.h"
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

// The minimum cut between above and below in the graph whose nodes are some tetrahedra (ascending) and whose edges are
// their facets: it tells the signs for which the restricted facets have the least area, with the signs around fixed.
MinimumCut least_cut(const SignedDelaunay& restricted, std::span<const TetId> tets) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  MinimumCut cut(tets.size());
  const auto join = [&](std::uint32_t i, bool to_above, double area) {
    to_above ? cut.join_source(i, area) : cut.join_sink(i, area);
  };
  for (std::uint32_t i = 0; i < tets.size(); ++i) {
    double all = 0;
    for (unsigned face = 0; face < 4; ++face) {
      const double area = twice_area(delaunay, FacetId(tets[i], face));
      const TetId across = delaunay.neighbour(tets[i], face);
      all += area;
      if (const auto j = index_of(tets, across); !j) {
        join(i, restricted.is_above(across), area);
      } else if (*j > i) {
        cut.join(i, *j, area);
      }
    }
    join(i, restricted.is_above(tets[i]), kWorthOfKeeping * all);
  }
  cut.find();
  return cut;
}

// Sets of them that are connected across common facets, each ascending.
std::vector<std::vector<TetId>> layers_of(const SignedDelaunay& restricted, std::span<const TetId> flat) {
  DisjointSets sets(flat.size());
  for (std::uint32_t i = 0; i < flat.size(); ++i) {
    for (unsigned face = 0; face < 4; ++face) {
      if (const auto next = index_of(flat, restricted.delaunay().neighbour(flat[i], face))) sets.unite(i, *next);
    }
  }
  std::vector<std::vector<TetId>> layers(flat.size());
  for (std::uint32_t i = 0; i < flat.size(); ++i) layers[sets.find(i)].push_back(flat[i]);
  std::erase_if(layers, [](const std::vector<TetId>& layer) { return layer.empty(); });
  return layers;
}

}  // namespace

std::vector<TetId> slivers(const SignedDelaunay& restricted, int threads) {
  const Tetrahedralization& delaunay = restricted.delaunay();
  return collect_in_blocks<TetId>(delaunay.tet_slots(), threads, [&](std::size_t i, std::vector<TetId>& found) {
    if (is_flat(delaunay, TetId(i))) found.push_back(TetId(i));
  });
}

void settle_slivers(SignedDelaunay& restricted, int threads) {
  const auto meets_surface = [&](TetId t) {
    const auto is_restricted = [&](unsigned face) { return restricted.is_restricted(FacetId(t, face)); };
    return is_restricted(0) || is_restricted(1) || is_restricted(2) || is_restricted(3);
  };
  for (const std::vector<TetId>& layer : layers_of(restricted, slivers(restricted, threads))) {
    if (std::none_of(layer.begin(), layer.end(), meets_surface)) continue;
    const MinimumCut cut = least_cut(restricted, layer);
    for (std::uint32_t i = 0; i < layer.size(); ++i) restricted.set_sign(layer[i], cut.is_on_source_side(i));
  }
}

}  // namespace deliso

// A second opinion on the topology of an isosurface: that of the piecewise linear interpolant on Freudenthal's
// triangulation of the grid. It equals the trilinear one wherever the surface is well resolved.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "volume/scalar_grid.h"

namespace deliso {

// Every simplex of the triangulation is a chain p, p + m1, p + m1 + m2, ... of disjoint nonempty bit masks of axes. The
// surface has a vertex in every crossed edge, an edge in every crossed facet and a face in every crossed tetrahedron.
class TetrahedraTopology {
 public:
  TetrahedraTopology(const ScalarGrid& grid, double isovalue) : grid_(grid), isovalue_(isovalue) {
    parent_.resize(8 * grid.sample_count());
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    rim_ = parent_;
    for (unsigned m1 = 1; m1 < 8; ++m1) {
      visit({m1}, [this](const auto& chain) { vertices_.push_back(crossing(chain)); });
      for (unsigned m2 = 1; m2 < 8; ++m2)
        if ((m1 & m2) == 0) visit({m1, m2}, [this](const auto& chain) { facets_.push_back(join(chain)); });
    }
    for (const auto& m : {std::array{1u, 2u, 4u}, {1u, 4u, 2u}, {2u, 1u, 4u}, {2u, 4u, 1u}, {4u, 1u, 2u}, {4u, 2u, 1u}})
      visit({m[0], m[1], m[2]}, [this](const auto& chain) { tetrahedra_.push_back(crossing(chain)); });
  }

  // (Euler characteristic, boundary loops) of every component, ascending.
  [[nodiscard]] std::vector<std::pair<std::int64_t, std::int64_t>> components() {
    std::map<std::uint32_t, std::pair<std::int64_t, std::int64_t>> all;
    for (const std::uint32_t v : vertices_) ++all[root(parent_, v)].first;
    for (const std::uint32_t v : facets_) --all[root(parent_, v)].first;
    for (const std::uint32_t v : tetrahedra_) ++all[root(parent_, v)].first;
    std::vector<std::uint32_t> loops;
    loops.reserve(rim_vertices_.size());
    for (const std::uint32_t v : rim_vertices_) loops.push_back(root(rim_, v));
    std::sort(loops.begin(), loops.end());
    loops.erase(std::unique(loops.begin(), loops.end()), loops.end());
    for (const std::uint32_t v : loops) ++all[root(parent_, v)].second;
    std::vector<std::pair<std::int64_t, std::int64_t>> out;
    out.reserve(all.size());
    for (const auto& [name, component] : all) out.push_back(component);
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  struct Chain {
    std::array<std::array<std::int32_t, 3>, 4> points;
    std::array<unsigned, 4> sums;  // of the masks so far
    std::size_t size;
  };

  static std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  }
  [[nodiscard]] bool above(const std::array<std::int32_t, 3>& p) const {
    return grid_.at(p[0], p[1], p[2]) > isovalue_;
  }

  // Calls f with every crossed chain of these masks.
  template <class Function>
  void visit(std::initializer_list<unsigned> masks, const Function& f) const {
    Chain chain{};
    chain.size = masks.size() + 1;
    for (std::size_t n = 0; n < masks.size(); ++n) chain.sums[n + 1] = chain.sums[n] | *(masks.begin() + n);
    const unsigned all = chain.sums[masks.size()];
    const auto end = [&](std::size_t axis) { return grid_.dims()[axis] - static_cast<std::int32_t>(all >> axis & 1u); };
    for (std::int32_t k = 0; k < end(2); ++k)
      for (std::int32_t j = 0; j < end(1); ++j)
        for (std::int32_t i = 0; i < end(0); ++i) {
          std::size_t count = 0;
          for (std::size_t n = 0; n < chain.size; ++n) {
            for (std::size_t axis = 0; axis < 3; ++axis)
              chain.points[n][axis] = (axis == 0   ? i
                                       : axis == 1 ? j
                                                   : k) +
                                      static_cast<std::int32_t>(chain.sums[n] >> axis & 1u);
            count += above(chain.points[n]) ? 1 : 0;
          }
          if (count > 0 && count < chain.size) f(chain);
        }
  }
  // The names of the crossed edges among a chain's points.
  [[nodiscard]] std::vector<std::uint32_t> crossings(const Chain& chain) const {
    std::vector<std::uint32_t> out;
    for (std::size_t a = 0; a < chain.size; ++a)
      for (std::size_t b = a + 1; b < chain.size; ++b)
        if (above(chain.points[a]) != above(chain.points[b])) {
          const auto& p = chain.points[a];
          out.push_back(
              static_cast<std::uint32_t>(8 * grid_.index(p[0], p[1], p[2]) + (chain.sums[b] & ~chain.sums[a])));
        }
    return out;
  }
  [[nodiscard]] std::uint32_t crossing(const Chain& chain) const { return crossings(chain).front(); }

  // A crossed facet joins its two crossed edges; on the box it is a piece of a boundary loop too.
  std::uint32_t join(const Chain& chain) {
    const std::vector<std::uint32_t> two = crossings(chain);
    parent_[root(parent_, two[0])] = root(parent_, two[1]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const std::int32_t side : {0, grid_.dims()[axis] - 1})
        if (chain.points[0][axis] == side && chain.points[1][axis] == side && chain.points[2][axis] == side) {
          rim_[root(rim_, two[0])] = root(rim_, two[1]);
          rim_vertices_.push_back(two[0]);
        }
    return two[0];
  }

  const ScalarGrid& grid_;
  double isovalue_;
  std::vector<std::uint32_t> parent_;  // of a union-find over crossed edges, named 8 * sample + mask
  std::vector<std::uint32_t> rim_;     // the same for the boundary loops
  std::vector<std::uint32_t> vertices_;
  std::vector<std::uint32_t> facets_;
  std::vector<std::uint32_t> tetrahedra_;
  std::vector<std::uint32_t> rim_vertices_;
};

}  // namespace deliso

// An independent way to the topology of an isosurface of the trilinear interpolant: evaluate it exactly, in integers,
// on a finer lattice, cut every lattice cube into six tetrahedra around its diagonal, and count the polygons in which
// the surface of the piecewise linear function meets them. For a regular isovalue this is right once the lattice is
// fine enough. Shares no code with what it checks.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <vector>

#include "volume/topology/exact_topology.h"

namespace deliso::test {

// Integer samples, x fastest; the isovalue is twice_isovalue / 2.
struct IntegerGrid {
  Dims dims{};
  std::vector<std::int64_t> samples;
  std::int64_t twice_isovalue = 1;
};

class LatticeTopology {
 public:
  // n lattice steps per voxel.
  LatticeTopology(const IntegerGrid& grid, int n) : n_(n) {
    for (std::size_t a = 0; a < 3; ++a) size_[a] = (grid.dims[a] - 1) * n + 1;
    mark(grid);
    parent_.resize(above_.size() * 8);
    std::iota(parent_.begin(), parent_.end(), 0u);
    loop_parent_ = parent_;
    count_simplices();
  }

  // Sorted.
  [[nodiscard]] std::vector<ComponentTopology> components() {
    std::map<std::uint32_t, ComponentTopology> found;
    for (const auto& [edge, share] : euler_) found[find(parent_, edge)].euler_characteristic += share;
    for (const std::uint32_t edge : outer_edges_) {
      if (find(loop_parent_, edge) == edge) ++found[find(parent_, edge)].boundary_loops;
    }
    std::vector<ComponentTopology> result;
    result.reserve(found.size());
    for (const auto& [root, topology] : found) result.push_back(topology);
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  using Point = std::array<int, 3>;

  static std::uint32_t find(std::vector<std::uint32_t>& parent, std::uint32_t x) {
    while (parent[x] != x) x = parent[x] = parent[parent[x]];
    return x;
  }
  static void unite(std::vector<std::uint32_t>& parent, std::uint32_t x, std::uint32_t y) {
    parent[find(parent, x)] = find(parent, y);
  }

  [[nodiscard]] std::size_t index(const Point& p) const {
    return static_cast<std::size_t>(p[0]) +
           static_cast<std::size_t>(size_[0]) *
               (static_cast<std::size_t>(p[1]) + static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(p[2]));
  }

  void mark(const IntegerGrid& grid) {
    above_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                  static_cast<std::size_t>(size_[2]));
    Point p;
    for (p[2] = 0; p[2] < size_[2]; ++p[2]) {
      for (p[1] = 0; p[1] < size_[1]; ++p[1]) {
        for (p[0] = 0; p[0] < size_[0]; ++p[0]) above_[index(p)] = is_above(grid, p) ? 1 : 0;
      }
    }
  }

  [[nodiscard]] bool is_above(const IntegerGrid& grid, const Point& p) const {
    // n^3 times the interpolated value: every corner of the cell with its integer weight.
    std::int64_t value = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      std::int64_t weight = 1;
      std::size_t sample = 0;
      std::size_t stride = 1;
      for (std::size_t a = 0; a < 3; ++a) {
        const int cell = std::min(p[a] / n_, grid.dims[a] - 2);
        const int offset = p[a] - cell * n_;
        const int bit = static_cast<int>(corner >> a & 1u);
        weight *= bit == 1 ? offset : n_ - offset;
        sample += stride * static_cast<std::size_t>(cell + bit);
        stride *= static_cast<std::size_t>(grid.dims[a]);
      }
      value += weight * grid.samples[sample];
    }
    return 2 * value > grid.twice_isovalue * n_ * n_ * n_;
  }

  // A lattice edge runs from p to p + d, where d is a nonempty set of axes.
  [[nodiscard]] std::uint32_t edge(const Point& p, unsigned d) const {
    return static_cast<std::uint32_t>(8 * index(p) + d);
  }
  static Point moved(Point p, unsigned d) {
    for (std::size_t a = 0; a < 3; ++a) p[a] += static_cast<int>(d >> a & 1u);
    return p;
  }
  [[nodiscard]] bool inside(const Point& p, unsigned d) const {
    const Point q = moved(p, d);
    return q[0] < size_[0] && q[1] < size_[1] && q[2] < size_[2];
  }
  [[nodiscard]] bool differ(const Point& p, unsigned d) const { return above_[index(p)] != above_[index(moved(p, d))]; }
  // True when p and p + d lie in one plane of the box.
  [[nodiscard]] bool on_box(const Point& p, unsigned d) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if ((d >> a & 1u) == 0 && (p[a] == 0 || p[a] + 1 == size_[a])) return true;
    }
    return false;
  }

  void count_simplices() {
    Point p;
    for (p[2] = 0; p[2] < size_[2]; ++p[2]) {
      for (p[1] = 0; p[1] < size_[1]; ++p[1]) {
        for (p[0] = 0; p[0] < size_[0]; ++p[0]) count_at(p);
      }
    }
  }

  // Counts the simplices whose lowest vertex is p. Each of their vertices is reached by adding further axes.
  void count_at(const Point& p) {
    for (unsigned d = 1; d < 8; ++d) {
      if (!inside(p, d)) continue;
      // An edge with a sign change is a vertex of the surface.
      if (differ(p, d)) {
        euler_[edge(p, d)] += 1;
        if (on_box(p, d)) outer_edges_.push_back(edge(p, d));
      }
      // A triangle p, p + a, p + d with a sign change holds an edge of the surface: it joins two of its crossed edges.
      for (unsigned a = 1; a < d; ++a) {
        if ((a & d) == a) count_triangle(p, a, d);
      }
    }
    if (!inside(p, 7)) return;
    // A tetrahedron with a sign change holds one polygon; its edges are already joined through its triangles.
    for (const unsigned first : {1u, 2u, 4u}) {
      for (const unsigned second : {1u, 2u, 4u}) {
        if (first == second) continue;
        const Point b = moved(p, first);
        const Point c = moved(p, first | second);
        const std::array<std::uint32_t, 3> edges{edge(p, first), edge(b, second), edge(c, 7u ^ first ^ second)};
        const std::array<bool, 3> crossed{differ(p, first), differ(b, second), differ(c, 7u ^ first ^ second)};
        for (std::size_t i = 0; i < 3; ++i) {
          if (!crossed[i]) continue;
          euler_[edges[i]] += 1;
          break;
        }
      }
    }
  }

  void count_triangle(const Point& p, unsigned a, unsigned d) {
    const Point b = moved(p, a);
    const std::array<std::uint32_t, 3> edges{edge(p, a), edge(b, d ^ a), edge(p, d)};
    const std::array<bool, 3> crossed{differ(p, a), differ(b, d ^ a), differ(p, d)};
    if (!crossed[0] && !crossed[1]) return;
    const std::uint32_t from = edges[crossed[0] ? 0 : 1];
    const std::uint32_t to = edges[crossed[2] ? 2 : 1];
    euler_[from] -= 1;
    unite(parent_, from, to);
    if (on_box(p, d)) unite(loop_parent_, from, to);
  }

  int n_;
  Point size_{};
  std::vector<std::uint8_t> above_;
  std::vector<std::uint32_t> parent_;       // lattice edge -> another one of its component
  std::vector<std::uint32_t> loop_parent_;  // the same, joined on the box only
  std::map<std::uint32_t, std::int64_t> euler_;
  std::vector<std::uint32_t> outer_edges_;
};

inline std::vector<ComponentTopology> lattice_topology(const IntegerGrid& grid, int n) {
  return LatticeTopology(grid, n).components();
}

}  // namespace deliso::test

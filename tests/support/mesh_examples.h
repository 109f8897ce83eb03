// Small meshes with known shape and topology.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "delaunay/base/rng.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso::testing {

inline TriangleMesh tetrahedron_mesh() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

// A sphere around `center`, outward oriented: the octahedron, each triangle split in four `levels` times.
inline TriangleMesh sphere_mesh(int levels, double radius = 1, const Vec3& center = {}) {
  TriangleMesh mesh{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.points.size()));
      if (is_new) {
        const Vec3 sum = mesh.points[a] + mesh.points[b];
        mesh.points.push_back(sum / norm(sum));
      }
      return place->second;
    };
    TriangleMesh finer{{}, {}};
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& t : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) {
        finer.triangles.push_back(t);
      }
    }
    mesh.triangles = std::move(finer.triangles);
  }
  for (Vec3& p : mesh.points) p = center + radius * p;
  return mesh;
}

// A torus of m by n squares, each cut in two.
inline TriangleMesh torus_mesh(std::uint32_t m, std::uint32_t n, double ring = 2, double tube = 0.7) {
  TriangleMesh mesh;
  constexpr double kTurn = 6.283185307179586;
  for (std::uint32_t i = 0; i < m; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = kTurn * i / m, v = kTurn * j / n, w = ring + tube * std::cos(v);
      mesh.points.push_back({w * std::cos(u), w * std::sin(u), tube * std::sin(v)});
      const std::uint32_t i1 = (i + 1) % m, j1 = (j + 1) % n;
      mesh.triangles.push_back({i * n + j, i1 * n + j, i1 * n + j1});
      mesh.triangles.push_back({i * n + j, i1 * n + j1, i * n + j1});
    }
  }
  return mesh;
}

// The graph of `height` over an m by n grid of unit squares, normals upward.
template <class Height>
TriangleMesh patch_mesh(std::uint32_t m, std::uint32_t n, Height height) {
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= m; ++i) mesh.points.push_back({double(i), double(j), height(i, j)});
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < m; ++i) {
      const std::uint32_t v = j * (m + 1) + i;
      mesh.triangles.push_back({v, v + 1, v + m + 2});
      mesh.triangles.push_back({v, v + m + 2, v + m + 1});
    }
  }
  return mesh;
}

// Both meshes side by side, nothing shared.
inline TriangleMesh disjoint_union(TriangleMesh a, const TriangleMesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& [p, q, r] : b.triangles) a.triangles.push_back({p + shift, q + shift, r + shift});
  return a;
}

// Any triangles over any points: nothing is guaranteed but indices in range.
inline TriangleMesh random_soup(Rng& rng, std::size_t points, std::size_t triangles) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < points; ++i) mesh.points.push_back({rng.uniform(), rng.uniform(), rng.uniform()});
  for (std::size_t t = 0; t < triangles; ++t) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::uint32_t& v : triangle) v = static_cast<std::uint32_t>(rng.below(points));
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace deliso::testing

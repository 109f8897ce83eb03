#include "surface/mesh_connectivity.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "delaunay/base/check.h"
#include "surface/blocks.h"

namespace deliso {

namespace {

// Disjoint sets whose representative is always the smallest member, so that results do not depend on the order of
// joins (Tarjan 1975; path halving).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Calls visit(half-edge, lower vertex, higher vertex) for the half-edges whose lower vertex is one from `first` to
// `last` - 1.
template <class Visit>
void for_each_half_edge(const TriangleMesh& mesh, std::size_t first, std::size_t last, const Visit& visit) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(mesh.triangles[t][i], mesh.triangles[t][i == 2 ? 0 : i + 1]);
      if (first <= low && low < last) visit(3 * t + i, low, high);
    }
  }
}

// A key tells the higher vertex, then the half-edge.
std::uint64_t key_of(std::uint32_t high, std::uint32_t half_edge) { return std::uint64_t{high} << 32 | half_edge; }
std::uint32_t high_of(std::uint64_t key) { return static_cast<std::uint32_t>(key >> 32); }

// The corners that a half-edge of an edge has at its lower and its higher vertex. Corner 3 t + i is where half-edge
// 3 t + i starts.
std::array<std::uint32_t, 2> corners_of(const MeshConnectivity& connectivity, std::uint32_t h, std::uint32_t low) {
  const std::uint32_t next = h - h % 3 + (h + 1) % 3;
  if (connectivity.tail(h) == low) return {h, next};
  return {next, h};
}

// Counts, up to two, the umbrellas at the vertices from `first` to `last` - 1: their corners, joined when their
// triangles share an edge there. Touches only the corners at these vertices.
void count_umbrellas(const MeshConnectivity& connectivity, std::size_t first, std::size_t last, DisjointSets& corners,
                     std::vector<std::uint8_t>& umbrellas) {
  const TriangleMesh& mesh = connectivity.mesh();
  for (std::size_t e = 0; e < connectivity.edge_count(); ++e) {
    const MeshEdge& edge = connectivity.edge(e);
    const bool has_low = first <= edge.low && edge.low < last;
    const bool has_high = first <= edge.high && edge.high < last;
    if (!has_low && !has_high) continue;
    const auto half_edges = connectivity.half_edges(e);
    const auto [at_low, at_high] = corners_of(connectivity, half_edges[0], edge.low);
    for (std::size_t k = 1; k < half_edges.size(); ++k) {
      const auto [other_at_low, other_at_high] = corners_of(connectivity, half_edges[k], edge.low);
      if (has_low) corners.join(at_low, other_at_low);
      if (has_high) corners.join(at_high, other_at_high);
    }
  }
  for (std::uint32_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const std::uint32_t v = mesh.triangles[c / 3][c % 3];
    if (v < first || v >= last || corners.find(c) != c) continue;
    umbrellas[v] = static_cast<std::uint8_t>(std::min(umbrellas[v] + 1, 2));
  }
}

// Numbers the pieces and counts their vertices and triangles.
void find_components(const TriangleMesh& mesh, MeshTopology& topology) {
  DisjointSets sets(mesh.points.size());
  std::vector<bool> referenced(mesh.points.size(), false);
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.join(a, b);
    sets.join(b, c);
    referenced[a] = referenced[b] = referenced[c] = true;
  }
  topology.component_of_vertex.assign(mesh.points.size(), MeshTopology::kNoComponent);
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (!referenced[v]) {
      ++topology.unreferenced_vertices;
      continue;
    }
    // The representative is the lowest vertex, so it has been numbered before the others of its piece.
    const std::uint32_t lowest = sets.find(v);
    if (lowest == v) {
      topology.component_of_vertex[v] = static_cast<std::uint32_t>(topology.components.size());
      topology.components.emplace_back();
    }
    topology.component_of_vertex[v] = topology.component_of_vertex[lowest];
    ++topology.components[topology.component_of_vertex[v]].vertices;
  }
  for (const auto& triangle : mesh.triangles) {
    ++topology.components[topology.component_of_vertex[triangle[0]]].triangles;
  }
}

// Counts the edges by kind, and the loops of the boundary edges, per component.
void count_edges(const MeshConnectivity& connectivity, MeshTopology& topology) {
  DisjointSets loops(connectivity.mesh().points.size());
  std::vector<bool> on_boundary(connectivity.mesh().points.size(), false);
  for (std::size_t e = 0; e < connectivity.edge_count(); ++e) {
    const auto half_edges = connectivity.half_edges(e);
    const MeshEdge& edge = connectivity.edge(e);
    ++topology.components[topology.component_of_vertex[edge.low]].edges;
    if (half_edges.size() == 1) {
      ++topology.boundary_edges;
      loops.join(edge.low, edge.high);
      on_boundary[edge.low] = on_boundary[edge.high] = true;
    } else if (half_edges.size() == 2) {
      if (connectivity.tail(half_edges[0]) == connectivity.tail(half_edges[1])) ++topology.misoriented_edges;
    } else {
      ++topology.non_manifold_edges;
    }
  }
  for (std::uint32_t v = 0; v < on_boundary.size(); ++v) {
    if (on_boundary[v] && loops.find(v) == v) ++topology.components[topology.component_of_vertex[v]].boundary_loops;
  }
}

}  // namespace

MeshConnectivity::MeshConnectivity(const TriangleMesh& mesh, int threads) : mesh_(mesh) {
  DELISO_CHECK(mesh.triangles.size() < std::numeric_limits<std::uint32_t>::max() / 3, "half-edges have 32-bit ids");
  // Buckets by lower vertex, each sorted by key; starts[v] is where the bucket of v begins. A thread reads all
  // triangles, for its share of the vertices.
  const Shares vertices(mesh.points.size(), threads);
  std::vector<std::uint32_t> starts(mesh.points.size() + 1, 0);
  vertices.for_each(threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for_each_half_edge(mesh, first, last, [&](std::uint32_t, std::uint32_t low, std::uint32_t) { ++starts[low + 1]; });
  });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::uint64_t> keys(3 * mesh.triangles.size());
  std::vector<std::uint32_t> fill(starts.begin(), starts.end() - 1);
  std::vector<std::size_t> edges_before(vertices.count() + 1, 0);  // each share
  vertices.for_each(threads, [&](std::size_t share, std::size_t first, std::size_t last) {
    for_each_half_edge(mesh, first, last, [&](std::uint32_t h, std::uint32_t low, std::uint32_t high) {
      keys[fill[low]++] = key_of(high, h);
    });
    for (std::size_t v = first; v < last; ++v) {
      std::sort(keys.begin() + starts[v], keys.begin() + starts[v + 1]);
      for (std::uint32_t k = starts[v]; k < starts[v + 1]; ++k) {
        if (k == starts[v] || high_of(keys[k]) != high_of(keys[k - 1])) ++edges_before[share + 1];
      }
    }
  });
  std::partial_sum(edges_before.begin(), edges_before.end(), edges_before.begin());

  half_edges_.resize(keys.size());
  edges_.resize(edges_before.back());
  first_.resize(edges_before.back() + 1);
  first_.back() = static_cast<std::uint32_t>(keys.size());
  vertices.for_each(threads, [&](std::size_t share, std::size_t first, std::size_t last) {
    std::size_t next = edges_before[share];
    for (std::size_t low = first; low < last; ++low) {
      for (std::uint32_t k = starts[low]; k < starts[low + 1]; ++k) {
        if (k == starts[low] || high_of(keys[k]) != high_of(keys[k - 1])) {
          edges_[next] = {static_cast<std::uint32_t>(low), high_of(keys[k])};
          first_[next++] = k;
        }
        half_edges_[k] = static_cast<std::uint32_t>(keys[k]);
      }
    }
  });
}

MeshTopology mesh_topology(const MeshConnectivity& connectivity, int threads) {
  const TriangleMesh& mesh = connectivity.mesh();
  MeshTopology topology;
  // Components beside umbrellas.
  const Shares vertices(mesh.points.size(), threads);
  DisjointSets corners(3 * mesh.triangles.size());
  std::vector<std::uint8_t> umbrellas(mesh.points.size(), 0);
  run_tasks(vertices.count() + 1, threads, [&](std::size_t i) {
    if (i == 0) return find_components(mesh, topology);
    count_umbrellas(connectivity, vertices.begin(i - 1), vertices.begin(i), corners, umbrellas);
  });
  topology.non_manifold_vertices = std::count(umbrellas.begin(), umbrellas.end(), std::uint8_t{2});
  count_edges(connectivity, topology);
  topology.repeated_vertices = std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [](const auto& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
  return topology;
}

std::size_t first_bad_triangle(const TriangleMesh& mesh) {
  const auto bad = [&](const auto& t) { return std::max({t[0], t[1], t[2]}) >= mesh.points.size(); };
  return static_cast<std::size_t>(std::find_if(mesh.triangles.begin(), mesh.triangles.end(), bad) -
                                  mesh.triangles.begin());
}

}  // namespace deliso

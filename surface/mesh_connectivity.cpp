#include "surface/mesh_connectivity.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "delaunay/base/check.h"

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

// The half-edges of all triangles as (higher vertex, half-edge), bucketed by lower vertex and sorted in each bucket.
// starts[v] is where the bucket of v begins.
std::vector<std::uint64_t> sorted_half_edges(const TriangleMesh& mesh, std::vector<std::uint32_t>& starts) {
  starts.assign(mesh.points.size() + 1, 0);
  for (const auto& [a, b, c] : mesh.triangles) {
    ++starts[std::min(a, b) + 1];
    ++starts[std::min(b, c) + 1];
    ++starts[std::min(c, a) + 1];
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());

  std::vector<std::uint64_t> keys(3 * mesh.triangles.size());
  std::vector<std::uint32_t> fill(starts.begin(), starts.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t u = mesh.triangles[t][i], v = mesh.triangles[t][i == 2 ? 0 : i + 1];
      keys[fill[std::min(u, v)]++] = (static_cast<std::uint64_t>(std::max(u, v)) << 32) | (3 * t + i);
    }
  }
  for (std::size_t v = 0; v + 1 < starts.size(); ++v) {
    std::sort(keys.begin() + starts[v], keys.begin() + starts[v + 1]);
  }
  return keys;
}

// Umbrellas per vertex: the corners at a vertex, joined when their triangles share an edge there.
std::int64_t count_non_manifold_vertices(const MeshConnectivity& connectivity) {
  const TriangleMesh& mesh = connectivity.mesh();
  DisjointSets corners(3 * mesh.triangles.size());
  for (std::size_t e = 0; e < connectivity.edge_count(); ++e) {
    const auto half_edges = connectivity.half_edges(e);
    const std::uint32_t low = connectivity.edge(e).low;
    // Corner 3 t + i is where half-edge 3 t + i starts.
    const auto corner_at_low = [&](std::uint32_t h) {
      return connectivity.tail(h) == low ? h : h - h % 3 + (h + 1) % 3;
    };
    const auto corner_at_high = [&](std::uint32_t h) {
      return connectivity.tail(h) == low ? h - h % 3 + (h + 1) % 3 : h;
    };
    for (std::size_t k = 1; k < half_edges.size(); ++k) {
      corners.join(corner_at_low(half_edges[0]), corner_at_low(half_edges[k]));
      corners.join(corner_at_high(half_edges[0]), corner_at_high(half_edges[k]));
    }
  }
  std::vector<std::uint8_t> umbrellas(mesh.points.size(), 0);
  for (std::uint32_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    if (corners.find(c) != c) continue;
    std::uint8_t& count = umbrellas[mesh.triangles[c / 3][c % 3]];
    count = static_cast<std::uint8_t>(std::min(count + 1, 2));
  }
  return std::count(umbrellas.begin(), umbrellas.end(), std::uint8_t{2});
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

MeshConnectivity::MeshConnectivity(const TriangleMesh& mesh) : mesh_(mesh) {
  DELISO_CHECK(mesh.triangles.size() < std::numeric_limits<std::uint32_t>::max() / 3, "half-edges have 32-bit ids");
  std::vector<std::uint32_t> starts;
  const std::vector<std::uint64_t> keys = sorted_half_edges(mesh, starts);

  half_edges_.resize(keys.size());
  edge_of_.resize(keys.size());
  edges_.reserve(keys.size() / 2 + 1);
  first_.reserve(keys.size() / 2 + 2);
  for (std::uint32_t low = 0; low + 1 < starts.size(); ++low) {
    for (std::uint32_t k = starts[low]; k < starts[low + 1]; ++k) {
      const auto high = static_cast<std::uint32_t>(keys[k] >> 32);
      if (k == starts[low] || high != edges_.back().high) {
        edges_.push_back({low, high});
        first_.push_back(k);
      }
      half_edges_[k] = static_cast<std::uint32_t>(keys[k]);
      edge_of_[half_edges_[k]] = static_cast<std::uint32_t>(edges_.size() - 1);
    }
  }
  first_.push_back(static_cast<std::uint32_t>(keys.size()));
}

MeshTopology mesh_topology(const MeshConnectivity& connectivity) {
  MeshTopology topology;
  find_components(connectivity.mesh(), topology);
  count_edges(connectivity, topology);
  topology.non_manifold_vertices = count_non_manifold_vertices(connectivity);
  topology.repeated_vertices =
      std::count_if(connectivity.mesh().triangles.begin(), connectivity.mesh().triangles.end(),
                    [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return topology;
}

std::size_t first_bad_triangle(const TriangleMesh& mesh) {
  const auto bad = [&](const auto& t) { return std::max({t[0], t[1], t[2]}) >= mesh.points.size(); };
  return static_cast<std::size_t>(std::find_if(mesh.triangles.begin(), mesh.triangles.end(), bad) -
                                  mesh.triangles.begin());
}

}  // namespace deliso

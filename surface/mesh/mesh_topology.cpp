#include "surface/mesh/mesh_topology.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <tuple>

#include "delaunay/base/check.h"
#include "delaunay/base/disjoint_sets.h"
#include "delaunay/base/huge_pages.h"
#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

using Triangles = std::span<const std::array<std::uint32_t, 3>>;

// A triangle at one of its vertices: the other two.
struct Corner {
  std::uint32_t next = 0, previous = 0;
};

// The corners at each vertex, stored vertex by vertex.
class VertexCorners {
 public:
  // This many elements from any corner on may be read.
  static constexpr std::size_t kReadable = 8;

  VertexCorners(std::size_t vertices, Triangles triangles)
      : first_(vertices + 1, 0), corners_(3 * triangles.size() + kReadable) {
    for (const auto& triangle : triangles) {
      for (const std::uint32_t v : triangle) ++first_[v];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    for (const auto& [a, b, c] : triangles) {
      corners_[--first_[a]] = {b, c};
      corners_[--first_[b]] = {c, a};
      corners_[--first_[c]] = {a, b};
    }
  }
  [[nodiscard]] std::span<const Corner> at(std::size_t v) const {
    return std::span(corners_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

 private:
  LargeArray<std::uint32_t> first_;  // of each vertex: the index of its first corner
  LargeArray<Corner> corners_;
};

// Examines vertices one by one: the half-edges that leave and enter them, and the umbrellas these form.
class StarCensus {
 public:
  StarCensus(const VertexCorners& corners, const MeshTopology& components)
      : corners_(corners), components_(components), edges_(components.components.size(), 0) {}

  void look_at(std::uint32_t v) {
    at_ = corners_.at(v);
    if (at_.empty()) return;
    if (is_closed_fan(v)) {
      add_edges(v, std::count_if(at_.begin(), at_.end(), [&](const Corner& corner) { return corner.next > v; }));
    } else {
      look_closely_at(v);
    }
  }
  // Edges are counted at their lower vertex. Call in the order in which the vertices were examined.
  void add_to(MeshTopology& sum) const;

 private:
  // A half-edge at the current vertex; a half-edge from the vertex to itself is counted once for each end.
  struct Spoke {
    std::uint32_t other = 0;   // end
    std::uint32_t corner = 0;  // index in at_ of its triangle's corner at the vertex
    bool leaves = false;
    [[nodiscard]] auto rank() const { return std::tuple(other, !leaves, corner); }
  };
  static constexpr std::size_t kMostOfShortFan = 16;

  [[nodiscard]] std::uint32_t corners_after(std::uint32_t v) const;
  [[nodiscard]] bool is_closed_fan(std::uint32_t v) const;
  void look_closely_at(std::uint32_t v);
  void count_edge(std::uint32_t v, std::vector<Spoke>::const_iterator first, std::ptrdiff_t half_edges);
  void add_edges(std::uint32_t v, std::int64_t count) { edges_[components_.component_of_vertex[v]] += count; }

  const VertexCorners& corners_;
  const MeshTopology& components_;
  std::span<const Corner> at_;  // the corners at the current vertex
  std::vector<Spoke> spokes_;
  DisjointSets fans_;  // of at_
  MeshTopology counts_;
  std::vector<std::int64_t> edges_;  // of each component
};

// The corners whose triangles have vertex v next after the current one, as bits. Which ones they are is unpredictable,
// so eight are always compared; if there are fewer, the bits of those beyond are cleared.
std::uint32_t StarCensus::corners_after(std::uint32_t v) const {
  std::uint32_t found = 0;
  for (std::uint32_t k = 0; k < VertexCorners::kReadable; ++k) found |= std::uint32_t{at_.data()[k].previous == v} << k;
  for (std::uint32_t k = VertexCorners::kReadable; k < at_.size(); ++k)
    found |= std::uint32_t{at_[k].previous == v} << k;
  return found & ((1u << at_.size()) - 1);
}

// The common case: the triangles form one closed umbrella, all with the same orientation. Then a walk around the vertex
// visits each of them once. If two triangles follow the same edge, the walk always takes the first of them, so it
// cannot visit both. For a long fan this may return false although it is closed.
bool StarCensus::is_closed_fan(std::uint32_t v) const {
  if (at_.size() > kMostOfShortFan) return false;
  std::uint32_t visited = 1, next = at_[0].next;
  for (std::size_t count = 1; count < at_.size(); ++count) {
    const std::uint32_t after = corners_after(next);
    if (after == 0) return false;
    visited |= after & -after;
    next = at_[static_cast<std::size_t>(std::countr_zero(after))].next;
  }
  return visited == (1u << at_.size()) - 1 && next == at_[0].previous &&
         std::none_of(at_.begin(), at_.end(), [&](const Corner& corner) { return corner.next == v; });
}

// Half-edges with the same other end form an edge, and their triangles belong to one umbrella.
void StarCensus::look_closely_at(std::uint32_t v) {
  spokes_.clear();
  fans_.reset(at_.size());
  for (std::uint32_t k = 0; k < at_.size(); ++k) {
    spokes_.push_back({at_[k].next, k, true});
    spokes_.push_back({at_[k].previous, k, false});
  }
  std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) { return a.rank() < b.rank(); });
  for (auto first = spokes_.cbegin(); first != spokes_.cend();) {
    const bool is_loop = first->other == v;
    auto last = first;
    for (; last != spokes_.cend() && last->other == first->other && (!is_loop || last->leaves == first->leaves);
         ++last) {
      fans_.unite(first->corner, last->corner);
    }
    // Of a loop at v, the end that enters has been counted with the end that leaves.
    if (first->other > v || (is_loop && first->leaves)) count_edge(v, first, last - first);
    first = last;
  }
  std::int64_t umbrellas = 0;
  for (std::uint32_t k = 0; k < at_.size(); ++k) umbrellas += fans_.find(k) == k ? 1 : 0;
  counts_.non_manifold_vertices += umbrellas > 1 ? 1 : 0;
}

void StarCensus::count_edge(std::uint32_t v, std::vector<Spoke>::const_iterator first, std::ptrdiff_t half_edges) {
  add_edges(v, 1);
  if (half_edges == 1) {
    counts_.boundary_edges.push_back({v, first->other});
  } else if (half_edges == 2) {
    counts_.misoriented_edges += first->leaves == first[1].leaves ? 1 : 0;
  } else {
    ++counts_.non_manifold_edges;
  }
}

void StarCensus::add_to(MeshTopology& sum) const {
  sum.boundary_edges.insert(sum.boundary_edges.end(), counts_.boundary_edges.begin(), counts_.boundary_edges.end());
  sum.non_manifold_edges += counts_.non_manifold_edges;
  sum.non_manifold_vertices += counts_.non_manifold_vertices;
  sum.misoriented_edges += counts_.misoriented_edges;
  for (std::size_t c = 0; c < edges_.size(); ++c) sum.components[c].edges += edges_[c];
}

// Numbers the pieces and counts their vertices and triangles.
void find_components(std::size_t vertices, Triangles triangles, MeshTopology& topology) {
  DisjointSets sets(vertices);
  std::vector<std::uint8_t> referenced(vertices, 0);
  for (const auto& [a, b, c] : triangles) {
    if (!sets.share_parent(a, b)) sets.unite(a, b);
    if (!sets.share_parent(b, c)) sets.unite(b, c);
    referenced[a] = referenced[b] = referenced[c] = 1;
  }
  topology.component_of_vertex.assign(vertices, MeshTopology::kNoComponent);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (referenced[v] == 0) {
      ++topology.unreferenced_vertices;
      continue;
    }
    // The representative is the lowest vertex, so it is numbered before the others of its piece.
    const std::uint32_t lowest = sets.find(v);
    if (lowest == v) {
      topology.component_of_vertex[v] = static_cast<std::uint32_t>(topology.components.size());
      topology.components.emplace_back();
    }
    topology.component_of_vertex[v] = topology.component_of_vertex[lowest];
    ++topology.components[topology.component_of_vertex[v]].vertices;
  }
  for (const auto& triangle : triangles) {
    ++topology.components[topology.component_of_vertex[triangle[0]]].triangles;
  }
}

void count_boundary_loops(std::size_t vertex_count, MeshTopology& topology) {
  if (topology.boundary_edges.empty()) return;
  DisjointSets loops(vertex_count);
  std::vector<bool> on_boundary(vertex_count, false);
  for (const MeshEdge& edge : topology.boundary_edges) {
    loops.unite(edge.low, edge.high);
    on_boundary[edge.low] = on_boundary[edge.high] = true;
  }
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    if (on_boundary[v] && loops.find(v) == v) ++topology.components[topology.component_of_vertex[v]].boundary_loops;
  }
}

}  // namespace

MeshTopology mesh_topology(const TriangleMesh& mesh, int threads) {
  return mesh_topology(mesh.points.size(), mesh.triangles, threads);
}

MeshTopology mesh_topology(std::size_t vertices, Triangles triangles, int threads) {
  DELISO_CHECK(triangles.size() < std::numeric_limits<std::uint32_t>::max() / 3, "corners have 32-bit ids");
  MeshTopology topology;
  std::optional<VertexCorners> corners;
  run_tasks(2, threads, [&](std::size_t task) {
    if (task == 0) return find_components(vertices, triangles, topology);
    corners.emplace(vertices, triangles);
  });
  constexpr int kSharesPerThread = 4;  // some shares take longer: the vertices inserted first are far from each other
  const Shares shares(vertices, kSharesPerThread * threads);
  std::vector<StarCensus> parts(shares.count(), StarCensus(*corners, topology));
  shares.for_each(threads, [&](std::size_t share, std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) parts[share].look_at(static_cast<std::uint32_t>(v));
  });
  for (const StarCensus& part : parts) part.add_to(topology);
  count_boundary_loops(vertices, topology);
  topology.repeated_vertices = std::count_if(
      triangles.begin(), triangles.end(), [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return topology;
}

std::size_t first_bad_triangle(const TriangleMesh& mesh) {
  const auto bad = [&](const auto& t) { return std::max({t[0], t[1], t[2]}) >= mesh.points.size(); };
  return static_cast<std::size_t>(std::find_if(mesh.triangles.begin(), mesh.triangles.end(), bad) -
                                  mesh.triangles.begin());
}

void check_triangles(const TriangleMesh& mesh) {
  const std::size_t bad = first_bad_triangle(mesh);
  if (bad == mesh.triangles.size()) return;
  throw InputError("triangle " + std::to_string(bad) + " of the mesh names a vertex that is not there; it has " +
                   std::to_string(mesh.points.size()) + " vertices");
}

}  // namespace deliso

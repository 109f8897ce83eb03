#include "surface/refine/guard/clearances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <queue>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "delaunay/base/box3.h"

namespace deliso {

namespace {

// Vertices nearer to each other than this (mesh-space units) count as doubled.
constexpr double kOnTop = 2e-3;
// Clearances become 0 at the corners of a triangle whose box is this near to a given point (mesh-space units).
constexpr double kSuspectReach = 3;
// Side of the cells in which doubled vertices are searched. It is small compared to edges, and few of its multiples are
// integers, which are the coordinates of samples. Cells are numbered up to this distance from the origin.
constexpr double kCellSide = 0.26;
constexpr double kFarthestPlace = 1e15;

// A number for a cell; a collision of two cells does no harm.
std::uint64_t cell_number(const std::array<std::int64_t, 3>& cell) {
  std::uint64_t number = 0;
  for (const std::int64_t place : cell) {
    number = (number ^ static_cast<std::uint64_t>(place)) * 0x9E3779B97F4A7C15u;
    number ^= number >> 32;
  }
  return number;
}

// Calls visit(number) for the cells within half of kOnTop of p: two points nearer than kOnTop have such a cell in
// common.
template <class Visit>
void for_each_cell_around(const Vec3& p, Visit&& visit) {
  const auto place = [](double x) {
    return static_cast<std::int64_t>(std::clamp(std::floor(x / kCellSide), -kFarthestPlace, kFarthestPlace));
  };
  const Vec3 half{kOnTop / 2, kOnTop / 2, kOnTop / 2};
  const Vec3 low = p - half, high = p + half;
  for (std::int64_t z = place(low.z); z <= place(high.z); ++z) {
    for (std::int64_t y = place(low.y); y <= place(high.y); ++y) {
      for (std::int64_t x = place(low.x); x <= place(high.x); ++x) visit(cell_number({x, y, z}));
    }
  }
}

// Vertices that are nearer than kOnTop to another one.
std::vector<std::uint32_t> doubled_vertices(const RefinementMesh& mesh) {
  const auto& vertices = mesh.vertices;
  // Sorted by cell, then by x, so that only short runs of a crowded cell are compared.
  using InCell = std::tuple<std::uint64_t, double, std::uint32_t>;
  std::vector<InCell> in_cells;
  in_cells.reserve(vertices.size() + vertices.size() / 4);
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    const Vec3& p = vertices[v].point;
    for_each_cell_around(p, [&](std::uint64_t cell) { in_cells.emplace_back(cell, p.x, v); });
  }
  std::sort(in_cells.begin(), in_cells.end());
  std::vector<std::uint32_t> doubled;
  for (std::size_t i = 0; i < in_cells.size(); ++i) {
    const auto& [cell, x, v] = in_cells[i];
    for (std::size_t j = i + 1; j < in_cells.size(); ++j) {
      const auto& [other_cell, other_x, w] = in_cells[j];
      if (other_cell != cell || other_x - x >= kOnTop) break;
      if (v == w || squared_distance(vertices[v].point, vertices[w].point) >= kOnTop * kOnTop) continue;
      doubled.push_back(v);
      doubled.push_back(w);
    }
  }
  return doubled;
}

// Sets the clearance of the reached vertices to 0. From there on a vertex's clearance is bounded by its distance along
// edges.
void bound_clearances(RefinementMesh& mesh, std::span<const std::uint32_t> reached) {
  if (reached.empty()) return;
  auto& vertices = mesh.vertices;
  for (const std::uint32_t v : reached) vertices[v].clearance = 0;
  // The vertices that come after v in its triangles: after[first[v]] to after[first[v + 1]].
  std::vector<std::uint32_t> first(vertices.size() + 1, 0);
  for (const RefinementMesh::Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t.corners) ++first[v];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> after(3 * mesh.triangles.size());
  for (const RefinementMesh::Triangle& t : mesh.triangles) {
    for (unsigned i = 0; i < 3; ++i) after[--first[t.corners[i]]] = t.corners[(i + 1) % 3];
  }
  // The nearest first (Dijkstra 1959): in the order of their discovery vertices of a large mesh are bounded again and
  // again. Either way each gets the least bound.
  using Bound = std::pair<float, std::uint32_t>;
  std::priority_queue<Bound, std::vector<Bound>, std::greater<>> queue;
  for (const std::uint32_t v : reached) queue.emplace(0.0F, v);
  while (!queue.empty()) {
    const auto [clearance, v] = queue.top();
    queue.pop();
    if (clearance > vertices[v].clearance) continue;
    for (std::uint32_t i = first[v]; i < first[v + 1]; ++i) {
      const std::uint32_t w = after[i];
      const float bound = clearance + static_cast<float>(distance(vertices[v].point, vertices[w].point));
      if (bound >= vertices[w].clearance) continue;
      vertices[w].clearance = bound;
      queue.emplace(bound, w);
    }
  }
}

}  // namespace

void set_clearances(RefinementMesh& mesh) {
  for (RefinementMesh::Vertex& v : mesh.vertices) v.clearance = static_cast<float>(v.pole_height);
  bound_clearances(mesh, doubled_vertices(mesh));
}

void clear_clearances_near(RefinementMesh& mesh, std::span<const Vec3> suspects) {
  if (suspects.empty()) return;
  // Mostly all of them are close together.
  Box3 around;
  for (const Vec3& p : suspects) around.extend(p);
  around.extend(around.low - Vec3{kSuspectReach, kSuspectReach, kSuspectReach});
  around.extend(around.high + Vec3{kSuspectReach, kSuspectReach, kSuspectReach});
  std::vector<std::uint32_t> reached;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Box3 box = mesh.box_of(t);
    if (!box.meets(around)) continue;
    if (std::any_of(suspects.begin(), suspects.end(),
                    [&](const Vec3& p) { return squared_distance(p, box.clamp(p)) < kSuspectReach * kSuspectReach; })) {
      const auto& corners = mesh.triangles[t].corners;
      reached.insert(reached.end(), corners.begin(), corners.end());
    }
  }
  bound_clearances(mesh, reached);
}

void clear_all_clearances(RefinementMesh& mesh) {
  for (RefinementMesh::Vertex& v : mesh.vertices) v.clearance = 0;
}

}  // namespace deliso

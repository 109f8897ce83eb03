#include "volume/marching_cubes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "delaunay/base/check.h"
#include "volume/exact_topology_cell.h"
#include "volume/exact_topology_crossings.h"
#include "volume/trilinear_cell.h"

namespace deliso {

namespace {

// A loop of crossings on a cell's boundary, counterclockwise around the surface's piece seen from the lower side.
struct Loop {
  std::size_t size = 0;
  std::array<int, kCellEdges> edges{};
};

// Bit f is set for the two faces that contain the edge.
unsigned faces_of_edge(int edge) {
  const CellEdge e = cell_edge(edge);
  unsigned faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis != e.axis) faces |= 1u << (2 * axis + (e.corner >> axis & 1));
  }
  return faces;
}

// Triangulates one cell after the other.
class CellTriangulation {
 public:
  CellTriangulation(const ScalarGrid& grid, double isovalue, const CrossingIndex& index,
                    std::span<const EdgeCrossing> crossings)
      : grid_(grid), isovalue_(isovalue), index_(index), crossings_(crossings), vertex_count_(crossings.size()) {}

  const MarchingCubesPatch& triangulate(const CellIndex& cell, std::uint8_t pattern);

 private:
  void add_exact_pieces(const CellCorners& corners, const std::array<Loop, kMaxCellPieces>& loops, std::size_t count);
  void add_disk(const Loop& loop);
  void add_tunnel(Loop outer, Loop inner);
  std::uint32_t add_inner_point(const Vec3& near);

  [[nodiscard]] std::uint32_t vertex(int edge) const { return places_[static_cast<std::size_t>(edge)]; }
  [[nodiscard]] const Vec3& point(int edge) const { return patch_.points[vertex(edge)]; }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { patch_.triangles.push_back({a, b, c}); }

  const ScalarGrid& grid_;
  double isovalue_;
  const CrossingIndex& index_;
  std::span<const EdgeCrossing> crossings_;
  std::size_t vertex_count_;  // crossings, and the inner points of the cells so far

  MarchingCubesPatch patch_;                        // the cell at hand
  std::array<std::uint32_t, kCellEdges> places_{};  // of its crossings in patch_.vertices, by edge
};

// Splits the crossings of a cell into loops; returns their number.
std::size_t split_into_loops(const EdgeSuccessors& next, std::array<Loop, kMaxCellPieces>& loops) {
  std::size_t count = 0;
  std::array<bool, kCellEdges> seen{};
  for (int start = 0; start < kCellEdges; ++start) {
    if (next[static_cast<std::size_t>(start)] < 0 || seen[static_cast<std::size_t>(start)]) continue;
    Loop& loop = loops[count++];
    int edge = start;
    do {
      seen[static_cast<std::size_t>(edge)] = true;
      loop.edges[loop.size++] = edge;
      edge = next[static_cast<std::size_t>(edge)];
    } while (edge != start);
  }
  return count;
}

// The one loop of a simple sign pattern (is_simple), from a table.
const Loop& simple_loop(std::uint8_t pattern) {
  static const std::array<Loop, 256> kLoops = [] {
    std::array<Loop, 256> table;
    for (unsigned p = 0; p < 256; ++p) {
      std::array<Loop, kMaxCellPieces> loops;
      split_into_loops(edge_successors(static_cast<std::uint8_t>(p), 0), loops);
      table[p] = loops[0];
    }
    return table;
  }();
  return kLoops[pattern];
}

const MarchingCubesPatch& CellTriangulation::triangulate(const CellIndex& cell, std::uint8_t pattern) {
  patch_.cell = cell;
  patch_.vertices.clear();
  patch_.points.clear();
  patch_.triangles.clear();
  for (unsigned edges = crossed_edges(pattern); edges != 0; edges &= edges - 1) {
    const int edge = std::countr_zero(edges);
    const CellEdge e = cell_edge(edge);
    const CellIndex sample{cell[0] + (e.corner & 1), cell[1] + (e.corner >> 1 & 1), cell[2] + (e.corner >> 2)};
    const std::uint32_t crossing = index_.number(sample[0], sample[1], sample[2], e.axis);
    Vec3 at{static_cast<double>(sample[0]), static_cast<double>(sample[1]), static_cast<double>(sample[2])};
    at[static_cast<std::size_t>(e.axis)] += crossings_[crossing].t;
    places_[static_cast<std::size_t>(edge)] = static_cast<std::uint32_t>(patch_.vertices.size());
    patch_.vertices.push_back(crossing);
    patch_.points.push_back(at);
  }
  patch_.crossing_count = patch_.vertices.size();
  if (is_simple(pattern)) {
    add_disk(simple_loop(pattern));
    return patch_;
  }
  const CellCorners corners = grid_.cell(cell[0], cell[1], cell[2]);
  unsigned joined = 0;
  for (int face = 0; face < kCellFaces; ++face) {
    if (is_ambiguous_face(pattern, face) && above_joined_on_face(corners, isovalue_, face)) joined |= 1u << face;
  }
  std::array<Loop, kMaxCellPieces> loops;
  const std::size_t count = split_into_loops(edge_successors(pattern, joined), loops);
  add_exact_pieces(corners, loops, count);
  return patch_;
}

// A piece of a trilinear isosurface in a cell is a disk or a tunnel between two loops.
void CellTriangulation::add_exact_pieces(const CellCorners& corners, const std::array<Loop, kMaxCellPieces>& loops,
                                         std::size_t count) {
  const CellSweep sweep(corners, isovalue_);
  for (int piece = 0; piece < sweep.pieces(); ++piece) {
    std::array<const Loop*, kMaxCellPieces> own{};
    std::size_t own_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (sweep.piece_of_edge(loops[i].edges[0]) == piece) own[own_count++] = &loops[i];
    }
    const int euler = sweep.euler_characteristic(piece);
    if (own_count == 1 && euler == 1) {
      add_disk(*own[0]);
    } else {
      DELISO_CHECK(own_count == 2 && euler == 0, "a cell's piece is a disk or a tunnel");
      add_tunnel(*own[0], *own[1]);
    }
  }
}

// Triangulates the loop by the chords of least total squared length. A chord between two crossings of one face is
// forbidden, for the cell across that face might draw it too; when no other triangulation exists, an inner point
// serves.
void CellTriangulation::add_disk(const Loop& loop) {
  const std::size_t n = loop.size;
  if (n == 3) return add_triangle(vertex(loop.edges[0]), vertex(loop.edges[1]), vertex(loop.edges[2]));

  // cost[i][j]: least cost of the polygon i, i + 1, ..., j with its chord ij; split[i][j]: the third corner of its
  // triangle at that chord.
  std::array<std::array<double, kCellEdges>, kCellEdges> cost{};
  std::array<std::array<std::size_t, kCellEdges>, kCellEdges> split{};
  for (std::size_t length = 2; length < n; ++length) {
    for (std::size_t i = 0; i + length < n; ++i) {
      const std::size_t j = i + length;
      const int a = loop.edges[i];
      const int b = loop.edges[j];
      cost[i][j] = std::numeric_limits<double>::infinity();
      if (length + 1 < n && (faces_of_edge(a) & faces_of_edge(b)) != 0) continue;
      for (std::size_t m = i + 1; m < j; ++m) {
        if (cost[i][m] + cost[m][j] >= cost[i][j]) continue;
        cost[i][j] = cost[i][m] + cost[m][j];
        split[i][j] = m;
      }
      cost[i][j] += squared_distance(point(a), point(b));
    }
  }
  if (!std::isfinite(cost[0][n - 1])) {
    Vec3 center;
    for (std::size_t i = 0; i < n; ++i) center += point(loop.edges[i]) / static_cast<double>(n);
    const std::uint32_t apex = add_inner_point(center);
    for (std::size_t i = 0; i < n; ++i) add_triangle(vertex(loop.edges[i]), vertex(loop.edges[(i + 1) % n]), apex);
    return;
  }

  // Read the triangles off, from the whole polygon down.
  std::array<std::array<std::size_t, 2>, kCellEdges> open{};
  std::size_t open_count = 0;
  open[open_count++] = {0, n - 1};
  while (open_count > 0) {
    const auto [i, j] = open[--open_count];
    const std::size_t m = split[i][j];
    add_triangle(vertex(loop.edges[i]), vertex(loop.edges[m]), vertex(loop.edges[j]));
    if (m > i + 1) open[open_count++] = {i, m};
    if (j > m + 1) open[open_count++] = {m, j};
  }
}

// A tunnel: a ring of inner points, as many as the longer loop has, joined to both loops.
void CellTriangulation::add_tunnel(Loop outer, Loop inner) {
  if (outer.size < inner.size) std::swap(outer, inner);
  const std::size_t n = outer.size;
  const std::size_t m = inner.size;

  // Walk the shorter loop backwards, alongside the longer one, from its crossing nearest to the longer one's first.
  std::reverse(inner.edges.begin(), inner.edges.begin() + static_cast<std::ptrdiff_t>(m));
  const auto nearest =
      std::min_element(inner.edges.begin(), inner.edges.begin() + static_cast<std::ptrdiff_t>(m), [&](int a, int b) {
        const Vec3& first = point(outer.edges[0]);
        return squared_distance(first, point(a)) < squared_distance(first, point(b));
      });
  std::rotate(inner.edges.begin(), nearest, inner.edges.begin() + static_cast<std::ptrdiff_t>(m));
  const auto partner = [&](std::size_t k) { return k * m / n; };  // of the outer crossing k; n stands for a full turn
  const auto outer_vertex = [&](std::size_t k) { return vertex(outer.edges[k % n]); };
  const auto inner_vertex = [&](std::size_t k) { return vertex(inner.edges[k % m]); };

  std::array<std::uint32_t, kCellEdges> ring{};
  for (std::size_t k = 0; k < n; ++k) {
    ring[k] = add_inner_point(0.5 * (point(outer.edges[k]) + point(inner.edges[partner(k)])));
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t here = ring[k];
    const std::uint32_t there = ring[(k + 1) % n];
    add_triangle(outer_vertex(k), outer_vertex(k + 1), here);
    add_triangle(outer_vertex(k + 1), there, here);
    add_triangle(here, there, inner_vertex(partner(k)));
    if (partner(k + 1) > partner(k)) add_triangle(there, inner_vertex(partner(k + 1)), inner_vertex(partner(k)));
  }
}

// Adds a point of the surface inside the cell, as near to `near` as a few Newton steps along the gradient come. Its
// place only measures: the mesh is right wherever it lies.
std::uint32_t CellTriangulation::add_inner_point(const Vec3& near) {
  static constexpr double kMargin = 1e-3;
  constexpr int kSteps = 8;
  const auto [i, j, k] = patch_.cell;
  const CellCorners corners = grid_.cell(i, j, k);
  const Vec3 base{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
  const auto inside = [](const Vec3& p) {
    return Vec3{std::clamp(p.x, kMargin, 1 - kMargin), std::clamp(p.y, kMargin, 1 - kMargin),
                std::clamp(p.z, kMargin, 1 - kMargin)};
  };
  Vec3 best = inside(near - base);
  double best_residual = std::abs(trilinear_value(corners, best) - isovalue_);
  Vec3 p = best;
  for (int step = 0; step < kSteps; ++step) {
    const Vec3 gradient = trilinear_gradient(corners, p);
    const double slope = squared_norm(gradient);
    if (!(slope > 0)) break;
    p = inside(p - (trilinear_value(corners, p) - isovalue_) / slope * gradient);
    const double residual = std::abs(trilinear_value(corners, p) - isovalue_);
    if (!(residual < best_residual)) break;
    best = p;
    best_residual = residual;
  }
  patch_.vertices.push_back(static_cast<std::uint32_t>(vertex_count_++));
  patch_.points.push_back(base + best);
  return static_cast<std::uint32_t>(patch_.points.size() - 1);
}

}  // namespace

MarchingCubesMesh marching_cubes(const ScalarGrid& grid, double isovalue) {
  DELISO_CHECK(std::isfinite(isovalue), "an isovalue is a finite number");
  const CrossingIndex index(grid, isovalue);
  return marching_cubes(grid, isovalue, index, list_crossings(grid, isovalue, index));
}

MarchingCubesMesh marching_cubes(const ScalarGrid& grid, double isovalue, const CrossingIndex& index,
                                 std::span<const EdgeCrossing> crossings) {
  MarchingCubesMesh mesh;
  mesh.points.reserve(crossings.size());
  for (const EdgeCrossing& crossing : crossings) mesh.points.push_back(crossing_position(grid, crossing));
  mesh.crossing_count = mesh.points.size();
  mesh.triangles.reserve(2 * mesh.crossing_count);
  for_each_marching_cubes_patch(grid, isovalue, index, crossings, [&](const MarchingCubesPatch& patch) {
    mesh.points.insert(mesh.points.end(), patch.points.begin() + static_cast<std::ptrdiff_t>(patch.crossing_count),
                       patch.points.end());
    for (const auto& [a, b, c] : patch.triangles) {
      mesh.triangles.push_back({patch.vertices[a], patch.vertices[b], patch.vertices[c]});
    }
  });
  for (Vec3& point : mesh.points) point = grid.origin() + scaled(point, grid.spacing());
  return mesh;
}

void for_each_marching_cubes_patch(const ScalarGrid& grid, double isovalue, const CrossingIndex& index,
                                   std::span<const EdgeCrossing> crossings,
                                   const std::function<void(const MarchingCubesPatch&)>& visit) {
  CellTriangulation cells(grid, isovalue, index, crossings);
  index.for_each_active_cell(
      [&](const CellIndex& cell, std::uint8_t pattern) { visit(cells.triangulate(cell, pattern)); });
}

}  // namespace deliso

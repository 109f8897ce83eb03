#include "volume/marching_cubes/cell_triangulation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "delaunay/base/check.h"
#include "volume/topology/cell_sweep.h"
#include "volume/trilinear_cell.h"

namespace deliso {

const MarchingCubesPatch& CellTriangulation::triangulate(const CellIndex& cell, std::uint8_t pattern) {
  patch_.cell = cell;
  patch_.vertices.clear();
  patch_.points.clear();
  patch_.triangles.clear();
  add_crossings(pattern);
  if (is_simple(pattern)) {
    add_disk(simple_loop(pattern));  // the chords alone triangulate it, without an inner point
    return patch_;
  }
  corners_ = grid_.cell(cell[0], cell[1], cell[2]);
  find_pieces(pattern);
  const auto add_ring_of = [this](const Piece& tunnel) { add_ring(tunnel.loop, tunnel.other); };
  if (!draw(add_ring_of) && !draw_otherwise()) draw(add_ring_of);
  vertex_count_ += patch_.points.size() - patch_.crossing_count;
  return patch_;
}

void CellTriangulation::add_crossings(std::uint8_t pattern) {
  for (unsigned edges = crossed_edges(pattern); edges != 0; edges &= edges - 1) {
    const int edge = std::countr_zero(edges);
    const std::uint32_t crossing = index_.number(patch_.cell, edge);
    places_[static_cast<std::size_t>(edge)] = static_cast<std::uint32_t>(patch_.vertices.size());
    patch_.vertices.push_back(crossing);
    patch_.points.push_back(crossing_position(grid_, crossings_[crossing]));
  }
  patch_.crossing_count = patch_.vertices.size();
}

// A piece of a trilinear isosurface in a cell is a disk or a tunnel between two loops.
void CellTriangulation::find_pieces(std::uint8_t pattern) {
  unsigned joined = 0;
  for (int face = 0; face < kCellFaces; ++face) {
    if (is_ambiguous_face(pattern, face) && above_joined_on_face(corners_, isovalue_, face)) joined |= 1u << face;
  }
  std::array<CellLoop, kMaxCellPieces> loops;
  const std::size_t count = split_into_loops(edge_successors(pattern, joined), loops);
  const CellSweep sweep(corners_, isovalue_);
  pieces_.clear();
  for (int piece = 0; piece < sweep.pieces(); ++piece) {
    std::array<const CellLoop*, kMaxCellPieces> own{};
    std::size_t own_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (sweep.piece_of_edge(loops[i].edges[0]) == piece) own[own_count++] = &loops[i];
    }
    const int euler = sweep.euler_characteristic(piece);
    if (own_count == 1 && euler == 1) {
      pieces_.push_back({*own[0], {}});
    } else {
      DELISO_CHECK(own_count == 2 && euler == 0, "a cell's piece is a disk or a tunnel");
      pieces_.push_back({*own[0], *own[1]});
    }
  }
}

bool CellTriangulation::is_embedded(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) const {
  const auto has_area = [&](const Triangle& t) { return tests_->has_area(points[t[0]], points[t[1]], points[t[2]]); };
  if (!std::all_of(triangles.begin(), triangles.end(), has_area)) return false;
  std::vector<Box3> boxes(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) boxes[t].extend(points[v]);
    for (std::size_t s = 0; s < t; ++s) {
      if (boxes[s].meets(boxes[t]) && tests_->meet(points, triangles[s], triangles[t])) return false;
    }
  }
  return true;
}

bool CellTriangulation::draw(const std::function<void(const Piece&)>& add_tunnel) {
  patch_.vertices.resize(patch_.crossing_count);
  patch_.points.resize(patch_.crossing_count);
  patch_.triangles.clear();
  is_on_surface_ = true;
  for (const Piece& piece : pieces_) {
    if (piece.is_disk()) {
      add_disk(piece.loop);
    } else {
      add_tunnel(piece);
    }
  }
  return tests_ == nullptr || (is_on_surface_ && is_embedded(patch_.points, patch_.triangles));
}

// Triangulates the loop by the chords of least total squared length. A chord between two crossings of one face is
// forbidden, because the cell across that face might draw it too. If no other triangulation exists, an inner point is
// used.
void CellTriangulation::add_disk(const CellLoop& loop) {
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
      if (length + 1 < n && have_common_face(a, b)) continue;
      for (std::size_t m = i + 1; m < j; ++m) {
        if (cost[i][m] + cost[m][j] >= cost[i][j]) continue;
        cost[i][j] = cost[i][m] + cost[m][j];
        split[i][j] = m;
      }
      cost[i][j] += squared_distance(point(a), point(b));
    }
  }
  if (!std::isfinite(cost[0][n - 1])) {
    const std::uint32_t apex = add_inner_point(apex_of(loop));
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

// Projects the centre of the crossings onto the surface or, if that fails, points between the centre and a crossing.
CellTriangulation::SurfacePoint CellTriangulation::apex_of(const CellLoop& loop) const {
  Vec3 centre;
  for (std::size_t i = 0; i < loop.size; ++i) centre += point(loop.edges[i]) / static_cast<double>(loop.size);
  const SurfacePoint best = onto_surface(centre);
  if (best.is_near) return best;
  for (const double depth : {0.5, 0.25, 0.125}) {
    for (std::size_t i = 0; i < loop.size; ++i) {
      const Vec3& crossing = point(loop.edges[i]);
      const SurfacePoint other = onto_surface(crossing + depth * (centre - crossing));
      if (other.is_near) return other;
    }
  }
  return best;
}

// A tunnel: a ring of inner points, as many as the longer loop has, joined to both loops.
void CellTriangulation::add_ring(CellLoop outer, CellLoop inner) {
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
    ring[k] = add_inner_point(onto_surface(0.5 * (point(outer.edges[k]) + point(inner.edges[partner(k)]))));
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

// Moves a point onto the surface inside the cell, as near as a few Newton steps along the gradient come. The position
// affects only the geometry: the topology is right wherever the point lies.
CellTriangulation::SurfacePoint CellTriangulation::onto_surface(const Vec3& near) const {
  static constexpr double kMargin = 1e-3;
  constexpr int kSteps = 8;
  const auto inside = [](const Vec3& p) {
    return Vec3{std::clamp(p.x, kMargin, 1 - kMargin), std::clamp(p.y, kMargin, 1 - kMargin),
                std::clamp(p.z, kMargin, 1 - kMargin)};
  };
  Vec3 best = inside(near - base());
  double best_residual = std::abs(trilinear_value(corners_, best) - isovalue_);
  Vec3 p = best;
  for (int step = 0; step < kSteps; ++step) {
    const Vec3 gradient = trilinear_gradient(corners_, p);
    const double slope = squared_norm(gradient);
    if (!(slope > 0)) break;
    p = inside(p - (trilinear_value(corners_, p) - isovalue_) / slope * gradient);
    const double residual = std::abs(trilinear_value(corners_, p) - isovalue_);
    if (!(residual < best_residual)) break;
    best = p;
    best_residual = residual;
  }
  return {base() + best, best_residual <= 1e-4 * norm(trilinear_gradient(corners_, best))};
}

std::uint32_t CellTriangulation::add_inner_point(const SurfacePoint& p) {
  is_on_surface_ &= p.is_near;
  return add_point(p.at);
}

std::uint32_t CellTriangulation::add_point(const Vec3& at) {
  patch_.vertices.push_back(static_cast<std::uint32_t>(vertex_count_ + patch_.points.size() - patch_.crossing_count));
  patch_.points.push_back(at);
  return static_cast<std::uint32_t>(patch_.points.size() - 1);
}

Vec3 CellTriangulation::base() const {
  const auto [i, j, k] = patch_.cell;
  return {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
}

}  // namespace deliso

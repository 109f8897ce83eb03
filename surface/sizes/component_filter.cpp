#include "surface/sizes/component_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "delaunay/base/box3.h"
#include "surface/certificate/mesh_pieces.h"

namespace deliso {

namespace {

MeasuredPiece measure(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& triangles, Inside inside) {
  MeasuredPiece piece;
  piece.vertices = static_cast<std::int64_t>(vertices_of(mesh, triangles).size());
  piece.at = mesh.points[mesh.triangles[triangles.front()][0]];
  bool is_closed = true;
  double volume = 0;
  for (const std::uint32_t t : triangles) {
    const auto& [ia, ib, ic] = mesh.triangles[t];
    const Vec3 a = mesh.points[ia] - piece.at, b = mesh.points[ib] - piece.at, c = mesh.points[ic] - piece.at;
    piece.area += norm(cross(b - a, c - a)) / 2;
    volume += dot(a, cross(b, c)) / 6;
    for (const TriangleSide side : mesh.neighbours[t]) is_closed = is_closed && side != kNoSide;
  }
  if (is_closed) piece.volume = inside == Inside::kBelow ? -volume : volume;
  return piece;
}

// The solid angle that a triangle takes up from p, with the sign of its side (van Oosterom and Strackee, 1983).
double solid_angle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = a - p, v = b - p, w = c - p;
  const double lu = norm(u), lv = norm(v), lw = norm(w);
  return 2 * std::atan2(dot(u, cross(v, w)), lu * lv * lw + dot(u, v) * lw + dot(v, w) * lu + dot(w, u) * lv);
}

// Marks all pieces within a closed one. Pieces do not meet, so one vertex of each tells.
void mark_within(const SurfaceMesh& mesh, const MeasuredPieces& measured, std::uint32_t around,
                 std::vector<DropCause>& causes) {
  Box3 box;
  std::vector<std::uint32_t> shell;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (measured.piece_of[t] != around) continue;
    shell.push_back(t);
    for (const std::uint32_t v : mesh.triangles[t]) box.extend(mesh.points[v]);
  }
  for (std::uint32_t piece = 0; piece < causes.size(); ++piece) {
    const Vec3& p = measured.pieces[piece].at;
    if (causes[piece] != DropCause::kNone || !box.contains(p)) continue;
    double angle = 0;
    for (const std::uint32_t t : shell) {
      const auto& [a, b, c] = mesh.triangles[t];
      angle += solid_angle(p, mesh.points[a], mesh.points[b], mesh.points[c]);
    }
    if (std::abs(angle) > 2 * std::numbers::pi) causes[piece] = DropCause::kCavity;
  }
}

bool is_small(const MeasuredPiece& piece, const ComponentParameters& wanted) {
  return (wanted.min_vertices && piece.vertices < *wanted.min_vertices) ||
         (wanted.min_area && piece.area < *wanted.min_area) ||
         (wanted.min_volume && piece.volume && std::abs(*piece.volume) < *wanted.min_volume);
}

}  // namespace

MeasuredPieces measure_pieces(const SurfaceMesh& mesh, Inside inside) {
  MeasuredPieces measured;
  measured.piece_of = number_pieces(
      mesh, [&](const std::vector<std::uint32_t>& piece) { measured.pieces.push_back(measure(mesh, piece, inside)); });
  return measured;
}

std::vector<DropCause> pieces_to_drop(const SurfaceMesh& mesh, const MeasuredPieces& measured,
                                      const ComponentParameters& wanted) {
  const std::vector<MeasuredPiece>& pieces = measured.pieces;
  std::vector<DropCause> causes(pieces.size(), DropCause::kNone);
  if (wanted.fill_cavities) {
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      if (!pieces[i].volume || *pieces[i].volume >= 0) continue;
      causes[i] = DropCause::kCavity;
      mark_within(mesh, measured, i, causes);
    }
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (causes[i] == DropCause::kNone && is_small(pieces[i], wanted)) causes[i] = DropCause::kSmall;
  }
  if (!wanted.keep_largest) return causes;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (causes[i] == DropCause::kNone) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return pieces[i].area > pieces[j].area; });
  for (auto i = static_cast<std::size_t>(*wanted.keep_largest); i < order.size(); ++i) {
    causes[order[i]] = DropCause::kNotLargest;
  }
  return causes;
}

}  // namespace deliso

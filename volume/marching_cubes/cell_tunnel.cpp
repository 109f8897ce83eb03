// Other ways to draw a tunnel whose ring of inner points makes triangles that meet. They are tried one after the other.
//
// The last way fails only where crossings are rounded to samples or into collinear positions. A grid edge holds at most
// one crossing, so every crossing of the cell is a corner of the convex hull H of all. The chords of the loops are
// sides of the polygons that H shares with the cell's faces, so they are edges of H. The loops cut the boundary of H
// into regions, and one region joins the loops of the tunnel. Shrink it slightly towards a point within H, and join its
// rims to the loops: seen from that point no triangle hides another. A disk beside the tunnel (at most one has been
// seen) is a triangle that cuts off a corner of the cell. It is a facet of H, and lies outside of the shrunken region.
#include <algorithm>
#include <limits>

#include "delaunay/base/rng.h"
#include "volume/marching_cubes/cell_triangulation.h"
#include "volume/marching_cubes/hull_annulus.h"

namespace deliso {

// Precondition, here as below: exact tests are given. A cell has at most one tunnel.
bool CellTriangulation::draw_otherwise() {
  const auto tunnel = std::find_if(pieces_.begin(), pieces_.end(), [](const Piece& piece) { return !piece.is_disk(); });
  if (tunnel == pieces_.end()) return false;
  // First without inner points; then with rings on the surface, moved into the cell by these fractions, from one loop
  // or from both.
  if (draw_bands(*tunnel, {0, 0})) return true;
  for (const double depth : {0.5, 0.25, 0.125}) {
    if (draw_bands(*tunnel, {0, depth}) || draw_bands(*tunnel, {depth, 0}) || draw_bands(*tunnel, {depth, depth})) {
      return true;
    }
  }
  // The rings are so near to the loops, which lie on the surface, that they need not be moved onto it.
  constexpr double kShallow = 0x1p-12;
  return draw_part_of_hull(kShallow);
}

// Tries bands of least total squared length of chords, one band for each start. A chord between two crossings of one
// face is forbidden.
bool CellTriangulation::draw_bands(const Piece& tunnel, const std::array<double, 2>& depths) {
  const std::optional<Rim> first = rim(tunnel.loop, depths[0]), second = rim(tunnel.other, depths[1]);
  if (!first || !second) return false;
  const auto chord_cost = [&](std::size_t i, std::size_t j) {
    j = tunnel.other.size - 1 - j;
    const bool is_forbidden =
        first->is_loop && second->is_loop && have_common_face(tunnel.loop.edges[i], tunnel.other.edges[j]);
    return is_forbidden ? std::numeric_limits<double>::infinity()
                        : squared_distance(first->points[i], second->points[j]);
  };
  const std::vector<LoopBand> bands = loop_bands(tunnel.loop.size, tunnel.other.size, chord_cost);
  return std::any_of(bands.begin(), bands.end(), [&](const LoopBand& band) {
    return draw([&](const Piece& piece) { add_band(piece, {*first, *second}, band); }) && stays_embedded();
  });
}

// Whether the triangles still do not meet after small displacements. In symmetric cells triangles may be only a
// rounding apart, and would meet elsewhere in the volume or with another spacing.
bool CellTriangulation::stays_embedded() const {
  constexpr int kTrials = 8;
  constexpr double kStep = 0x1p-20;
  Rng rng(1);
  std::vector<Vec3> moved(patch_.points.size());
  for (int trial = 0; trial < kTrials; ++trial) {
    // A crossing stays on its edge, where only one of these distances from the cell's faces is not zero.
    for (std::size_t v = 0; v < moved.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double from_low = patch_.points[v][axis] - base()[axis];
        moved[v][axis] = from_low + kStep * rng.uniform(-1, 1) * std::min(from_low, 1 - from_low);
      }
    }
    if (!is_embedded(moved, patch_.triangles)) return false;
  }
  return true;
}

// False also when rounding has moved an inner point onto the cell's boundary, which is near.
bool CellTriangulation::draw_part_of_hull(double depth) {
  const Vec3 low = base();
  const auto is_inside = [&](const Vec3& p) {
    return std::min({p.x - low.x, p.y - low.y, p.z - low.z}) > 0 &&
           std::max({p.x - low.x, p.y - low.y, p.z - low.z}) < 1;
  };
  bool has_region = false;
  return draw([&](const Piece& piece) { has_region = add_part_of_hull(piece, depth); }) && has_region &&
         std::all_of(patch_.points.begin() + static_cast<std::ptrdiff_t>(patch_.crossing_count), patch_.points.end(),
                     is_inside);
}

// The rim moved into the cell by this fraction; nothing if it does not come to lie on the surface.
std::optional<CellTriangulation::Rim> CellTriangulation::rim(const CellLoop& loop, double depth) const {
  Rim result;
  result.is_loop = depth == 0;
  for (std::size_t k = 0; k < loop.size; ++k) {
    result.points[k] = point(loop.edges[k]);
    if (result.is_loop) continue;
    const SurfacePoint inner = onto_surface(drawn_in(result.points[k], depth));
    if (!inner.is_near) return std::nullopt;
    result.points[k] = inner.at;
  }
  return result;
}

// A point moved by this fraction of its way to the centre of the crossings.
Vec3 CellTriangulation::drawn_in(const Vec3& at, double depth) const {
  Vec3 centre;
  for (std::size_t v = 0; v < patch_.crossing_count; ++v) {
    centre += patch_.points[v] / static_cast<double>(patch_.crossing_count);
  }
  return at + depth * (centre - at);
}

// Adds a ring and joins it to its loop.
std::array<std::uint32_t, kCellEdges> CellTriangulation::add_rim(const CellLoop& loop, const Rim& rim) {
  std::array<std::uint32_t, kCellEdges> corners{};
  for (std::size_t k = 0; k < loop.size; ++k) {
    corners[k] = rim.is_loop ? vertex(loop.edges[k]) : add_point(rim.points[k]);
  }
  for (std::size_t k = 0; k < loop.size && !rim.is_loop; ++k) {
    const std::size_t next = (k + 1) % loop.size;
    add_triangle(vertex(loop.edges[k]), vertex(loop.edges[next]), corners[k]);
    add_triangle(vertex(loop.edges[next]), corners[next], corners[k]);
  }
  return corners;
}

void CellTriangulation::add_band(const Piece& tunnel, const std::array<Rim, 2>& rims, const LoopBand& band) {
  const auto first = add_rim(tunnel.loop, rims[0]), second = add_rim(tunnel.other, rims[1]);
  const std::size_t n = tunnel.loop.size, m = tunnel.other.size;
  // The loops run against each other, so the second one is walked backwards.
  const auto first_corner = [&](std::size_t i) { return first[i % n]; };
  const auto second_corner = [&](std::size_t j) { return second[m - 1 - (band.start + j) % m]; };
  for (std::size_t i = 0, j = 0; i + j < n + m;) {
    if ((band.along_second >> (i + j) & 1u) != 0) {
      add_triangle(first_corner(i), second_corner(j + 1), second_corner(j));
      ++j;
    } else {
      add_triangle(first_corner(i), first_corner(i + 1), second_corner(j));
      ++i;
    }
  }
}

// False when the hull has no region between the loops: rounded crossings may fail to be corners of the hull.
bool CellTriangulation::add_part_of_hull(const Piece& tunnel, double depth) {
  // The region of the hull that joins the loops, by indices into the patch.
  const auto polygon = [&](const CellLoop& loop) {
    std::vector<std::uint32_t> corners;
    for (std::size_t k = 0; k < loop.size; ++k) corners.push_back(vertex(loop.edges[k]));
    return corners;
  };
  const std::vector<Vec3> crossings(patch_.points.begin(),
                                    patch_.points.begin() + static_cast<std::ptrdiff_t>(patch_.crossing_count));
  const auto region = hull_annulus(crossings, polygon(tunnel.loop), polygon(tunnel.other), *tests_);
  if (region.empty()) return false;
  // A shrunken copy of it, between copies of the loops.
  constexpr std::uint32_t kNone = 0;  // a crossing's number
  std::array<std::uint32_t, kCellEdges> copies{};
  for (const CellLoop& loop : {tunnel.loop, tunnel.other}) {
    Rim rim;
    rim.is_loop = false;
    for (std::size_t k = 0; k < loop.size; ++k) rim.points[k] = drawn_in(point(loop.edges[k]), depth);
    const auto corners = add_rim(loop, rim);
    for (std::size_t k = 0; k < loop.size; ++k) copies[vertex(loop.edges[k])] = corners[k];
  }
  for (const auto& [a, b, c] : region) {
    for (const std::uint32_t v : {a, b, c}) {
      if (copies[v] == kNone) copies[v] = add_point(drawn_in(crossings[v], depth));  // of a loop in between
    }
    add_triangle(copies[a], copies[b], copies[c]);
  }
  return true;
}

}  // namespace deliso

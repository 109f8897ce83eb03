#include "surface/repair/lattice/sample_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "surface/repair/lattice/cell_pieces.h"

namespace deliso {

namespace {

// A key has the kind in its highest bits (0-2: a line along that axis, 3: an arc or a saddle), then the position.
constexpr std::uint64_t kind_bits(std::uint64_t kind) { return (kind + 1) << 61; }

std::uint64_t line_key(std::size_t axis, const std::array<std::uint64_t, 3>& coordinates) {
  return kind_bits(axis) | coordinates[0] | coordinates[1] << kCoordinateBits | coordinates[2] << 2 * kCoordinateBits;
}

// Linear interpolation that is exact at both ends.
double mix(double from, double to, double weight) { return (1 - weight) * from + weight * to; }

}  // namespace

SampleLattice::SampleLattice(const ExactSurface& surface)
    : grid_(surface.grid()),
      isovalue_(surface.isosurface.isovalue()),
      topology_(surface.topology),
      pieces_(cell_pieces(surface.isosurface)) {}

void SampleLattice::append(const CellIndex& cell, int level, std::vector<LatticeSample>& samples) const {
  append_lines(cell, level <= 2 ? 1 : 1 << (level - 2), samples);
  if (level < 2) return;
  append_arcs(cell, samples);
  append_saddles(cell, samples);
}

// Appends the crossings of the lines at multiples of 1 / parts_of_piece of a piece along each axis.
void SampleLattice::append_lines(const CellIndex& cell, int parts_of_piece, std::vector<LatticeSample>& samples) const {
  const CellCorners corners = grid_.cell(cell[0], cell[1], cell[2]);
  // A coordinate in units of the lattice's finest part.
  const auto place = [&](std::size_t axis, std::int32_t part) {
    const std::int64_t parts = std::int64_t{cell[axis]} * pieces_[axis] * parts_of_piece + part;
    return static_cast<std::uint64_t>(parts * (kFinestParts / parts_of_piece));
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const auto corner = [&](std::size_t along, std::size_t iu, std::size_t iv) {
      return corners[(along << axis) | (iu << u) | (iv << v)];
    };
    const std::int32_t parts_u = pieces_[u] * parts_of_piece;
    const std::int32_t parts_v = pieces_[v] * parts_of_piece;
    for (std::int32_t iu = 0; iu <= parts_u; ++iu) {
      for (std::int32_t iv = 0; iv <= parts_v; ++iv) {
        const double fu = static_cast<double>(iu) / parts_u;
        const double fv = static_cast<double>(iv) / parts_v;
        std::array<double, 2> end{};
        for (std::size_t along = 0; along < 2; ++along) {
          end[along] = mix(mix(corner(along, 0, 0), corner(along, 1, 0), fu),
                           mix(corner(along, 0, 1), corner(along, 1, 1), fu), fv);
        }
        if ((end[0] > isovalue_) == (end[1] > isovalue_) || end[0] == isovalue_ || end[1] == isovalue_) continue;
        Vec3 point;
        point[axis] = cell[axis] + edge_parameter(end[0], end[1], isovalue_);
        point[u] = cell[u] + fu;
        point[v] = cell[v] + fv;
        std::array<std::uint64_t, 3> coordinates{};
        coordinates[axis] = place(axis, 0);
        coordinates[u] = place(u, iu);
        coordinates[v] = place(v, iv);
        samples.push_back({line_key(axis, coordinates), point});
      }
    }
  }
}

void SampleLattice::append_arcs(const CellIndex& cell, std::vector<LatticeSample>& samples) const {
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      CellIndex corner = cell;
      corner[static_cast<std::size_t>(axis)] += side;
      const FaceArcs arcs = face_arcs(grid_, isovalue_, topology_.index, corner, axis);
      for (int i = 0; i < arcs.count; ++i) {
        const std::uint64_t face = 3 * grid_.index(corner[0], corner[1], corner[2]) + static_cast<std::uint64_t>(axis);
        const Vec3 point = arc_point(arcs.arcs[static_cast<std::size_t>(i)]);
        samples.push_back({kind_bits(3) | (4 * face + static_cast<std::uint64_t>(i)), point});
      }
    }
  }
}

// A point inside an arc. On a face g is bilinear, and an arc is monotone between its ends. Take the middle of the ends
// along the axis in which they lie farther apart; the other coordinate is the root of a linear function.
Vec3 SampleLattice::arc_point(const FaceArc& arc) const {
  const Vec3 a = crossing_position(grid_, topology_.crossings[arc.crossings[0]]);
  const Vec3 b = crossing_position(grid_, topology_.crossings[arc.crossings[1]]);
  std::size_t u = (arc.axis + 1u) % 3;
  std::size_t v = (arc.axis + 2u) % 3;
  if (std::abs(a[u] - b[u]) < std::abs(a[v] - b[v])) std::swap(u, v);
  Vec3 middle = 0.5 * (a + b);
  const double fu = middle[u] - arc.corner[u];
  const auto value = [&](std::int32_t iu, std::int32_t iv) {
    CellIndex sample = arc.corner;
    sample[u] += iu;
    sample[v] += iv;
    return grid_.at(sample[0], sample[1], sample[2]);
  };
  const double low = mix(value(0, 0), value(1, 0), fu);
  const double high = mix(value(0, 1), value(1, 1), fu);
  if ((low > isovalue_) != (high > isovalue_)) middle[v] = arc.corner[v] + edge_parameter(low, high, isovalue_);
  middle[arc.axis] = arc.corner[arc.axis];
  return middle;
}

void SampleLattice::append_saddles(const CellIndex& cell, std::vector<LatticeSample>& samples) const {
  const auto place = [&](const CellIndex& c) { return grid_.index(c[0], c[1], c[2]); };
  const auto first = std::lower_bound(topology_.saddles.begin(), topology_.saddles.end(), place(cell),
                                      [&](const SurfaceSaddle& s, std::size_t at) { return place(s.cell) < at; });
  for (auto it = first; it != topology_.saddles.end() && it->cell == cell; ++it) {
    const auto i = static_cast<std::uint64_t>(it - first);
    samples.push_back({kind_bits(3) | (4 * (3 * place(cell)) + 2 + i) | std::uint64_t{1} << 59, it->position});
  }
}

}  // namespace deliso

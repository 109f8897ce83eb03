// What a cell's corner signs alone decide: crossed edges, ambiguous faces, arcs on faces.
#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "volume/topology/cell_sweep.h"
#include "volume/topology/exact_signs.h"

namespace deliso {

namespace {

bool is_above(unsigned pattern, int corner) { return (pattern >> corner & 1u) != 0; }

struct PatternTables {
  std::array<bool, 256> simple{};
  std::array<std::uint16_t, 256> crossed{};

  PatternTables() {
    for (unsigned pattern = 0; pattern < 256; ++pattern) {
      for (int edge = 0; edge < kCellEdges; ++edge) {
        const CellEdge e = cell_edge(edge);
        if (is_above(pattern, e.corner) != is_above(pattern, e.corner + (1 << e.axis))) {
          crossed[pattern] = static_cast<std::uint16_t>(crossed[pattern] | 1u << edge);
        }
      }
      simple[pattern] = has_at_most_one_loop(static_cast<std::uint8_t>(pattern));
    }
  }

  static bool has_at_most_one_loop(std::uint8_t pattern) {
    for (int face = 0; face < kCellFaces; ++face) {
      if (is_ambiguous_face(pattern, face)) return false;
    }
    const EdgeSuccessors next = edge_successors(pattern, 0);
    const auto crossings = std::count_if(next.begin(), next.end(), [](int successor) { return successor >= 0; });
    if (crossings == 0) return true;
    const auto first = std::find_if(next.begin(), next.end(), [](int successor) { return successor >= 0; });
    int length = 1;
    for (int edge = *first; edge != first - next.begin(); edge = next[as_index(edge)]) ++length;
    return length == crossings;
  }
};

const PatternTables& tables() {
  static const PatternTables kTables;
  return kTables;
}

}  // namespace

CellEdge cell_edge(int edge) {
  const int axis = edge / 4;
  const int first = edge & 1;
  const int second = edge >> 1 & 1;
  if (axis == 0) return {2 * first + 4 * second, axis};
  if (axis == 1) return {first + 4 * second, axis};
  return {first + 2 * second, axis};
}

int edge_between(int corner_a, int corner_b) {
  const int low = std::min(corner_a, corner_b);
  const int difference = corner_a ^ corner_b;
  if (difference == 1) return (low >> 1 & 1) + 2 * (low >> 2 & 1);
  if (difference == 2) return 4 + (low & 1) + 2 * (low >> 2 & 1);
  return 8 + (low & 3);
}

std::array<int, 4> face_corners(int face) {
  const int axis = face / 2;
  const int side = face % 2;
  const int b = 1 << (axis + 1) % 3;
  const int c = 1 << (axis + 2) % 3;
  const int base = side << axis;
  if (side == 1) return {base, base + b, base + b + c, base + c};
  return {base, base + c, base + b + c, base + b};
}

std::uint8_t sign_pattern(const CellCorners& corners, double isovalue) {
  unsigned pattern = 0;
  for (std::size_t c = 0; c < corners.size(); ++c) pattern |= corners[c] > isovalue ? 1u << c : 0u;
  return static_cast<std::uint8_t>(pattern);
}

bool is_simple(std::uint8_t pattern) { return tables().simple[pattern]; }

std::uint16_t crossed_edges(std::uint8_t pattern) { return tables().crossed[pattern]; }

bool is_ambiguous_face(std::uint8_t pattern, int face) {
  const std::array<int, 4> c = face_corners(face);
  const bool first = is_above(pattern, c[0]);
  return is_above(pattern, c[2]) == first && is_above(pattern, c[1]) != first && is_above(pattern, c[3]) != first;
}

bool above_joined_on_face(const CellCorners& corners, double isovalue, int face) {
  const std::array<int, 4> c = face_corners(face);
  // A positive determinant joins the first corner with the opposite one.
  const int sign = exact_sign([&](const auto& kind) {
    using Number = std::decay_t<decltype(kind)>;
    const auto f = [&](std::size_t i) { return Number::difference(corners[as_index(c[i])], isovalue); };
    return f(0) * f(2) - f(1) * f(3);
  });
  return (sign >= 0) == (corners[as_index(c[0])] > isovalue);
}

int saddle_slope_into_cell(const CellCorners& corners, double isovalue, int face) {
  const std::array<int, 4> c = face_corners(face);
  const int inwards = 1 << face / 2;
  return exact_sign([&](const auto& kind) {
    using Number = std::decay_t<decltype(kind)>;
    // The saddle divides the face's sides in the ratios of these differences: they weight the corners, up to a square.
    const auto step = [&](std::size_t to, std::size_t from) {
      return Number::difference(corners[as_index(c[to])], corners[as_index(c[from])]);
    };
    // There the interpolant equals the isovalue on the face; its value on the opposite face gives the sign.
    const auto across = [&](std::size_t i) { return Number::difference(corners[as_index(c[i] ^ inwards)], isovalue); };
    return across(0) * step(2, 1) * step(2, 3) + across(1) * step(0, 3) * step(2, 3) +
           across(2) * step(0, 3) * step(0, 1) + across(3) * step(2, 1) * step(0, 1);
  });
}

CellFaceArcs arcs_on_cell_face(std::uint8_t pattern, int face, bool above_joined) {
  const std::array<int, 4> corners = face_corners(face);
  const auto above = [&](int i) { return is_above(pattern, corners[as_index(i % 4)]); };
  const auto side = [&](int i) { return edge_between(corners[as_index(i % 4)], corners[as_index((i + 1) % 4)]); };
  CellFaceArcs arcs;
  // Walk around the face: an arc starts where the walk enters the region above the isovalue and ends where it leaves
  // it.
  for (int i = 0; i < 4; ++i) {
    if (above(i) || !above(i + 1)) continue;
    int last = i + 1;
    while (above(last + 1)) ++last;
    arcs.from[as_index(arcs.count)] = side(i);
    arcs.to[as_index(arcs.count)] = side(last);
    ++arcs.count;
  }
  // When the two regions above are joined, each arc ends where the walk left the other one.
  if (arcs.count == 2 && above_joined) std::swap(arcs.to[0], arcs.to[1]);
  return arcs;
}

EdgeSuccessors edge_successors(std::uint8_t pattern, unsigned joined) {
  EdgeSuccessors next;
  next.fill(-1);
  for (int face = 0; face < kCellFaces; ++face) {
    const CellFaceArcs arcs = arcs_on_cell_face(pattern, face, (joined >> face & 1u) != 0);
    for (int i = 0; i < arcs.count; ++i) next[as_index(arcs.from[as_index(i)])] = arcs.to[as_index(i)];
  }
  return next;
}

}  // namespace deliso

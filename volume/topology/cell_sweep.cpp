#include "volume/topology/cell_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "delaunay/base/check.h"
#include "volume/topology/exact_signs.h"

namespace deliso {

namespace {

// The corner values minus the isovalue, in either kind of number.
template <class Number>
Number corner_value(const CellCorners& corners, double isovalue, int corner) {
  return Number::difference(corners[as_index(corner)], isovalue);
}

template <class Number>
Number determinant_value(const CellCorners& corners, double isovalue, const std::array<int, 4>& c) {
  const auto f = [&](int i) { return corner_value<Number>(corners, isovalue, c[as_index(i)]); };
  return f(0) * f(3) - f(1) * f(2);
}

// Twice the middle Bernstein coefficient of D: D(w) = D0 (1-w)^2 + M (1-w) w + D2 w^2.
template <class Number>
Number mixed_determinant(const CellCorners& corners, double isovalue) {
  const auto f = [&](int i) { return corner_value<Number>(corners, isovalue, i); };
  return (f(0) * f(7) + f(4) * f(3)) - (f(1) * f(6) + f(5) * f(2));
}

constexpr std::array<int, 4> kBottomCorners{0, 1, 2, 3};
constexpr std::array<int, 4> kTopCorners{4, 5, 6, 7};

int determinant_sign(const CellCorners& corners, double isovalue, const std::array<int, 4>& c) {
  return exact_sign(
      [&](const auto& kind) { return determinant_value<std::decay_t<decltype(kind)>>(corners, isovalue, c); });
}

}  // namespace

// --- The sweep's predicates -----------------------------------------------------------------------------------------

int CellSweep::determinant(int c00, int c10, int c01, int c11) const {
  return determinant_sign(corners_, isovalue_, {c00, c10, c01, c11});
}

// The sign of M^2 - 4 D0 D2.
int CellSweep::discriminant() const {
  return exact_sign([&](const auto& kind) {
    using Number = std::decay_t<decltype(kind)>;
    const Number middle = mixed_determinant<Number>(corners_, isovalue_);
    const Number bottom = determinant_value<Number>(corners_, isovalue_, kBottomCorners);
    const Number top = determinant_value<Number>(corners_, isovalue_, kTopCorners);
    return middle * middle - Number(4) * bottom * top;
  });
}

// The sign of D'(w) at an end of an interval. With w = t / (s + t) it is that of s (M - 2 D0) + t (2 D2 - M).
int CellSweep::det_slope(int end) const {
  return exact_sign([&](const auto& kind) {
    using Number = std::decay_t<decltype(kind)>;
    const Number middle = mixed_determinant<Number>(corners_, isovalue_);
    const auto slope_at_bottom = [&] {
      return middle - Number(2) * determinant_value<Number>(corners_, isovalue_, kBottomCorners);
    };
    const auto slope_at_top = [&] {
      return Number(2) * determinant_value<Number>(corners_, isovalue_, kTopCorners) - middle;
    };
    if (end == kBottom) return slope_at_bottom();
    if (end == kTop) return slope_at_top();
    // At the root of a corner that goes from a to b: s : t = |b| : |a|, and a, b have opposite signs.
    const Number a = corner_value<Number>(corners_, isovalue_, end);
    const Number b = corner_value<Number>(corners_, isovalue_, end + 4);
    const Number slope = slope_at_top() * a - slope_at_bottom() * b;
    return (pattern_ >> end & 1) != 0 ? slope : -slope;
  });
}

// The sign of D at an end of an ambiguous interval. Zero, a saddle on the face, counts as positive (so does
// above_joined_on_face).
int CellSweep::det_sign(int end) const {
  if (end == kBottom) return determinant(0, 1, 2, 3) >= 0 ? 1 : -1;
  if (end == kTop) return determinant(4, 5, 6, 7) >= 0 ? 1 : -1;
  return end == 0 || end == 3 ? -1 : 1;
}

// Whether slice corner a < b changes sign before slice corner b. If both change at the same w, the higher one goes
// first. For a regular surface any order gives the same answer; on a face with a saddle at the isovalue this order
// agrees with above_joined_on_face.
bool CellSweep::flips_before(int a, int b) const {
  const int det = determinant(a, b, a + 4, b + 4);
  const bool same_direction = (pattern_ >> a & 1) == (pattern_ >> b & 1);
  return same_direction ? det > 0 : det < 0;
}

// --- The sweep ------------------------------------------------------------------------------------------------------

CellSweep::CellSweep(const CellCorners& corners, double isovalue)
    : corners_(corners), isovalue_(isovalue), pattern_(sign_pattern(corners, isovalue)) {
  piece_of_edge_.fill(-1);
  scale_values();
  check_faces();
  order_flips();
  start();
  for (int interval = 0; interval <= flip_count_; ++interval) {
    cross_interval(interval);
    if (interval < flip_count_) flip(flips_[as_index(interval)]);
  }
  finish();
  renumber();
}

void CellSweep::check_faces() {
  for (int face = 0; face < kCellFaces; ++face) {
    const std::array<int, 4> c = face_corners(face);
    if (is_ambiguous_face(pattern_, face) && determinant(c[0], c[1], c[3], c[2]) == 0) saddle_faces_ |= 1u << face;
  }
}

void CellSweep::order_flips() {
  for (int corner = 0; corner < 4; ++corner) {
    if ((pattern_ >> corner & 1) == (pattern_ >> (corner + 4) & 1)) continue;
    int place = flip_count_++;
    for (; place > 0 && !flips_before(flips_[as_index(place - 1)], corner); --place)
      flips_[as_index(place)] = flips_[as_index(place - 1)];
    flips_[as_index(place)] = corner;
  }
}

void CellSweep::start() {
  slice_.above = pattern_ & 0xFu;
  std::array<bool, 4> crossed{};
  for (int side = 0; side < 4; ++side) {
    const std::array<int, 2> ends = side < 2 ? std::array{2 * side, 2 * side + 1} : std::array{side - 2, side};
    crossed[as_index(side)] = (slice_.above >> ends[0] & 1u) != (slice_.above >> ends[1] & 1u);
  }
  if (slice_.is_ambiguous()) {
    // The bottom and the top side always belong to different arcs; D < 0 cuts off corners 00 and 11.
    const int bottom = new_piece();
    const int top = new_piece();
    const bool cuts_00 = det_sign(kBottom) < 0;
    slice_.piece_of_side = {bottom, top, cuts_00 ? bottom : top, cuts_00 ? top : bottom};
  } else if (slice_.above != 0 && slice_.above != 0xFu) {
    const int piece = new_piece();
    for (int side = 0; side < 4; ++side) {
      if (crossed[as_index(side)]) slice_.piece_of_side[as_index(side)] = piece;
    }
  }
  record_edges(0);
}

// From one flip (or the bottom) to the next (or the top). Only saddles can occur in between, and only in an ambiguous
// slice.
void CellSweep::cross_interval(int interval) {
  if (slice_.is_ambiguous()) {
    const int start = interval == 0 ? kBottom : flips_[as_index(interval - 1)];
    const int end = interval == flip_count_ ? kTop : flips_[as_index(interval)];
    const int sign = det_sign(start);
    slice_.det_sign = sign;
    if (sign != det_sign(end)) {
      add_saddles(1, start, end);
    } else if (det_slope(start) * sign < 0 && det_slope(end) * sign > 0) {
      // D has an extremum strictly inside: D has two roots there, one double root (a singular point), or none.
      const int two_roots = discriminant();
      if (two_roots > 0) add_saddles(2, start, end);
      if (two_roots == 0) singular_inside_ = true;
    }
  }
  history_[as_index(interval)] = slice_;
}

// Two arcs meet in a saddle and separate again: the graph gets one node, and two edges leave it.
void CellSweep::add_saddles(int count, int start, int end) {
  const int piece = merge(slice_.piece_of_side[0], slice_.piece_of_side[1]);
  slice_.piece_of_side.fill(piece);
  euler_[as_index(piece)] -= count;

  // The roots of D as doubles: this only measures.
  const auto det = [&](double w) {
    const std::array<double, 4> f = slice_values(w);
    return f[0] * f[3] - f[1] * f[2];
  };
  const double c = det(0);
  const double a = 2 * (c + det(1) - 2 * det(0.5));
  const double b = det(1) - c - a;
  const double q = -0.5 * (b + std::copysign(std::sqrt(std::max(0.0, b * b - 4 * a * c)), b));
  constexpr double kNowhere = std::numeric_limits<double>::infinity();  // a linear D has one root only
  std::array<double, 2> roots{a != 0 ? q / a : kNowhere, q != 0 ? c / q : position(start)};
  const double low = position(start);
  const double high = position(end);
  const auto outside = [&](double w) { return std::max({0.0, low - w, w - high}); };
  if (count == 1 && outside(roots[1]) < outside(roots[0])) std::swap(roots[0], roots[1]);
  if (count == 2 && roots[1] < roots[0]) std::swap(roots[0], roots[1]);
  for (int i = 0; i < count && as_index(saddle_count_) < saddles_.size(); ++i) {
    // No std::clamp: rounding may put the end before the start.
    const double w = std::min(std::max(roots[as_index(i)], low), high);
    saddles_[as_index(saddle_count_++)] = {slice_saddle(w), piece};
  }
}

// A slice corner changes sign: an arc between the two sides that meet there appears or vanishes, or an arc's end moves
// from one side to the other.
void CellSweep::flip(int corner) {
  int& across = slice_.piece_of_side[as_index(corner / 2)];     // on the bottom or top side
  int& along = slice_.piece_of_side[as_index(2 + corner % 2)];  // on the left or right side
  int piece = 0;
  if (across < 0 && along < 0) {
    piece = new_piece();
    across = along = piece;
  } else if (across >= 0 && along >= 0) {
    DELISO_CHECK(across == along, "the arc that ends at a corner joins the corner's two sides");
    piece = across;
    ++euler_[as_index(piece)];
    across = along = -1;
  } else {
    std::swap(across, along);
    piece = std::max(across, along);
  }
  slice_.above ^= 1u << corner;
  piece_of_edge_[as_index(8 + corner)] = piece;
}

// The arcs on the top face are the last nodes of the graph.
void CellSweep::finish() {
  record_edges(2);
  if (slice_.is_ambiguous()) {
    ++euler_[as_index(slice_.piece_of_side[0])];
    ++euler_[as_index(slice_.piece_of_side[1])];
  } else if (slice_.above != 0 && slice_.above != 0xFu) {
    ++euler_[as_index(*std::max_element(slice_.piece_of_side.begin(), slice_.piece_of_side.end()))];
  }
}

int CellSweep::new_piece() {
  DELISO_CHECK(as_index(pieces_) < euler_.size(), "a cell's sweep starts at most eight arcs");
  return pieces_++;
}

// Merges pieces a and b in all tables.
int CellSweep::merge(int a, int b) {
  if (a == b) return a;
  const auto rename = [&](int& piece) {
    if (piece == b) piece = a;
  };
  std::for_each(piece_of_edge_.begin(), piece_of_edge_.end(), rename);
  std::for_each(slice_.piece_of_side.begin(), slice_.piece_of_side.end(), rename);
  for (Slice& slice : history_) std::for_each(slice.piece_of_side.begin(), slice.piece_of_side.end(), rename);
  for (int i = 0; i < saddle_count_; ++i) {
    if (saddles_[as_index(i)].piece == b) saddles_[as_index(i)].piece = a;
  }
  euler_[as_index(a)] += euler_[as_index(b)];
  euler_[as_index(b)] = 0;
  return a;
}

// The current slice's sides are edges of the cell's bottom (offset 0) or top (offset 2) face.
void CellSweep::record_edges(int first_edge_offset) {
  for (int side = 0; side < 4; ++side) {
    piece_of_edge_[as_index((side < 2 ? side : side + 2) + first_edge_offset)] = slice_.piece_of_side[as_index(side)];
  }
}

// Numbers the pieces that remain after merging 0, 1, ... in the order of their first edge.
void CellSweep::renumber() {
  std::array<int, 8> number;
  number.fill(-1);
  int count = 0;
  std::array<int, 8> euler{};
  for (int& piece : piece_of_edge_) {
    if (piece < 0) continue;
    if (number[as_index(piece)] < 0) {
      euler[as_index(count)] = euler_[as_index(piece)];
      number[as_index(piece)] = count++;
    }
    piece = number[as_index(piece)];
  }
  for (Slice& slice : history_) {
    for (int& piece : slice.piece_of_side) {
      if (piece >= 0) piece = number[as_index(piece)];
    }
  }
  for (int i = 0; i < saddle_count_; ++i) saddles_[as_index(i)].piece = number[as_index(saddles_[as_index(i)].piece)];
  euler_ = euler;
  pieces_ = count;
}

}  // namespace deliso

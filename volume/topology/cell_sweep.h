// The isosurface inside one voxel cell, up to homeomorphism: which of the cell's edge crossings lie on a common piece,
// and each piece's Euler characteristic. Every decision is the exact sign of a polynomial in the samples and the
// isovalue (all finite doubles), so the answer does not depend on rounding.
//
// The idea. Fix w: the slice g(., ., w) is bilinear with corner values f00, f10, f01, f11 (minus the isovalue), each
// linear in w. Its zero set is 0, 1 or 2 arcs, each named by the sides it joins. As w grows the arcs change only in two
// ways. A corner changes sign, at the root of a linear function. Or, while both diagonals have equal signs, D(w) = f00
// f11 - f10 f01, a quadratic, changes sign: this is a saddle, where two arcs meet and separate the other way.
// Two facts keep the predicates few. At a root of f00 or f11 in such an ambiguous slice D = -f10 f01 < 0, and at a root
// of f10 or f01 D > 0: so between two corner flips the signs of D are known at no cost. Only these are computed: the
// order of two corner roots (degree 2, also the asymptotic decider of the faces); D at the cell's bottom and top
// (degree 2); and, when D has one sign at both ends of an ambiguous interval, whether it reaches zero in between, from
// its discriminant (degree 4, Cayley's hyperdeterminant) and its slope at the two ends (degree 2 or 3).
//
// Source: asymptotic decider, Nielson and Hamann 1991; interior ambiguity, Chernyaev 1995 and Nielson 2003; the sweep
// and its predicates are ours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "delaunay/base/vec3.h"
#include "volume/scalar_grid.h"

namespace deliso {

// An int as a place in an array.
inline std::size_t as_index(int index) { return static_cast<std::size_t>(index); }

// Corner i + 2j + 4k of a cell as in CellCorners. Edge 4 axis + n starts at the corner whose offsets along the two
// other axes are the bits of n, lower axis first. Face 2 axis + side lies at offset `side` along axis.
inline constexpr int kCellEdges = 12;
inline constexpr int kCellFaces = 6;
inline constexpr int kMaxCellPieces = 4;

// The lower corner of a cell's edge and its axis.
struct CellEdge {
  int corner = 0;
  int axis = 0;
};
CellEdge cell_edge(int edge);
// The edge between two corners that differ in one offset.
int edge_between(int corner_a, int corner_b);
// The four corners of a face, in counterclockwise order seen from outside the cell.
std::array<int, 4> face_corners(int face);

// Bit c is set when corner c lies above the isovalue.
std::uint8_t sign_pattern(const CellCorners& corners, double isovalue);
// True when the signs alone show that the surface in the cell is empty or one disk: no face is ambiguous and the
// crossings form at most one loop on the cell's boundary.
bool is_simple(std::uint8_t pattern);
// One bit per edge of the cell that has a crossing.
std::uint16_t crossed_edges(std::uint8_t pattern);
// One bit per face of the cell whose corners do not all lie on one side.
inline unsigned crossed_faces(std::uint8_t pattern) {
  constexpr std::array<unsigned, kCellFaces> kCorners = {0x55, 0xAA, 0x33, 0xCC, 0x0F, 0xF0};
  unsigned faces = 0;
  for (std::size_t face = 0; face < kCellFaces; ++face) {
    const unsigned above = pattern & kCorners[face];
    faces |= (static_cast<unsigned>(above != 0) & static_cast<unsigned>(above != kCorners[face])) << face;
  }
  return faces;
}
// True when the face's corner signs alternate.
bool is_ambiguous_face(std::uint8_t pattern, int face);
// True when the corners above the isovalue are joined across an ambiguous face. A saddle exactly at the isovalue is
// decided the same way by both cells of the face.
bool above_joined_on_face(const CellCorners& corners, double isovalue, int face);

// For a face with a saddle exactly at the isovalue: the sign of the interpolant's derivative there, into the cell.
int saddle_slope_into_cell(const CellCorners& corners, double isovalue, int face);

// The arcs on one face, from a crossed edge to a crossed edge, each with the region above the isovalue on its right
// when seen from outside the cell. `above_joined` matters for an ambiguous face only.
struct CellFaceArcs {
  int count = 0;
  std::array<int, 2> from{};
  std::array<int, 2> to{};
};
CellFaceArcs arcs_on_cell_face(std::uint8_t pattern, int face, bool above_joined);

// The arcs in which the surface meets the cell's faces, as successors: on its boundary a piece of the surface runs from
// crossing e to crossing next[e], counterclockwise around the piece seen from the side of lower values. -1 where edge e
// has no crossing. `joined` has bit f set when above_joined_on_face(f); it matters for ambiguous faces only.
using EdgeSuccessors = std::array<int, kCellEdges>;
EdgeSuccessors edge_successors(std::uint8_t pattern, unsigned joined);

class CellSweep {
 public:
  // Precondition: the corners are finite and none equals the isovalue.
  CellSweep(const CellCorners& corners, double isovalue);

  // The number of connected pieces; each reaches at least one edge crossing.
  [[nodiscard]] int pieces() const { return pieces_; }
  // The piece of the crossing on an edge, or -1 when the edge has none.
  [[nodiscard]] int piece_of_edge(int edge) const { return piece_of_edge_[static_cast<std::size_t>(edge)]; }
  [[nodiscard]] int euler_characteristic(int piece) const { return euler_[static_cast<std::size_t>(piece)]; }
  // True when the surface has a singular point inside the cell: the isovalue is that of a saddle of the interpolant.
  // The pieces are then those of a nearby isovalue on one side.
  [[nodiscard]] bool singular_inside() const { return singular_inside_; }
  // Bit f is set when face f has a saddle exactly at the isovalue. The surface is regular there when it passes through
  // the face from cell to cell (saddle_slope_into_cell has opposite signs in the two cells). Otherwise the pieces are
  // those of a nearby field.
  [[nodiscard]] unsigned saddle_faces() const { return saddle_faces_; }
  // The saddles of the sweep: points of the surface (rounded), in cell parameters, with the piece they lie on.
  struct Saddle {
    Vec3 uvw;
    int piece = 0;
  };
  [[nodiscard]] int saddle_count() const { return saddle_count_; }
  [[nodiscard]] const Saddle& saddle(int i) const { return saddles_[static_cast<std::size_t>(i)]; }
  // The piece that holds a (rounded) point of the surface: the arc nearest to it in its slice. If there are two arcs,
  // the asymptotes of the slice decide. -1 when the slice at its w holds no arc.
  [[nodiscard]] int piece_at(const Vec3& uvw) const;

 private:
  // Sides of a slice: 0 bottom (v = 0), 1 top, 2 left (u = 0), 3 right. Bits of `above` are the slice's corners u + 2v.
  struct Slice {
    unsigned above = 0;
    std::array<int, 4> piece_of_side{-1, -1, -1, -1};
    int det_sign = 0;  // of D at the interval's start, when the slice is ambiguous
    // Diagonally opposite corners lie on one side, the other two on the other side.
    [[nodiscard]] bool is_ambiguous() const { return above == 0b1001 || above == 0b0110; }
  };
  // The two ends of the sweep, in addition to the slice corners 0 to 3 at whose roots an interval may end.
  static constexpr int kBottom = 4;
  static constexpr int kTop = 5;

  [[nodiscard]] int determinant(int c00, int c10, int c01, int c11) const;
  [[nodiscard]] int discriminant() const;
  [[nodiscard]] int det_slope(int end) const;
  [[nodiscard]] int det_sign(int end) const;
  [[nodiscard]] bool flips_before(int a, int b) const;
  // The corner minus the isovalue, rounded, times a power of two that keeps products of two in range.
  [[nodiscard]] double value(int corner) const { return values_[static_cast<std::size_t>(corner)]; }
  [[nodiscard]] double position(int end) const;
  [[nodiscard]] std::array<double, 4> slice_values(double w) const;
  [[nodiscard]] Vec3 slice_saddle(double w) const;
  void scale_values();
  void order_flips();
  void check_faces();
  void start();
  void cross_interval(int interval);
  void add_saddles(int count, int start, int end);
  void flip(int corner);
  void finish();
  int new_piece();
  int merge(int a, int b);
  void record_edges(int first_edge_offset);
  void renumber();

  CellCorners corners_;
  double isovalue_;
  std::array<double, 8> values_{};
  std::uint8_t pattern_ = 0;
  int flip_count_ = 0;
  std::array<int, 4> flips_{};      // slice corners in the order in which they change sign
  Slice slice_;                     // the current one
  std::array<Slice, 5> history_{};  // the slices between the flips
  int pieces_ = 0;
  std::array<int, kCellEdges> piece_of_edge_{};
  std::array<int, 8> euler_{};
  int saddle_count_ = 0;
  std::array<Saddle, 4> saddles_{};
  bool singular_inside_ = false;
  unsigned saddle_faces_ = 0;
};

}  // namespace deliso

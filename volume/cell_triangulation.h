// The triangles of marching cubes in one cell.
//
// They lie in the cell, which is convex, and meet its boundary in nothing but the chords of the loops (cell_loops.h),
// which both cells of a face share: a chord between two crossings of one face that are not neighbours on a loop is
// forbidden, and inner points lie strictly inside. So triangles of different cells have only those chords and their
// ends in common, and the whole mesh is free of crossings when the triangles of each cell are.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "volume/cell_loops.h"
#include "volume/loop_band.h"
#include "volume/marching_cubes.h"

namespace deliso {

// Triangulates one cell after the other.
class CellTriangulation {
 public:
  CellTriangulation(const ScalarGrid& grid, double isovalue, const CrossingIndex& index,
                    std::span<const EdgeCrossing> crossings)
      : grid_(grid), isovalue_(isovalue), index_(index), crossings_(crossings), vertex_count_(crossings.size()) {}

  const MarchingCubesPatch& triangulate(const CellIndex& cell, std::uint8_t pattern);

 private:
  // A piece of the surface: a disk that spans a loop, or a tunnel between two.
  struct Piece {
    CellLoop loop;
    CellLoop other;  // empty for a disk
  };
  // A tunnel as a band between its loops, or between copies of them drawn into the cell by these parts of the way to
  // its centre; 0 stands for the loop itself.
  struct Band {
    std::array<double, 2> depths{};
    LoopBand band;
  };

  void add_crossings(std::uint8_t pattern);
  void find_pieces(std::uint8_t pattern);
  void draw(const Band* band);
  void mend();
  void add_disk(const CellLoop& loop);
  void add_ring(CellLoop outer, CellLoop inner);
  void add_band(const CellLoop& first, const CellLoop& second, const Band& band);
  [[nodiscard]] std::vector<Band> bands(const Piece& tunnel) const;
  std::uint32_t add_inner_point(const Vec3& near);
  std::uint32_t add_point_at(const Vec3& at);

  [[nodiscard]] Vec3 base() const;
  [[nodiscard]] Vec3 drawn_in(int edge, double depth) const;
  [[nodiscard]] std::uint32_t vertex(int edge) const { return places_[static_cast<std::size_t>(edge)]; }
  [[nodiscard]] const Vec3& point(int edge) const { return patch_.points[vertex(edge)]; }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { patch_.triangles.push_back({a, b, c}); }

  const ScalarGrid& grid_;
  double isovalue_;
  const CrossingIndex& index_;
  std::span<const EdgeCrossing> crossings_;
  std::size_t vertex_count_;  // crossings, and the inner points of the cells so far

  MarchingCubesPatch patch_;                        // the cell at hand
  CellCorners corners_{};                           // its samples, and
  std::array<std::uint32_t, kCellEdges> places_{};  // of its crossings in patch_.vertices, by edge
  std::vector<Piece> pieces_;
};

}  // namespace deliso

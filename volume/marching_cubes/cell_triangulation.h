// The triangles of marching cubes in one cell.
//
// The whole mesh is embedded when the triangles of each cell are, because triangles of different cells meet only in
// what they share. The triangles of a cell lie in the cell, which is convex. They meet its boundary only in the chords
// of the loops, which are the same for both cells of a face and disjoint on it (cell_loops.h): a segment between two
// crossings lies in a face only if both crossings do, and such a segment is forbidden unless it is one of the chords.
// Inner points lie strictly inside.
//
// Within a cell, a disk of least chords has never been seen to cross itself or another disk (in more than 10^7 random
// cells); triangles around a tunnel have. So cells that are not simple are tested exactly, if exact tests are given. A
// tunnel is drawn in another way (cell_tunnel.cpp) when its triangles meet or its inner points are off the surface.
// Both are decided in index space; such a redrawn tunnel also withstands small displacements. A spacing that is no
// power of two rounds the points again: triangles closer than a rounding may then meet, as may edges whose crossings
// round to a sample.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "volume/marching_cubes/cell_loops.h"
#include "volume/marching_cubes/exact_tests.h"
#include "volume/marching_cubes/loop_band.h"
#include "volume/topology/crossing_index.h"

namespace deliso {

struct MarchingCubesPatch {
  CellIndex cell{};
  // The vertices of the patch: their numbers in the whole mesh, and their positions in index space. The cell's
  // grid-edge crossings come first, then its inner points.
  std::vector<std::uint32_t> vertices;
  std::vector<Vec3> points;
  std::size_t crossing_count = 0;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices into `vertices`
};

// Triangulates one cell after the other.
class CellTriangulation {
 public:
  CellTriangulation(const ScalarGrid& grid, double isovalue, const CrossingIndex& index,
                    std::span<const EdgeCrossing> crossings, const ExactTests* tests)
      : grid_(grid),
        isovalue_(isovalue),
        index_(index),
        crossings_(crossings),
        tests_(tests),
        vertex_count_(crossings.size()) {}

  const MarchingCubesPatch& triangulate(const CellIndex& cell, std::uint8_t pattern);

 private:
  // A piece of the surface: a disk that spans a loop, or a tunnel between two.
  struct Piece {
    CellLoop loop;
    CellLoop other;  // empty for a disk
    [[nodiscard]] bool is_disk() const { return other.size == 0; }
  };
  // The corners of one end of a band: a loop, or a ring of its points moved into the cell.
  struct Rim {
    std::array<Vec3, kCellEdges> points{};
    bool is_loop = true;
  };
  struct SurfacePoint {
    Vec3 at;
    bool is_near = false;  // whether it lies near the surface
  };

  using Triangle = std::array<std::uint32_t, 3>;

  // Whether no two triangles have points in common beyond their common vertices, and none is degenerate. Precondition:
  // exact tests are given.
  [[nodiscard]] bool is_embedded(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) const;

  void add_crossings(std::uint8_t pattern);
  void find_pieces(std::uint8_t pattern);
  // Draws all pieces anew. Returns whether no triangles meet (if exact tests are given) and all inner points lie on the
  // surface.
  bool draw(const std::function<void(const Piece&)>& add_tunnel);
  void add_disk(const CellLoop& loop);
  void add_ring(CellLoop outer, CellLoop inner);

  // cell_tunnel.cpp: the other ways to draw a tunnel.
  bool draw_otherwise();
  bool draw_bands(const Piece& tunnel, const std::array<double, 2>& depths);
  bool draw_part_of_hull(double depth);
  [[nodiscard]] bool stays_embedded() const;
  std::array<std::uint32_t, kCellEdges> add_rim(const CellLoop& loop, const Rim& rim);
  void add_band(const Piece& tunnel, const std::array<Rim, 2>& rims, const LoopBand& band);
  bool add_part_of_hull(const Piece& tunnel, double depth);
  [[nodiscard]] std::optional<Rim> rim(const CellLoop& loop, double depth) const;
  [[nodiscard]] Vec3 drawn_in(const Vec3& at, double depth) const;

  [[nodiscard]] SurfacePoint onto_surface(const Vec3& near) const;
  [[nodiscard]] SurfacePoint apex_of(const CellLoop& loop) const;
  std::uint32_t add_inner_point(const SurfacePoint& p);
  std::uint32_t add_point(const Vec3& at);

  [[nodiscard]] Vec3 base() const;
  [[nodiscard]] std::uint32_t vertex(int edge) const { return places_[static_cast<std::size_t>(edge)]; }
  [[nodiscard]] const Vec3& point(int edge) const { return patch_.points[vertex(edge)]; }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { patch_.triangles.push_back({a, b, c}); }

  const ScalarGrid& grid_;
  double isovalue_;
  const CrossingIndex& index_;
  std::span<const EdgeCrossing> crossings_;
  const ExactTests* tests_;
  std::size_t vertex_count_;  // crossings, and the inner points of the cells so far

  // State of the current cell:
  MarchingCubesPatch patch_;
  std::array<std::uint32_t, kCellEdges> places_{};  // of its crossings in patch_.vertices, by edge
  CellCorners corners_{};                           // its samples and its pieces, when it is not simple
  std::vector<Piece> pieces_;
  bool is_on_surface_ = true;  // all inner points of the latest drawing
};

}  // namespace deliso

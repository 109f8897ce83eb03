// The triangles of marching cubes in one cell.
//
// Triangles of different cells have nothing in common but what they share, so the whole mesh is embedded when the
// triangles of each cell are. They lie in the cell, which is convex, and meet its boundary in the chords of the loops
// alone, which are the same for both cells of a face and disjoint on it (cell_loops.h): a segment between two crossings
// lies in a face only if both do, and such a segment is forbidden unless it is one of the chords; inner points lie
// strictly inside.
//
// Within a cell a disk of least chords has not been seen to cross itself or another disk (in more than 10^7 random
// cells); triangles around a tunnel do. So cells that are not simple are tested exactly, where there are tests, and
// tunnels whose triangles meet, or whose inner points are off the surface, are drawn in another way (cell_tunnel.cpp).
// Both is decided in index space; what is drawn otherwise also bears small displacements. A spacing that is no power of
// two rounds the points anew: what comes within a rounding may meet again, as may edges whose crossings round to a
// sample.
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
  // The vertices of the patch: what the whole mesh calls them, and where they are, in index space. First the cell's
  // grid-edge crossings, then its inner points.
  std::vector<std::uint32_t> vertices;
  std::vector<Vec3> points;
  std::size_t crossing_count = 0;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of places in `vertices`
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
  // The corners of one end of a band: a loop, or a ring drawn from it into the cell.
  struct Rim {
    std::array<Vec3, kCellEdges> points{};
    bool is_loop = true;
  };
  struct SurfacePoint {
    Vec3 at;
    bool is_near = false;  // to the surface
  };

  using Triangle = std::array<std::uint32_t, 3>;

  // Whether no two triangles have points in common beyond their common vertices, and none is degenerate. Precondition:
  // there are tests.
  [[nodiscard]] bool is_embedded(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) const;

  void add_crossings(std::uint8_t pattern);
  void find_pieces(std::uint8_t pattern);
  // Draws all pieces anew; returns whether the triangles have no contacts and inner points lie on the surface, where
  // there are tests.
  bool draw(const std::function<void(const Piece&)>& add_tunnel);
  void add_disk(const CellLoop& loop);
  void add_ring(CellLoop outer, CellLoop inner);

  // cell_tunnel.cpp: what else can be drawn for a tunnel.
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

  // Of the cell at hand:
  MarchingCubesPatch patch_;
  std::array<std::uint32_t, kCellEdges> places_{};  // of its crossings in patch_.vertices, by edge
  CellCorners corners_{};                           // its samples and its pieces, when it is not simple
  std::vector<Piece> pieces_;
  bool is_on_surface_ = true;  // all inner points of the latest drawing
};

}  // namespace deliso

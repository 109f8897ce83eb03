// Rays against the isosurface.
//
// Queries work in *mesh space*: lengths in units of the smallest spacing, the first sample at (0, 0, 0); sample (i, j,
// k) sits at (i, j, k) * step(), where step() = spacing / smallest spacing. Beyond the box the field is extended by its
// value at the nearest point of the box, so that every line has values along its whole length and the isosurface has no
// rim: it goes on outward from the box as straight walls.
//
// A line is x(t) = origin + t * direction; t is the caller's own parameter, direction need not have unit length.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/counters.h"
#include "delaunay/base/lanes.h"
#include "delaunay/base/vec3.h"
#include "raycast/cell_walk.h"
#include "raycast/line.h"
#include "raycast/search_options.h"
#include "volume/scalar_grid.h"

namespace deliso {

class ActiveCells;
class EmptyBricks;
class MinMaxKdTree;
struct LineSegment;

class Isosurface {
 public:
  // Keeps a reference to the grid and builds what options.traversal needs. Precondition: no sample equals `isovalue`.
  // Throws InputError when options.leaf_cells is below 1.
  Isosurface(const ScalarGrid& grid, double isovalue, const SearchOptions& options);
  // The same with another spacing than the grid's.
  // The same for any number of threads.
  Isosurface(const ScalarGrid& grid, double isovalue, const SearchOptions& options, const Vec3& spacing,
             int threads = 1);
  ~Isosurface();
  Isosurface(const Isosurface&) = delete;
  Isosurface& operator=(const Isosurface&) = delete;

  [[nodiscard]] const ScalarGrid& grid() const { return grid_; }
  [[nodiscard]] double isovalue() const { return isovalue_; }
  [[nodiscard]] const Vec3& step() const { return step_; }
  // The volume's box in mesh space; its low corner is the origin.
  [[nodiscard]] const Box3& box() const { return box_; }

  // Field minus isovalue at p, extended beyond the box.
  [[nodiscard]] double value(const Vec3& p) const;
  // Which side: value >= 0. The one tie rule of the project: exactly zero counts as above.
  [[nodiscard]] bool is_above(const Vec3& p) const { return is_above(p, place_of(p)); }

  // Where a point is, for quick answers: its extended cell and the clearance of its brick (see empty_bricks.h).
  struct Place {
    Cell cell{};
    int clearance = 0;  // 0: nothing is known
  };
  [[nodiscard]] Place place_of(const Vec3& p) const;
  [[nodiscard]] bool is_above(const Vec3& p, const Place& place) const {
    return place.clearance != 0 ? place.clearance > 0 : value(p) >= 0;
  }
  // Tells the processor that the field around a place will be read soon.
  void prefetch(const Place& place) const;
  // True only when the box of cells that two places span (that the segment between the two points passes) has no active
  // cell, so that no hit lies there. False tells nothing. Fast; always false but for traversal kCellWalk with pruning.
  [[nodiscard]] bool is_clear_box(const Place& a, const Place& b) const;
  [[nodiscard]] bool is_clear(const Vec3& a, const Place& place_a, const Vec3& b, const Place& place_b) const;

  // Where the surface lies: the box or, where the volume has walls, what these hold.
  [[nodiscard]] Box3 surface_box() const;
  // Where the volume has walls: a point next to one of them, on it. Points of the surface there are all but on it, and
  // would be all but in one plane, or in one place at its edges; put onto it they are so exactly.
  [[nodiscard]] Vec3 settled(const Vec3& p) const;

  // Gradient of the field at p (clamped to the box), with respect to mesh-space coordinates.
  [[nodiscard]] Vec3 gradient(const Vec3& p) const;
  // Whether two points at this distance from p, one along the gradient there and one against it, lie on different sides
  // of the isosurface. Looks at the cell of p alone, so false tells nothing. Fast.
  [[nodiscard]] bool passes_within(const Vec3& p, double distance) const;

  // Intersect of the paper (Dey and Levine, Figure 12): all hits with t0 <= t <= t1, ascending, appended to `hits`
  // (which is cleared first). Falling and rising hits alternate: tangential touches are left out. Their number is odd
  // exactly when is_above(line.at(t0)) and is_above(line.at(t1)) differ, whatever the rounding. t0 and t1 may be
  // infinite (the line is then cut where its clamped image no longer moves). Precondition: the line is finite, its
  // direction may be zero.
  void all_hits(const Line& line, double t0, double t1, std::vector<Hit>& hits, SearchCounters& counters) const;

  // The falling hit nearest to t = 0 with |t| <= reach, searched outward from t = 0 by growing steps (section 4.2), or
  // over the whole line when options.incremental is off. The caller gives the outward normal (towards lower values) as
  // direction, so hits on sheets that face the other way are passed over.
  [[nodiscard]] std::optional<double> nearest_falling_hit(const Line& line, double reach,
                                                          SearchCounters& counters) const;
  // The same for the lines in those lanes that are asked for; a hit that is not found is NaN.
  void nearest_falling_hits(const LineLanes& lines, const std::array<bool, kLanes>& asked, double reach, Lanes& hits,
                            SearchCounters& counters) const;

 private:
  [[nodiscard]] bool is_clear(const Vec3& a, const Place& place_a, const Vec3& b, const Place& place_b,
                              int halvings) const;
  [[nodiscard]] CellCorners relative_corners(const Vec3& p, Vec3& uvw) const;
  [[nodiscard]] std::pair<Cell, Cell> without_clear_ends(const LineSegment& segment) const;
  template <class Solve>
  void visit_voxels(const LineSegment& segment, Solve&& solve) const;
  void hits_in_start_cells(const LineLanes& lines, double reach, bool first_alone, Lanes& hits) const;
  [[nodiscard]] std::optional<double> nearest_outward(const Line& line, double reach, std::uint64_t& solves) const;
  [[nodiscard]] std::optional<double> nearest_on_line(const Line& line, double reach, std::uint64_t& solves) const;

  const ScalarGrid& grid_;
  double isovalue_;
  SearchOptions options_;
  Vec3 step_;
  Box3 box_;
  Vec3 inverse_step_;
  std::unique_ptr<MinMaxKdTree> tree_;   // traversal kKdTree, when pruning
  std::unique_ptr<ActiveCells> active_;  // traversal kCellWalk, when pruning
  std::unique_ptr<EmptyBricks> bricks_;  // the same
};

}  // namespace deliso

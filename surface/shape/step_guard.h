// Whether a step of the shape stage keeps what the mesh has been proven to be: each replaces a disk by a disk, no
// triangle meets another beyond what they share, and each new one faces lower values and lies near the isosurface.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "raycast/isosurface.h"
#include "surface/search/point_grid.h"
#include "surface/shape/component_size.h"
#include "surface/shape/patch.h"
#include "surface/shape/triangle_heights.h"

namespace deliso {

class StepGuard {
 public:
  // `crossings`: points of the isosurface that the mesh has to stay near, within options.max_distance.
  StepGuard(Patch& patch, std::span<const Vec3> crossings, const Isosurface& isosurface, const ShapeOptions& options,
            SearchCounters& counters);

  // By this factor triangles may be farther from the isosurface than usual; from 4 on they need only face
  // lower values in one of the cells at two of their corners, from 8 on at one.
  void set_freedom(double freedom) {
    freedom_ = freedom;
    heights_.set_freedom(freedom);
  }

  // Whether the mesh has to stay near what it was near.
  void set_witnesses(bool are_kept) { keeps_witnesses_ = are_kept; }

  // What triangles of a step may do within a trial that has to end without: meet others (append_meeting() tells), and
  // lie far from the isosurface (far() tells which did, of all steps since forget_far()).
  void set_lenience(bool may_meet, bool may_be_far) {
    may_meet_ = may_meet;
    may_be_far_ = may_be_far;
  }
  void forget_far() { far_.clear(); }
  [[nodiscard]] const std::vector<std::uint32_t>& far() const { return far_; }
  // Appends the triangles that meet a triangle beyond what they share, or lie folded on it.
  void append_meeting(std::uint32_t triangle, std::vector<std::uint32_t>& found);

  // The volume that the component of a triangle encloses; none of an open one, or of one of more than so many
  // triangles.
  [[nodiscard]] std::optional<double> volume_around(std::uint32_t triangle, std::size_t most);
  // Whether a component has at least half of that volume, and its sign; true if it had none. A small component must not
  // be turned inside out or flattened, which no rim and no crossing tells.
  [[nodiscard]] bool keeps_volume(const std::optional<double>& old_volume, std::uint32_t triangle, std::size_t most);

  // Applies the step, or leaves the patch as it is and returns false. Precondition: the vertices of the removed
  // triangles are whole.
  bool apply(const PatchStep& step);

 private:
  [[nodiscard]] bool learn_old(std::span<const std::uint32_t> removed);
  [[nodiscard]] bool keeps_disks(const PatchStep& step);
  // Points that the mesh is near, and has to stay near.
  struct Witnesses {
    std::vector<Vec3> points;
    PointGrid grid;
    double reach;

    Witnesses(std::span<const Vec3> all, double distance)
        : points(all.begin(), all.end()), grid(points, distance), reach(distance) {}
  };
  // Triangles without a height.
  struct Unfaced {
    double area = 0, longest = 0;

    void add(const std::array<Vec3, 3>& corners);
  };
  [[nodiscard]] bool covers_witnesses(std::size_t first_added);
  [[nodiscard]] bool was_covered(const Vec3& p, double reach) const;
  [[nodiscard]] bool is_covered(const Vec3& p, double reach, std::size_t first_added);
  [[nodiscard]] bool lies_near(std::size_t first_added);
  [[nodiscard]] bool samples_stay_near(std::size_t first_added);
  [[nodiscard]] bool keeps_sides(std::size_t first_added);
  [[nodiscard]] bool crosses_nothing(std::size_t first_added);

  Patch& patch_;
  const Isosurface& isosurface_;
  double max_height_, max_edge_, max_sample_, freedom_ = 1;
  bool keeps_witnesses_ = true, may_meet_ = false, may_be_far_ = false;
  TriangleHeights heights_;
  Witnesses vertices_;   // of the patch as it was first; how near follows from the step
  Witnesses crossings_;  // of the isosurface
  // Before the step:
  std::vector<std::uint32_t> changed_;              // the vertices of the removed triangles, ascending,
  std::vector<std::uint8_t> was_closed_;            // and whether their links were
  std::vector<std::array<Vec3, 3>> old_triangles_;  // corners of the removed triangles
  std::vector<std::array<Vec3, 3>> new_triangles_;  // and of those added
  double old_longest_ = 0;                          // the longest of their edges
  double old_height_ = 0;                           // the largest of their distances from the isosurface
  Unfaced old_unfaced_;                             // of the removed triangles
  std::vector<double> limits_;                      // of each added triangle: how far it may be from the isosurface
  std::vector<std::uint32_t> near_, meeting_, far_;
  ComponentSize component_;
  VertexLink link_;
};

}  // namespace deliso

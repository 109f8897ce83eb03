#include "surface/certificate/cells/missed_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "delaunay/base/box3.h"
#include "raycast/voxel_intersection.h"
#include "surface/base/parallel_blocks.h"
#include "surface/certificate/cells/covering_triangles.h"
#include "surface/certificate/cells/surface_hull.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/box_tree.h"

namespace deliso {

namespace {

constexpr std::size_t kCellsAtOnce = 1024;

// The search of cells, one after the other.
class CellSearch {
 public:
  CellSearch(const SurfaceMesh& mesh, std::span<const Box3> boxes, const BoxTree& tree,
             const CoveringTriangles& covering, const ExactSurface& surface, double most)
      : mesh_(mesh),
        boxes_(boxes),
        tree_(tree),
        covering_(covering),
        surface_(surface),
        isosurface_(surface.isosurface),
        most_(most) {}

  [[nodiscard]] std::optional<Vec3> missed_in(const CellIndex& cell) {
    field_ = relative_to(isosurface_.grid().cell(cell[0], cell[1], cell[2]), isosurface_.isovalue());
    low_ = {double(cell[0]), double(cell[1]), double(cell[2])};
    const Box3 all{{0, 0, 0}, {1, 1, 1}};
    const Vec3 around{most_, most_, most_};
    near_[0].clear();
    tree_.for_each_meeting({place(all.low) - around, place(all.high) + around},
                           [&](std::uint32_t t) { near_[0].push_back(t); });
    missed_.reset();
    farthest_ = most_ * most_;
    look_at(all, 1);
    return missed_;
  }

 private:
  // Boxes whose diagonal is so small a part of the distance are not divided. What is not settled in them may be
  // farther than what is looked for by so much.
  static constexpr double kLeast = 40;
  static constexpr std::size_t kMostDepth = 24;

  [[nodiscard]] Vec3 place(const Vec3& in_cell) const { return scaled(isosurface_.step(), low_ + in_cell); }

  [[nodiscard]] double squared_distance_of(const Vec3& p, std::uint32_t triangle) const {
    const auto& [a, b, c] = mesh_.triangles[triangle];
    return squared_distance_to_triangle(p, mesh_.points[a], mesh_.points[b], mesh_.points[c]);
  }

  // The triangles near the box of this depth are among those near that of the depth before.
  void look_at(const Box3& box, std::size_t depth) {
    PartOfCell part{box, {}};
    for (unsigned i = 0; i < 8; ++i) part.values[i] = relative_value(field_, corner_of(box, i));
    if (missed_ || !holds_isovalue(part.values)) return;
    const Box3 in_mesh{place(box.low), place(box.high)};
    std::vector<std::uint32_t>& near = near_.at(depth);
    near.clear();
    for (const std::uint32_t t : near_.at(depth - 1)) {
      if (squared_gap(in_mesh, boxes_[t]) <= most_ * most_) near.push_back(t);
    }
    SurfaceHull hull(part);
    for (Vec3& p : hull) p = place(p);
    const Vec3 sides = in_mesh.size();
    const Vec3& rise = hull.rise();
    if (covering_.cover(hull, {-rise.x / sides.x, -rise.y / sides.y, -rise.z / sides.z}, near)) return;
    bool is_partly_near = false;
    if (is_near_one(hull, near, is_partly_near)) return;
    // A component that is left out has no mesh near.
    const double times = near.empty() && !surface_.is_dropped.empty() ? 1 : kLeast;
    const bool is_last = times * in_mesh.diagonal() <= most_ || depth + 1 == kMostDepth;
    if (is_last || !is_partly_near) take_from(part, near);
    // One cell may take seconds, where the mesh is coarse and the distance tiny.
    if (is_last || missed_ || surface_.is_over()) return;
    // Along its longer sides.
    const double longest = std::max({sides.x, sides.y, sides.z});
    Vec3 center = (box.low + box.high) / 2;
    unsigned whole = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (2 * sides[axis] > longest) continue;
      center[axis] = box.high[axis];
      whole |= 1u << axis;
    }
    for (unsigned octant = 0; octant < 8; ++octant) {
      if ((octant & whole) != 0) continue;
      Box3 eighth{center, center};
      eighth.extend(corner_of(box, octant));
      look_at(eighth, depth + 1);
    }
  }

  static double squared_gap(const Box3& a, const Box3& b) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double gap = std::max({0.0, a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]});
      sum += gap * gap;
    }
    return sum;
  }

  // Whether all of a box is as near another as is looked for, along each axis.
  [[nodiscard]] bool reaches_around(const Box3& box, const Box3& inner) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (inner.low[axis] < box.low[axis] - most_ || inner.high[axis] > box.high[axis] + most_) return false;
    }
    return true;
  }

  // Whether all of the isosurface in a part is near one of the triangles, which then comes first: it is likely to be
  // near the next part, too. The distance from a triangle is a convex function, so it is largest at corners.
  // `is_partly_near`: whether the first corner is near any.
  bool is_near_one(const SurfaceHull& hull, std::vector<std::uint32_t>& triangles, bool& is_partly_near) const {
    if (hull.count() == 0) return false;
    Box3 around;
    for (const Vec3& p : hull) around.extend(p);
    for (std::uint32_t& t : triangles) {
      // Most triangles are smaller than that.
      const bool may_be_near = reaches_around(boxes_[t], around);
      if (!may_be_near && is_partly_near) continue;
      std::size_t i = 0;
      const auto is_near = [&](const Vec3& p) {
        return squared_distance(p, boxes_[t].clamp(p)) <= most_ * most_ && squared_distance_of(p, t) <= most_ * most_;
      };
      while (i < (may_be_near ? hull.count() : 1) && is_near(hull.begin()[i])) ++i;
      is_partly_near = is_partly_near || i > 0;
      if (i < hull.count()) continue;
      std::swap(t, triangles.front());
      return true;
    }
    return false;
  }

  // Where the isosurface crosses edges of a part, if that is farther than what has been found.
  void take_from(const PartOfCell& part, const std::vector<std::uint32_t>& near) {
    for (unsigned from = 0; from < 8; ++from) {
      for (unsigned axis = 1; axis < 8; axis *= 2) {
        const unsigned to = from | axis;
        if (to == from || (part.values[from] >= 0) == (part.values[to] >= 0)) continue;
        const double along = part.values[from] / (part.values[from] - part.values[to]);
        const Vec3 a = corner_of(part.box, from), b = corner_of(part.box, to);
        const Vec3 p = place(a + along * (b - a));
        double off = std::numeric_limits<double>::infinity();
        for (const std::uint32_t t : near) off = std::min(off, squared_distance_of(p, t));
        if (!(off > farthest_) || !counts(p)) continue;
        farthest_ = off;
        missed_ = p;
      }
    }
  }

  [[nodiscard]] bool counts(const Vec3& p) const {
    if (surface_.is_dropped.empty()) return true;
    const auto component = surface_.component_at(p);
    return !component || surface_.is_dropped[*component] == 0;
  }

  const SurfaceMesh& mesh_;
  std::span<const Box3> boxes_;  // of the triangles
  const BoxTree& tree_;
  const CoveringTriangles& covering_;
  const ExactSurface& surface_;
  const Isosurface& isosurface_;
  double most_;
  CellCorners field_{};  // of the cell at hand, less the isovalue
  Vec3 low_;             // its lowest corner, in cells
  std::optional<Vec3> missed_;
  double farthest_ = 0;                                      // its squared distance
  std::array<std::vector<std::uint32_t>, kMostDepth> near_;  // triangles near the cell, and near its part of each depth
};

}  // namespace

std::vector<std::uint64_t> crossed_cells(const ExactSurface& surface) {
  const Dims& dims = surface.grid().dims();
  std::vector<std::uint64_t> cells;
  for (const EdgeCrossing& crossing : surface.topology.crossings) {
    if (!surface.wants(crossing)) continue;
    const CellIndex at = sample_of(crossing, dims);
    const std::size_t u = (crossing.axis + 1U) % 3, v = (crossing.axis + 2U) % 3;
    for (unsigned side = 0; side < 4; ++side) {
      CellIndex cell = at;
      cell.at(u) -= static_cast<std::int32_t>(side & 1U);
      cell.at(v) -= static_cast<std::int32_t>(side / 2);
      if (cell.at(u) < 0 || cell.at(v) < 0 || cell.at(u) > dims.at(u) - 2 || cell.at(v) > dims.at(v) - 2) continue;
      cells.push_back(surface.grid().index(cell[0], cell[1], cell[2]));
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

std::vector<MissedPlace> missed_places(const SurfaceMesh& mesh, const ExactSurface& surface, double most,
                                       std::span<const std::uint64_t> cells) {
  std::vector<Box3> boxes(mesh.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) boxes[t].extend(mesh.points[v]);
  }
  const CoveringTriangles covering(mesh, most);
  const BoxTree tree(boxes, surface.threads);
  const Dims& dims = surface.grid().dims();
  const std::size_t blocks = (cells.size() + kCellsAtOnce - 1) / kCellsAtOnce;
  std::vector<std::vector<MissedPlace>> found(blocks);
  for_each_block(
      cells.size(), surface.threads,
      [&](std::size_t first, std::size_t last) {
        CellSearch search(mesh, boxes, tree, covering, surface, most);
        for (std::size_t i = first; i < last && !surface.is_over(); ++i) {
          const EdgeCrossing lowest{cells[i], 0, 0, 0};
          const auto missed = search.missed_in(sample_of(lowest, dims));
          if (missed) found[first / kCellsAtOnce].push_back({cells[i], *missed});
        }
      },
      kCellsAtOnce);
  std::vector<MissedPlace> places;
  for (const auto& some : found) places.insert(places.end(), some.begin(), some.end());
  return places;
}

}  // namespace deliso

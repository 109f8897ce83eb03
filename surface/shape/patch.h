// A piece of the mesh that the shape stage works on: the triangles in and around some boxes, with the star of every
// vertex, and steps that replace a few triangles by others and can be undone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/base/vec3.h"
#include "surface/refine/guard/triangle_hash_grid.h"
#include "surface/shape/box_set.h"
#include "surface/shape/shape_options.h"

namespace deliso {

inline constexpr std::uint32_t kNoVertex = 0xFFFFFFFFU;

// The replacement of a disk of triangles by another with the same rim.
struct PatchStep {
  ShapeStep kind = ShapeStep::kFlip;
  std::vector<std::uint32_t> removed;               // triangles
  std::vector<std::array<std::uint32_t, 3>> added;  // corners, counterclockwise like those of the removed ones
  std::uint32_t vertex = kNoVertex;                 // that gets the point below: a vertex of the patch, or a new one
  Vec3 point;
  double quality = 0;                // the least of the added triangles (triangle_shape.h)
  Vec3 start;                        // from which the point was searched
  std::uint32_t opened = kNoVertex;  // an inner vertex that comes to be on the boundary
  bool is_on_boundary = false;       // the vertex lies in a face of the box
};

// The neighbours of a vertex, in order.
struct VertexLink {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> triangles;  // triangles[i] has the vertices i and i + 1 of the link
  bool is_closed = true;
};

class Patch {
 public:
  Patch() = default;
  // Of triangles with edges about this long.
  explicit Patch(double edge) : places_(edge) {}
  // `room`: all of the mesh's triangles that meet one of these boxes are in the patch.
  Patch(const BoxSet& room, double edge) : room_(&room), places_(edge) {}

  std::uint32_t add_vertex(const Vec3& point);
  std::uint32_t add_triangle(const std::array<std::uint32_t, 3>& corners);

  [[nodiscard]] std::size_t vertex_count() const { return points_.size(); }
  [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }  // of those removed, too
  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }
  [[nodiscard]] const Vec3& point(std::uint32_t v) const { return points_[v]; }
  // Whether all of the mesh's triangles around a vertex are in the patch.
  [[nodiscard]] bool is_whole(std::uint32_t v) const;
  [[nodiscard]] std::span<const std::uint32_t> star(std::uint32_t v) const { return stars_[v]; }
  [[nodiscard]] bool has(std::uint32_t t) const { return is_removed_[t] == 0; }
  [[nodiscard]] const std::array<std::uint32_t, 3>& corners(std::uint32_t t) const { return triangles_[t]; }
  [[nodiscard]] std::array<Vec3, 3> corner_points(std::uint32_t t) const {
    return {points_[triangles_[t][0]], points_[triangles_[t][1]], points_[triangles_[t][2]]};
  }
  [[nodiscard]] double quality(std::uint32_t t) const { return qualities_[t]; }
  [[nodiscard]] Box3 box_of(std::uint32_t t) const;
  // Appends the triangles whose boxes meet a box, as far as single precision tells.
  void append_near(const Box3& box, std::vector<std::uint32_t>& found) const { places_.append_near(box, found); }

  // Has a triangle count as worse than all others, until a step replaces it.
  void spoil(std::uint32_t t) { qualities_[t] = std::numeric_limits<double>::min(); }

  // The triangle across the edge from a to b of triangle t, if there is one.
  [[nodiscard]] std::uint32_t across(std::uint32_t t, std::uint32_t a, std::uint32_t b) const;
  // The link of a vertex; false when its triangles are no single fan, or repeat a vertex. Several threads may ask at
  // the same time (but not is_whole()).
  bool find_link(std::uint32_t v, VertexLink& link) const;

  void apply(const PatchStep& step);
  // Takes back the latest step that was applied.
  void undo();
  [[nodiscard]] std::size_t steps() const { return journal_.size(); }
  // The triangles that were replaced by all steps but the first so many.
  [[nodiscard]] std::vector<std::uint32_t> removed_since(std::size_t steps) const;

 private:
  struct Applied {
    std::vector<std::uint32_t> removed;
    std::size_t added = 0;
    std::uint32_t vertex = kNoVertex;
    bool is_new = false;  // the vertex
    Vec3 old_point;
  };
  void leave_stars(std::uint32_t t);
  void enter_stars(std::uint32_t t);

  std::vector<Vec3> points_;
  enum class Wholeness : std::uint8_t { kUnknown, kWhole, kCut };
  const BoxSet* room_ = nullptr;
  mutable std::vector<Wholeness> is_whole_;        // as far as it was asked for; steps do not change it
  std::vector<std::vector<std::uint32_t>> stars_;  // of each vertex: its triangles
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<double> qualities_;
  std::vector<std::uint8_t> is_removed_;
  TriangleHashGrid places_;
  std::vector<Applied> journal_;
};

}  // namespace deliso

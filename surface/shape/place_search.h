// The place on the isosurface from which the triangles over a rim are shaped best.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/base/box3.h"
#include "raycast/isosurface.h"

namespace deliso {

// An edge of the rim, directed like the triangle that a place makes with it.
struct RimSegment {
  Vec3 from, to;
};

struct Place {
  Vec3 point;
  double quality = 0;  // the least of the triangles over the rim (triangle_shape.h)
};

// A part of the curve in which the isosurface meets a face of the box, directed as the mesh lies: seen from below, the
// mesh is left of it.
struct BoundaryCurve {
  Vec3 begin, end;
  Vec3 outward;  // the normal of the face
};

// The faces of the box on which a point lies: bit 2 axis for the low one, bit 2 axis + 1 for the high one.
unsigned faces_at(const Box3& box, const Vec3& p);
// The outward normal of the lowest of some faces.
Vec3 outward_normal(unsigned faces);

// The least quality of the triangles from p over the rim, or 0 when it is not above `floor`.
double star_quality(const Vec3& p, std::span<const RimSegment> rim, double floor = 0);

class PlaceSearch {
 public:
  PlaceSearch(const Isosurface& isosurface, SearchCounters& counters) : isosurface_(isosurface), counters_(counters) {}

  // Whether each step goes the best way of all, and not the first good one.
  void set_thorough(bool is_so) { is_thorough_ = is_so; }

  // Starts from the best of some points on the isosurface and goes to better places around, in steps that become
  // smaller (a pattern search); ends early when the quality is `enough`. `normal`: of unit length, towards lower
  // values.
  [[nodiscard]] Place best(std::span<const RimSegment> rim, std::span<const Vec3> starts, const Vec3& normal,
                           double enough);
  // The same for a point of the boundary curve in a face of the box, between two others of that curve.
  [[nodiscard]] Place best_on_curve(std::span<const RimSegment> rim, std::span<const Vec3> starts,
                                    const BoundaryCurve& curve, double enough);
  // A point of the curve beside the point at a fraction of the way from its begin to its end.
  [[nodiscard]] std::optional<Vec3> on_curve(const BoundaryCurve& curve, double fraction);
  // The point of the isosurface on the line through p along the normal that is nearest to p and in the box, if any.
  [[nodiscard]] std::optional<Vec3> on_isosurface(const Vec3& p, const Vec3& normal, double reach);

  [[nodiscard]] const Isosurface& isosurface() const { return isosurface_; }

 private:
  const Isosurface& isosurface_;
  SearchCounters& counters_;
  bool is_thorough_ = false;
};

}  // namespace deliso

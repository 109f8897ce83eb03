// The steps at the boundary of the mesh, where the isosurface meets a face of the box.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "surface/mesh/triangle_shape.h"
#include "surface/shape/shape_steps.h"

namespace deliso {

// The part of a boundary curve from one vertex to another, if they and those between lie in one face alone.
std::optional<BoundaryCurve> ShapeSteps::curve(std::uint32_t begin, std::uint32_t end,
                                               std::initializer_list<std::uint32_t> between) const {
  const Box3& box = search_.isosurface().box();
  unsigned faces = faces_at(box, patch_.point(begin)) & faces_at(box, patch_.point(end));
  for (const std::uint32_t v : between) {
    const unsigned own = faces_at(box, patch_.point(v));
    if (std::popcount(own) != 1) return std::nullopt;
    faces &= own;
  }
  if (std::popcount(faces) != 1) return std::nullopt;
  return BoundaryCurve{patch_.point(begin), patch_.point(end), outward_normal(faces)};
}

// A triangle in a face of the box, with an edge of the boundary: without it, its other two edges are the boundary.
void ShapeSteps::drop(const Side& side, std::vector<PatchStep>& steps) {
  if (!curve(side.a, side.b, {side.c}) || !patch_.find_link(side.c, link_) || !link_.is_closed) return;
  PatchStep step{ShapeStep::kFlip, {side.triangle}, {}, kNoVertex, {}, 1, {}};
  step.opened = side.c;
  if (are_whole(step.removed)) steps.push_back(std::move(step));
}

// An edge of the boundary may cut off an inner vertex that lies in the face of the box, two triangles away from it. Of
// the two, the part in the face goes, and the vertex is on the boundary.
void ShapeSteps::drop_two(const Side& side, std::vector<PatchStep>& steps) {
  const std::array<std::uint32_t, 3> corners = {side.a, side.b, side.c};
  for (const std::size_t end : {0U, 1U}) {
    const std::uint32_t from = end == 0 ? side.c : side.b, to = end == 0 ? side.a : side.c;
    const std::uint32_t beyond = patch_.across(side.triangle, from, to);
    if (beyond == kNoVertex) continue;
    const auto& others = patch_.corners(beyond);
    const std::uint32_t apex =
        *std::find_if(others.begin(), others.end(), [&](std::uint32_t v) { return v != from && v != to; });
    if (!curve(side.a, side.b, {apex}) || !patch_.find_link(apex, link_) || !link_.is_closed) continue;
    PatchStep step{ShapeStep::kFlip, {side.triangle, beyond}, {corners}, kNoVertex, {}, 0, {}};
    step.added[0][end] = apex;
    step.opened = apex;
    const auto& [a, b, c] = step.added[0];
    step.quality = sine_of_least_angle(patch_.point(a), patch_.point(b), patch_.point(c));
    if (are_whole(step.removed)) steps.push_back(std::move(step));
  }
}

// A triangle with an edge of the boundary goes, and the vertex across from it moves onto the boundary between the two:
// inner vertices a hair off a face of the box come to lie in it.
void ShapeSteps::open(const Side& side, double enough, std::vector<PatchStep>& steps) {
  const auto along = curve(side.a, side.b, {});
  if (!along || faces_at(search_.isosurface().box(), patch_.point(side.c)) != 0) return;
  if (!patch_.is_whole(side.c) || !patch_.find_link(side.c, link_) || !link_.is_closed) return;
  PatchStep step{ShapeStep::kFlip, link_.triangles, {}, side.c, {}, 0, {}};
  step.opened = side.c;
  const std::vector<std::uint32_t>& link = link_.vertices;
  for (std::size_t i = 0; i < link_.triangles.size(); ++i) {
    if (link_.triangles[i] != side.triangle) step.added.push_back({side.c, link[i], link[(i + 1) % link.size()]});
  }
  const Vec3 edge = along->end - along->begin;
  const double fraction = dot(patch_.point(side.c) - along->begin, edge) / squared_norm(edge);
  if (!(fraction > 0 && fraction < 1)) return;
  const auto start = search_.on_curve(*along, fraction);
  if (start) place_on_curve(std::move(step), {*start}, *along, enough, steps);
}

// The only triangle at a vertex of the boundary goes with it, unless it is all of its component.
void ShapeSteps::remove_ear(std::uint32_t v, std::vector<PatchStep>& steps) {
  const std::uint32_t a = link_.vertices[0], b = link_.vertices[1];
  // The vertex may lie on an edge of the box: the boundary runs on in the face that all three share.
  const Box3& box = search_.isosurface().box();
  const unsigned ends = faces_at(box, patch_.point(a)) & faces_at(box, patch_.point(b));
  if (std::popcount(ends) != 1 || (ends & faces_at(box, patch_.point(v))) == 0) return;
  if (patch_.across(link_.triangles[0], a, b) == kNoVertex) return;
  PatchStep step{ShapeStep::kRemove, link_.triangles, {}, kNoVertex, {}, 1, {}};
  if (are_whole(step.removed)) steps.push_back(std::move(step));
}

}  // namespace deliso

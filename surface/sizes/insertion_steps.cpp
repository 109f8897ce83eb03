#include "surface/sizes/insertion_steps.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "delaunay/base/box3.h"
#include "surface/mesh/triangle_shape.h"
#include "surface/shape/place_search.h"

namespace deliso {

namespace {

bool is_in(const std::vector<std::uint32_t>& cavity, std::uint32_t t) {
  return std::find(cavity.begin(), cavity.end(), t) != cavity.end();
}

// The star of a new vertex over the rim of some triangles. Corners that are theirs alone are gone. In a face of the box
// the vertex comes to be on the boundary: an edge of it that lies there has no triangle.
PatchStep star_step(const Patch& patch, const std::vector<std::uint32_t>& cavity, const Vec3& p, const Box3& box) {
  PatchStep step;
  step.kind = ShapeStep::kInsert;
  step.removed = cavity;
  step.vertex = static_cast<std::uint32_t>(patch.vertex_count());
  step.point = step.start = p;
  for (const std::uint32_t t : cavity) {
    const auto& corners = patch.corners(t);
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t a = corners[(side + 1) % 3], b = corners[(side + 2) % 3];
      const std::uint32_t beyond = patch.across(t, a, b);
      if (beyond == kNoVertex &&
          (faces_at(box, p) & faces_at(box, patch.point(a)) & faces_at(box, patch.point(b))) != 0) {
        step.is_on_boundary = true;
      } else if (!is_in(cavity, beyond)) {
        step.added.push_back({step.vertex, a, b});
      }
    }
  }
  return step;
}

// Over a triangle and those of its neighbours that `sides` names, as bits.
PatchStep triangle_step(const Patch& patch, std::uint32_t t, const Vec3& p, unsigned sides, const Box3& box) {
  std::vector<std::uint32_t> cavity = {t};
  const auto& corners = patch.corners(t);
  for (unsigned side = 0; side < 3; ++side) {
    const std::uint32_t beyond = patch.across(t, corners[(side + 1) % 3], corners[(side + 2) % 3]);
    if ((sides >> side & 1u) != 0 && beyond != kNoVertex) cavity.push_back(beyond);
  }
  return star_step(patch, cavity, p, box);
}

double least_quality(const Patch& patch, const PatchStep& step) {
  const auto at = [&](std::uint32_t v) { return v == step.vertex ? step.point : patch.point(v); };
  double least = 1;
  for (const auto& [a, b, c] : step.added) least = std::min(least, sine_of_least_angle(at(a), at(b), at(c)));
  return least;
}

// A tip of a finger may stand out beyond a vertex: over the rim of some of the triangles around it that follow each
// other, or of all, and the vertex is gone then. The best triangles first.
std::vector<PatchStep> tip_steps(const Patch& patch, std::uint32_t t, const Vec3& p, const Box3& box) {
  const auto& corners = patch.corners(t);
  const std::uint32_t nearest =
      *std::min_element(corners.begin(), corners.end(), [&](std::uint32_t v, std::uint32_t u) {
        return squared_distance(patch.point(v), p) < squared_distance(patch.point(u), p);
      });
  std::vector<PatchStep> steps;
  VertexLink link;
  if (!patch.find_link(nearest, link)) return steps;
  const std::size_t count = link.triangles.size();
  for (std::size_t first = 0; first < count; ++first) {
    std::vector<std::uint32_t> cavity;
    const std::size_t most = link.is_closed ? (first == 0 ? count : count - 1) : count - first;
    for (std::size_t i = 0; i < most; ++i) {
      cavity.push_back(link.triangles[(first + i) % count]);
      steps.push_back(star_step(patch, cavity, p, box));
      steps.back().quality = least_quality(patch, steps.back());
    }
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const PatchStep& a, const PatchStep& b) { return a.quality > b.quality; });
  return steps;
}

}  // namespace

std::vector<PatchStep> insertion_steps(const Patch& patch, std::uint32_t t, const Vec3& p, const Box3& box) {
  std::vector<PatchStep> steps;
  for (const unsigned sides : {7u, 0u, 1u, 2u, 4u, 3u, 5u, 6u}) steps.push_back(triangle_step(patch, t, p, sides, box));
  for (PatchStep& step : tip_steps(patch, t, p, box)) steps.push_back(std::move(step));
  return steps;
}

}  // namespace deliso

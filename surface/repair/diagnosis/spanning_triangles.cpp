#include "surface/repair/diagnosis/spanning_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "surface/base/parallel_blocks.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/certificate/triangle_nearness.h"
#include "surface/mesh/triangle_shape.h"

namespace deliso {

namespace {

constexpr std::ptrdiff_t kFew = 64;

bool faces_up_somewhere(const Isosurface& isosurface, const std::array<Vec3, 3>& corners, const Vec3& normal) {
  return std::any_of(corners.begin(), corners.end(),
                     [&](const Vec3& p) { return dot(isosurface.gradient(p), normal) > 0; });
}

bool is_spanning(const Isosurface& isosurface, const std::array<Vec3, 3>& corners, double max_distance) {
  // A triangle with a part so far from its corners has a longer edge.
  const double longest = longest_edge(corners);
  if (longest < std::sqrt(3.0) * max_distance) return false;
  const auto& [a, b, c] = corners;
  const Vec3 normal = cross(b - a, c - a);
  const double length = norm(normal);
  if (!(length > 0) || !faces_up_somewhere(isosurface, corners, normal)) return false;
  const Vec3 centroid = (a + b + c) / 3;
  SearchCounters ignored;
  const auto hit = isosurface.nearest_falling_hit({centroid, normal / length}, longest / 2, ignored);
  if (hit && (*hit > 0) == isosurface.is_above(centroid)) return false;
  return count_far_parts(isosurface, corners, max_distance, 1) > 0;
}

IndexBox layers_around(const std::array<Vec3, 3>& corners, const ExactSurface& surface) {
  const auto& dims = surface.grid().dims();
  const Vec3& step = surface.isosurface.step();
  IndexBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = dims[axis] - 1.0;
    const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    box[axis] = {static_cast<std::int32_t>(std::clamp(std::floor(low / step[axis]), 0.0, last)),
                 static_cast<std::int32_t>(std::clamp(std::ceil(high / step[axis]), 0.0, last))};
  }
  return box;
}

void drop_many(std::vector<SpanningTriangle>& found) {
  for (auto first = found.begin(); first != found.end();) {
    const auto next = std::find_if(first, found.end(), [&](const auto& t) { return t.component != first->component; });
    first = next - first > kFew ? found.erase(first, next) : next;
  }
}

}  // namespace

std::vector<SpanningTriangle> spanning_triangles(const MatchedMesh& mesh, const ExactSurface& surface,
                                                 const std::vector<bool>& done, double max_distance) {
  const ComponentMatch& match = mesh.match;
  const SurfaceMesh& triangles = mesh.built.mesh;
  std::vector<std::uint32_t> component_of_piece(match.pieces.size(), kNoComponent);
  for (std::uint32_t c = 0; c < done.size(); ++c) {
    if (!done[c] && match.agreement[c] >= Agreement::kDisplaced) component_of_piece[match.main_piece[c]] = c;
  }
  std::vector<SpanningTriangle> found = collect_in_blocks<SpanningTriangle>(
      triangles.triangles.size(), surface.threads, [&](std::size_t t, std::vector<SpanningTriangle>& some) {
        const auto& [a, b, c] = triangles.triangles[t];
        const std::uint32_t component = component_of_piece[match.piece_of[a]];
        const std::array<Vec3, 3> corners = {triangles.points[a], triangles.points[b], triangles.points[c]};
        if (component != kNoComponent && is_spanning(surface.isosurface, corners, max_distance)) {
          some.push_back({component, layers_around(corners, surface)});
        }
      });
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.component < b.component; });
  drop_many(found);
  return found;
}

}  // namespace deliso

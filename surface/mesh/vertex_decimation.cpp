#include "surface/mesh/vertex_decimation.h"

#include <algorithm>
#include <limits>

#include "delaunay/triangle_contact.h"

namespace deliso {

VertexDecimation::VertexDecimation(SurfaceMesh& mesh)
    : mesh_(mesh), corner_of_(mesh.points.size(), kNoCorner), is_gone_(mesh.triangles.size(), false) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) corner_of_[mesh.triangles[t][i]] = 3 * t + i;
  }
}

bool VertexDecimation::find(std::uint32_t vertex, VertexFan& fan) const {
  for (std::uint32_t corner = corner_of_[vertex];;) {
    const std::uint32_t t = corner / 3, i = corner % 3;
    fan.triangles.push_back(t);
    fan.link.push_back(mesh_.triangles[t][(i + 1) % 3]);
    fan.outer.push_back(mesh_.neighbours[t][i]);
    const TriangleSide side = mesh_.neighbours[t][(i + 1) % 3];
    if (side == kNoSide) return false;
    corner = 3 * (side >> 2) + ((side & 3u) + 1) % 3;
    if (corner == corner_of_[vertex]) return true;
  }
}

bool VertexDecimation::are_joined(std::uint32_t v, std::uint32_t w) const {
  bool found = false;
  std::uint32_t visits = 0;
  for_each_corner_of_fan(
      corner_of_[v], [&](TriangleSide side) { return mesh_.neighbours[side >> 2][side & 3u]; },
      [&](std::uint32_t corner) {
        const auto& t = mesh_.triangles[corner / 3];
        found |= std::find(t.begin(), t.end(), w) != t.end();
        return visits++ == 0 || corner != corner_of_[v];
      });
  return found;
}

bool VertexDecimation::can_be_filled(const VertexFan& fan) const {
  if (fan.link.size() < 3 || fan.link.size() > kLongestLink) return false;
  std::vector<std::uint32_t> sorted = fan.link;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return false;
  const TriangleSide beyond = fan.outer.front();
  return fan.link.size() > 3 || beyond == kNoSide || mesh_.triangles[beyond >> 2][beyond & 3u] != fan.link[2];
}

MinimumAreaTriangulation VertexDecimation::least_filling(const VertexFan& fan) const {
  const auto area = [&](std::size_t i, std::size_t k, std::size_t j) {
    const Vec3 &a = mesh_.points[fan.link[i]], &b = mesh_.points[fan.link[k]], &c = mesh_.points[fan.link[j]];
    return has_area(a, b, c) ? 0.5 * norm(cross(b - a, c - a)) : std::numeric_limits<double>::infinity();
  };
  return {fan.link.size(), area, [&](std::size_t i, std::size_t j) { return !are_joined(fan.link[i], fan.link[j]); }};
}

void VertexDecimation::replace(std::uint32_t vertex, const VertexFan& fan, const MinimumAreaTriangulation& filling) {
  for (std::size_t i = fan.triangles.size() - 2; i < fan.triangles.size(); ++i) is_gone_[fan.triangles[i]] = true;
  std::size_t next = 0;
  const TriangleSide last = build(fan, filling, 0, fan.link.size() - 1, next);
  join(last, fan.outer.back());
  corner_of_[vertex] = kNoCorner;
}

void VertexDecimation::take_out(std::span<const std::uint32_t> vertices) {
  // Repeat: what prevented the removal of one vertex may be gone after the removal of others.
  for (bool any = true; any;) {
    any = false;
    for (const std::uint32_t v : vertices) any |= has(v) && take_out(v);
  }
}

bool VertexDecimation::take_out(std::uint32_t vertex) {
  VertexFan fan;
  if (!find(vertex, fan) || !can_be_filled(fan)) return false;
  const MinimumAreaTriangulation filling = least_filling(fan);
  if (!filling.exists()) return false;
  replace(vertex, fan, filling);
  return true;
}

// Builds the part of the filling between two corners of the link, in the slots from `next` on. Returns the side to
// which the rest is to be joined.
TriangleSide VertexDecimation::build(const VertexFan& fan, const MinimumAreaTriangulation& filling, std::size_t i,
                                     std::size_t j, std::size_t& next) {
  if (j == i + 1) return fan.outer[i];
  const std::size_t k = filling.apex(i, j);
  const std::uint32_t t = fan.triangles[next++];
  mesh_.triangles[t] = {fan.link[i], fan.link[k], fan.link[j]};
  for (std::uint32_t c = 0; c < 3; ++c) corner_of_[mesh_.triangles[t][c]] = 3 * t + c;
  renewed_.push_back(t);
  join(4 * t + 2, build(fan, filling, i, k, next));
  join(4 * t, build(fan, filling, k, j, next));
  return 4 * t + 1;
}

}  // namespace deliso

#include "surface/intruders.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

#include "surface/least_triangulation.h"
#include "surface/vertex_fans.h"

namespace deliso {

namespace {

constexpr std::uint32_t kNoComponent = 0xFFFFFFFFu;  // of a point that was moved off the surface

// The vertices of each piece that hang together through triangles.
std::vector<std::vector<std::uint32_t>> pieces_of(const SurfaceMesh& mesh) {
  std::vector<bool> is_seen(mesh.triangles.size(), false), has_vertex(mesh.points.size(), false);
  std::vector<std::vector<std::uint32_t>> pieces;
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (is_seen[seed]) continue;
    is_seen[seed] = true;
    std::vector<std::uint32_t> open = {seed};
    pieces.emplace_back();
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back();
      for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t v = mesh.triangles[t][i];
        if (!has_vertex[v]) pieces.back().push_back(v);
        has_vertex[v] = true;
        const TriangleSide side = mesh.neighbours[t][i];
        if (side == kNoSide || is_seen[side >> 2]) continue;
        is_seen[side >> 2] = true;
        open.push_back(side >> 2);
      }
    }
  }
  return pieces;
}

// The vertices of a piece that do not lie on the component of most, as far as a component is known.
void append_intruders(const std::vector<std::uint32_t>& piece, const std::vector<std::uint32_t>& component,
                      std::vector<std::uint32_t>& intruders) {
  std::map<std::uint32_t, std::size_t> votes;
  for (const std::uint32_t v : piece) {
    if (component[v] != kNoComponent) ++votes[component[v]];
  }
  if (votes.size() < 2) return;
  const std::uint32_t own = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
                              return a.second < b.second;
                            })->first;
  std::copy_if(piece.begin(), piece.end(), std::back_inserter(intruders),
               [&](std::uint32_t v) { return component[v] != kNoComponent && component[v] != own; });
}

bool remove(std::uint32_t v, VertexFans& fans) {
  VertexFan fan;
  if (!fans.find(v, fan) || !fans.can_be_filled(fan)) return false;
  const LeastTriangulation filling = fans.least_filling(fan);
  if (!filling.exists()) return false;
  fans.replace(v, fan, filling);
  return true;
}

}  // namespace

std::int64_t remove_intruders(SurfaceMesh& mesh, const ScalarGrid& grid, const Isosurface& isosurface,
                              const IsosurfaceTopology& topology) {
  const Vec3& step = isosurface.step();
  std::vector<std::uint32_t> component(mesh.points.size());
  for (std::size_t v = 0; v < component.size(); ++v) {
    const Vec3& p = mesh.points[v];
    component[v] = component_of(grid, isosurface.isovalue(), topology, {p.x / step.x, p.y / step.y, p.z / step.z})
                       .value_or(kNoComponent);
  }
  std::vector<std::uint32_t> intruders;
  for (const auto& piece : pieces_of(mesh)) append_intruders(piece, component, intruders);
  if (intruders.empty()) return 0;
  VertexFans fans(mesh);
  std::int64_t removed = 0;
  // What was in the way of one may be gone the next time.
  for (std::int64_t before = -1; before != removed;) {
    before = removed;
    for (const std::uint32_t v : intruders) removed += fans.has(v) && remove(v, fans) ? 1 : 0;
  }
  if (removed > 0) fans.drop_free_slots();
  return removed;
}

}  // namespace deliso

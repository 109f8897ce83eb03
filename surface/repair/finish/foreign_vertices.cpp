#include "surface/repair/finish/foreign_vertices.h"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "surface/certificate/mesh_pieces.h"
#include "surface/mesh/vertex_decimation.h"
#include "surface/search/covering_triangles.h"

namespace deliso {

namespace {

// The vertices of pieces that do not lie on the component of most; and the triangles of the pieces on each component
// that has some.
struct Found {
  std::vector<std::uint32_t> vertices;
  std::map<std::uint32_t, std::vector<std::uint32_t>> triangles_on;
};

Found find_intruders(const SurfaceMesh& mesh, std::span<const std::uint32_t> component_of) {
  Found found;
  std::vector<std::uint32_t> own_of(mesh.triangles.size(), kNoComponent);  // the component of each triangle's piece
  std::vector<bool> is_seen(mesh.triangles.size(), false);
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (is_seen[seed]) continue;
    const std::vector<std::uint32_t> triangles = flood(mesh, seed, is_seen);
    const std::vector<std::uint32_t> vertices = vertices_of(mesh, triangles);
    std::vector<std::uint32_t> components;
    components.reserve(vertices.size());
    for (const std::uint32_t v : vertices) components.push_back(component_of[v]);
    const std::optional<std::uint32_t> own = most_frequent(components);
    for (const std::uint32_t t : triangles) own_of[t] = own.value_or(kNoComponent);
    for (const std::uint32_t v : vertices) {
      if (component_of[v] == own || component_of[v] == kNoComponent) continue;
      found.vertices.push_back(v);
      found.triangles_on[component_of[v]];
    }
  }
  if (found.vertices.empty()) return found;
  for (std::uint32_t t = 0; t < own_of.size(); ++t) {
    const auto at = found.triangles_on.find(own_of[t]);
    if (at != found.triangles_on.end()) at->second.push_back(t);
  }
  return found;
}

}  // namespace

ForeignVertices remove_foreign_vertices(SurfaceMesh& mesh, std::span<const std::uint32_t> component_of) {
  const Found found = find_intruders(mesh, component_of);
  ForeignVertices counted{0, static_cast<std::int64_t>(found.vertices.size())};
  std::vector<std::uint32_t> intruders = found.vertices;
  std::erase_if(intruders, [&](std::uint32_t v) {
    const std::vector<std::uint32_t>& own = found.triangles_on.at(component_of[v]);
    return std::none_of(own.begin(), own.end(),
                        [&](std::uint32_t t) { return is_covered_by(mesh.points[v], mesh, t); });
  });
  if (intruders.empty()) return counted;
  VertexDecimation fans(mesh);
  fans.take_out(intruders);
  counted.removed = std::count_if(intruders.begin(), intruders.end(), [&](std::uint32_t v) { return !fans.has(v); });
  counted.left -= counted.removed;
  if (counted.removed > 0) fans.drop_free_slots();
  return counted;
}

}  // namespace deliso

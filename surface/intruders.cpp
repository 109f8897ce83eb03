#include "surface/intruders.h"

#include <optional>
#include <vector>

#include "surface/least_triangulation.h"
#include "surface/mesh_pieces.h"
#include "surface/vertex_fans.h"

namespace deliso {

namespace {

// The vertices of a piece that do not lie on the component of most, as far as a component is known.
void append_intruders(const std::vector<std::uint32_t>& vertices, const std::vector<std::uint32_t>& components,
                      std::vector<std::uint32_t>& intruders) {
  const std::optional<std::uint32_t> own = most_frequent(components);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (components[i] != kNoComponent && components[i] != own) intruders.push_back(vertices[i]);
  }
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
  std::vector<std::uint32_t> intruders;
  std::vector<bool> is_seen(mesh.triangles.size(), false);
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (is_seen[seed]) continue;
    const std::vector<std::uint32_t> vertices = vertices_of(mesh, flood(mesh, seed, is_seen));
    append_intruders(vertices, components_at(mesh, vertices, grid, isosurface, topology), intruders);
  }
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

#include "surface/repair/finish/foreign_vertices.h"

#include <algorithm>
#include <map>
#include <vector>

#include "surface/certificate/component_match.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/mesh/vertex_decimation.h"
#include "surface/search/covering_triangles.h"

namespace deliso {

namespace {

// The vertices that lie on another component than most vertices of their piece; and, for each component with such
// vertices, the triangles of the pieces that lie on it.
struct Found {
  std::vector<std::uint32_t> vertices;
  std::map<std::uint32_t, std::vector<std::uint32_t>> triangles_on;
};

Found find_foreign_vertices(const SurfaceMesh& mesh, std::span<const std::uint32_t> component_of) {
  Found found;
  const ComponentMatch match = find_pieces(mesh);
  const std::size_t pieces = match.pieces.size();
  const std::vector<ComponentShare> largest =
      largest_shares_of_pieces(component_shares(match.piece_of, component_of, pieces), pieces);
  for (std::uint32_t v = 0; v < component_of.size(); ++v) {
    if (match.piece_of[v] == kNoPiece || component_of[v] == kNoComponent) continue;
    if (component_of[v] == largest[match.piece_of[v]].component) continue;
    found.vertices.push_back(v);
    found.triangles_on[component_of[v]];
  }
  if (found.vertices.empty()) return found;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const ComponentShare& own = largest[match.piece_of[mesh.triangles[t][0]]];
    const auto at = found.triangles_on.find(own.component);
    if (own.vertices > 0 && at != found.triangles_on.end()) at->second.push_back(t);
  }
  return found;
}

}  // namespace

ForeignVertices remove_foreign_vertices(SurfaceMesh& mesh, std::span<const std::uint32_t> component_of) {
  const Found found = find_foreign_vertices(mesh, component_of);
  ForeignVertices counted{0, static_cast<std::int64_t>(found.vertices.size())};
  std::vector<std::uint32_t> removable = found.vertices;
  std::erase_if(removable, [&](std::uint32_t v) {
    const std::vector<std::uint32_t>& own = found.triangles_on.at(component_of[v]);
    return std::none_of(own.begin(), own.end(),
                        [&](std::uint32_t t) { return is_covered_by(mesh.points[v], mesh, t); });
  });
  if (removable.empty()) return counted;
  VertexDecimation fans(mesh);
  fans.take_out(removable);
  counted.removed = std::count_if(removable.begin(), removable.end(), [&](std::uint32_t v) { return !fans.has(v); });
  counted.left -= counted.removed;
  if (counted.removed > 0) fans.drop_free_slots();
  return counted;
}

}  // namespace deliso

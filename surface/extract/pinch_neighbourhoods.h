// The triangles around groups of vertices at one position: those that copies may meet when they move.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "delaunay/ids.h"
#include "surface/extract/pinch_groups.h"
#include "surface/mesh/surface_mesh.h"

namespace deliso {

class PinchNeighbourhoods {
 public:
  // For a mesh whose points may move by less than kPinchSeparation, and whose copies may also move to their other
  // positions. `origin_of` gives, for each mesh vertex, the vertex that it is a copy of. Keeps references.
  PinchNeighbourhoods(const SurfaceMesh& mesh, std::span<const PinchGroup> groups, std::span<const VertexId> origin_of);

  // Precondition: v is a vertex of a triangle at a copy. The triangles at v and at all vertices with the same origin,
  // ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& fan(std::uint32_t v) const { return fans_.at(origin_of_[v].index()); }
  // Whether a triangle is at a vertex itself.
  [[nodiscard]] bool is_at(std::uint32_t t, std::uint32_t v) const {
    return std::find(mesh_.triangles[t].begin(), mesh_.triangles[t].end(), v) != mesh_.triangles[t].end();
  }
  // The triangles around a group: the fans of all vertices of the triangles at its copies. If a copy has other
  // positions, which may lie farther away, also the triangles that meet a box around these positions and the triangles
  // at the copy. Ascending.
  [[nodiscard]] std::vector<std::uint32_t> triangles(std::size_t group) const;

 private:
  void find_fans();
  void find_those_near_other_positions();

  const SurfaceMesh& mesh_;
  std::span<const PinchGroup> groups_;
  std::span<const VertexId> origin_of_;
  std::unordered_map<std::size_t, std::vector<std::uint32_t>> fans_;  // by origin
  // By group, for those with other positions.
  std::unordered_map<std::size_t, std::vector<std::uint32_t>> near_other_positions_;
};

}  // namespace deliso

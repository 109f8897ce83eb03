// The triangles around groups of vertices that stand at one place: what their copies may come to meet when they move.
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
  // Of a mesh whose points may move a hair's breadth from where they are, and copies to their other homes. `origin_of`
  // names, for each mesh vertex, what it is a copy of. Keeps references.
  PinchNeighbourhoods(const SurfaceMesh& mesh, std::span<const PinchGroup> groups, std::span<const VertexId> origin_of);

  // Of a copy, or a vertex of a triangle at one: the triangles at all that have its origin, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& fan(std::uint32_t v) const { return fans_.at(origin_of_[v].index()); }
  // Whether a triangle is at a vertex itself.
  [[nodiscard]] bool is_at(std::uint32_t t, std::uint32_t v) const {
    return std::find(mesh_.triangles[t].begin(), mesh_.triangles[t].end(), v) != mesh_.triangles[t].end();
  }
  // Those in the fans of the vertices of the triangles at the group's copies; where a copy has other homes, which may
  // lie farther away, also those that meet a box around these homes and the triangles at the copy. Ascending.
  [[nodiscard]] std::vector<std::uint32_t> triangles(std::size_t group) const;

 private:
  void find_fans();
  void find_those_near_homes();

  const SurfaceMesh& mesh_;
  std::span<const PinchGroup> groups_;
  std::span<const VertexId> origin_of_;
  std::unordered_map<std::size_t, std::vector<std::uint32_t>> fans_;        // by origin
  std::unordered_map<std::size_t, std::vector<std::uint32_t>> near_homes_;  // by group, for those with other homes
};

}  // namespace deliso

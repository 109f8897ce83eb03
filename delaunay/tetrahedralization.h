// A tetrahedralization of points in space in flat arrays, closed to a 3-sphere by ghost tetrahedra.
//
// Every hull facet carries a ghost tetrahedron whose fourth vertex is the infinite vertex; so every tetrahedron has
// four neighbours and no super-tetrahedron is needed.
//
// Invariants (checked by delaunay/validate.h):
//  * a finite tetrahedron is positively oriented: orient3d(v0, v1, v2, v3) > 0; none is flat;
//  * a ghost holds kInfiniteVertex in slot 3, and its facet 3, seen from inside the hull, is the hull facet: a point
//    strictly beyond the hull facet makes orient3d(v0, v1, v2, point) > 0;
//  * mirror(mirror(f)) == f, and a facet and its mirror have the same three vertices.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/vec3.h"
#include "delaunay/ids.h"

namespace deliso {

class Tetrahedralization {
 public:
  [[nodiscard]] std::size_t vertex_count() const { return points_.size(); }
  // Slots, live and free: valid tetrahedron ids are below this.
  [[nodiscard]] std::size_t tet_slots() const { return vertices_.size(); }
  [[nodiscard]] bool is_live(TetId t) const;
  [[nodiscard]] bool is_ghost(TetId t) const { return vertices_[t.index()][3] == kInfiniteVertex; }
  [[nodiscard]] const std::array<VertexId, 4>& vertices(TetId t) const { return vertices_[t.index()]; }
  [[nodiscard]] const Vec3& point(VertexId v) const { return points_[v.index()]; }
  [[nodiscard]] std::span<const Vec3> points() const { return points_; }
  // The same facet seen from the neighbour across it.
  [[nodiscard]] FacetId mirror(FacetId f) const { return neighbours_[f.tet().index()][f.face()]; }
  [[nodiscard]] TetId neighbour(TetId t, unsigned face) const { return neighbours_[t.index()][face].tet(); }
  // Some live tetrahedron that has v as a vertex.
  [[nodiscard]] TetId incident_tet(VertexId v) const { return incident_[v.index()]; }

 protected:
  std::vector<Vec3> points_;                        // point of each vertex
  std::vector<TetId> incident_;                     // a live tetrahedron at each vertex
  std::vector<std::array<VertexId, 4>> vertices_;   // four vertices of each tetrahedron
  std::vector<std::array<FacetId, 4>> neighbours_;  // across face i: that facet as the neighbour knows it
};

}  // namespace deliso

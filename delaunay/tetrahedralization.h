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

#include "delaunay/base/shared_array.h"
#include "delaunay/base/slab.h"
#include "delaunay/base/vec3.h"
#include "delaunay/ids.h"

namespace deliso {

class Tetrahedralization {
 public:
  [[nodiscard]] std::size_t vertex_count() const { return points_.size(); }
  // Slots, live and free: valid tetrahedron ids are below this.
  [[nodiscard]] std::size_t tet_slots() const { return tets_.size(); }
  [[nodiscard]] bool is_live(TetId t) const { return !vertices(t)[0].is_none(); }
  [[nodiscard]] bool is_ghost(TetId t) const { return vertices(t)[3] == kInfiniteVertex; }
  [[nodiscard]] const std::array<VertexId, 4>& vertices(TetId t) const { return tets_[t.index()].vertices; }
  [[nodiscard]] const Vec3& point(VertexId v) const { return points_[v.index()]; }
  [[nodiscard]] std::span<const Vec3> points() const { return {points_.data(), points_.size()}; }
  // The same facet seen from the neighbour across it.
  [[nodiscard]] FacetId mirror(FacetId f) const { return tets_[f.tet().index()].mirrors[f.face()]; }
  [[nodiscard]] TetId neighbour(TetId t, unsigned face) const { return tets_[t.index()].mirrors[face].tet(); }
  // Whether a vertex has tetrahedra. Only a removed vertex has none, until close_gaps() drops it.
  [[nodiscard]] bool is_live(VertexId v) const { return !incident_[v.index()].is_none(); }
  // Some live tetrahedron that has v as a vertex.
  [[nodiscard]] TetId incident_tet(VertexId v) const { return incident_[v.index()]; }
  // Whether all finite vertices of a tetrahedron lie strictly between the planes of a slab.
  [[nodiscard]] bool lies_within(const Slab& slab, TetId t) const {
    const std::array<VertexId, 4>& v = vertices(t);
    return slab.contains(point(v[0])) && slab.contains(point(v[1])) && slab.contains(point(v[2])) &&
           (v[3] == kInfiniteVertex || slab.contains(point(v[3])));
  }
  // The vertices of a facet, counterclockwise seen from outside its tetrahedron.
  [[nodiscard]] std::array<VertexId, 3> facet_vertices(FacetId f) const {
    const auto& v = vertices(f.tet());
    const auto& slots = kFacetSlots[f.face()];
    return {v[slots[0]], v[slots[1]], v[slots[2]]};
  }
  // Prefetches t.
  void prefetch(TetId t) const { __builtin_prefetch(&tets_[t.index()]); }

 protected:
  Tetrahedralization() = default;
  // A view of another one, with room for new vertices and tetrahedra of its own.
  Tetrahedralization(Tetrahedralization& whole, const Range& vertices, const Range& tets)
      : points_(whole.points_, vertices), incident_(whole.incident_, vertices), tets_(whole.tets_, tets) {}

  // Half a cache line. A free slot has no vertex in slot 0.
  struct alignas(32) Tet {
    std::array<VertexId, 4> vertices;
    std::array<FacetId, 4> mirrors;  // across face i: the facet seen from the neighbour
  };

  SharedArray<Vec3> points_;     // point of each vertex
  SharedArray<TetId> incident_;  // a live tetrahedron at each vertex
  SharedArray<Tet> tets_;        // live and free slots
};

}  // namespace deliso

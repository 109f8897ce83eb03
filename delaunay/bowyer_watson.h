// Incremental Delaunay triangulation in space (Bowyer 1981, Watson 1981) with ghost tetrahedra and exact predicates.
//
// An insertion has two steps, so that a caller that keeps data on the tetrahedra can look before they go:
//   find_conflicts(p, t)   the conflict region of p, found from a tetrahedron in conflict or, failing that, by a walk;
//   fill_cavity()          replaces the region by the star of p.
//
// Ties. orient3d is zero exactly for coplanar points. A zero insphere is resolved by a symbolic perturbation of the
// lifted coordinate by vertex index (Devillers, Teillaud: Perturbations for Delaunay and weighted Delaunay 3D
// triangulations, 2011), which amounts to infinitesimal weights: the perturbed insphere is never zero, and a flat
// tetrahedron never appears. A point coplanar with a hull facet is in conflict with its ghost exactly when it is with
// the tetrahedron inside.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/base/box3.h"
#include "delaunay/rim_edges.h"
#include "delaunay/static_filter.h"
#include "delaunay/tetrahedralization.h"

namespace deliso {

class BowyerWatson : public Tetrahedralization {
 public:
  // All points to come lie in `box` (for the static filters); one outside throws InternalError.
  explicit BowyerWatson(const Box3& box);

  // Builds from scratch. Vertex i of the result is points[i] unless it duplicates an earlier point; vertex_of[i], when
  // asked for, tells the vertex of each input point. Inserts in BRIO + Hilbert order. Returns false and leaves the
  // triangulation empty when all points are coplanar (fewer than four included).
  bool build(std::span<const Vec3> points, std::vector<VertexId>* vertex_of = nullptr);

  // The tetrahedron (perhaps a ghost) that contains p, by a visibility walk from `hint` (any live tetrahedron).
  [[nodiscard]] TetId locate(const Vec3& p, TetId hint) const;
  // Whether p is in conflict with t (perturbed as if p were inserted next).
  [[nodiscard]] bool in_conflict(TetId t, const Vec3& p) const;

  // The conflict region of p. `start`: a live tetrahedron, best one in conflict with p; if it is not, a walk from it
  // finds one. Returns the vertex that p duplicates, if any; then there is no region.
  std::optional<VertexId> find_conflicts(const Vec3& p, TetId start);
  [[nodiscard]] std::span<const TetId> conflict_region() const { return region_; }
  // The facets around the region, each as the tetrahedron outside knows it.
  [[nodiscard]] std::span<const FacetId> rim() const { return rim_; }

  // Stars p over the rim. The new tetrahedra are created(): created()[i] has p in slot 0, and its face 0 is the mirror
  // of what was rim()[i]. Their ids may be those of destroyed tetrahedra.
  VertexId fill_cavity();
  [[nodiscard]] std::span<const TetId> created() const { return created_; }
  // Forgets the region instead.
  void abandon_cavity();

 private:
  // What the cavity search knows about a tetrahedron.
  enum Mark : std::uint8_t { kUnknown, kInside, kOutside };

  [[nodiscard]] bool conflicts(TetId t, const Vec3& p, VertexId p_id) const;
  void start(const std::array<VertexId, 4>& simplex);
  std::optional<VertexId> find_conflicts_from_located(const Vec3& p, VertexId p_id, TetId located);
  void grow_region(const Vec3& p, VertexId p_id, TetId first);
  void star_rim(VertexId apex);
  void clear();
  void drop_duplicates(std::vector<VertexId>& vertex_of);

  Box3 box_;
  StaticFilter filter_;
  std::vector<TetId> free_;         // free slots
  std::vector<std::uint8_t> mark_;  // Mark of each slot; all kUnknown between insertions
  std::vector<TetId> region_;
  std::vector<FacetId> rim_;
  std::vector<TetId> created_;
  RimEdges edges_;
  Vec3 pending_;  // the point of the open cavity
};

}  // namespace deliso

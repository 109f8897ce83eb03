// The trace of a run (`deliso-trace-1`): one JSON object for each event of an observer, from which every state of both
// stages can be rebuilt. Vertices are numbered in the order of the trace; the infinite vertex is -1.
//
//   initial   points, virtual (numbers of guards), tets, above (one character each), facets
//   insert    why, its measures, v, p, gone (the conflict region), above, facets
//   refuse    why, its measures, cause
//   compare   points, triangles, components, pieces, error: the mesh that repair has, and how its pieces match
//   sample    cells, levels: the voxel cells that a round of repair refines, and how fine each is before
//   mesh      points, poles, triangles, limits: what stage 2 begins with
//   refine    t, why, h, r, l, pole, v, p, gone (E), rim, closed
//   keep      t, cause: a coarse triangle whose refinement is refused for now; p and gone (E) where x_sigma was tried
//   restart   all changes since `mesh` are taken back
//   refined   vertices, triangles (counts), and the mesh itself after a restart
//   shape     the mesh after steps of another kind; why: "folds" where stage 2 has flipped edges across folds,
//             "angles" where it has moved vertices at its end, "rest" for the mesh that leaves the program after steps
//             that no event tells of
//   certify   what was found of the mesh that leaves the program, and the bounds
//
// New tetrahedra are not written: they are the star of v over the rim of what is gone. Their signs, `above`, stand in
// the order of the rim's facets, each sorted, all sorted. A facet is [a, b, c, [hits]]: its dual edge is new or
// changed; without hits it is gone. `rim` is a cycle, or for a point on the boundary a path.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "experiments/lesson/trace/repair_events.h"
#include "surface/base/observer.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/refine/refine_options.h"

namespace deliso {

using TraceSink = std::function<void(const TraceEvent&)>;

class TraceWriter : public Observer {
 public:
  explicit TraceWriter(TraceSink sink) : sink_(std::move(sink)) {}

  void triangulated(const RestrictedDelaunay& del_s) override;
  void violation(const RestrictedDelaunay& del_s, const ObservedViolation& violation) override;
  void cavity(const RestrictedDelaunay& del_s, const Vec3& p) override;
  void inserted(const RestrictedDelaunay& del_s) override;
  void refused(const RestrictedDelaunay& del_s, std::string_view cause) override;
  void renamed(std::span<const VertexId> renamed) override;
  void round_begins(const ObservedComparison& comparison, std::span<const std::uint64_t> cells) override;
  void round_ends(const ObservedComparison& comparison) override;
  void meshed(const SurfaceMesh& mesh, const Criteria& limits) override;
  void disk(const RefinementMesh& mesh, const RefinementDisk& e, const RefinementCandidate& candidate) override;
  void attempt_refused(const RefinementMesh& mesh, const RefinementDisk& e,
                       const RefinementCandidate& candidate) override;
  void disk_refused(const RefinementMesh& mesh, std::uint32_t triangle, std::string_view cause) override;
  void improved(const RefinementMesh& mesh, std::string_view why) override;
  void restarted() override;
  void refined(const RefinementMesh& mesh) override;
  void reshaped(const SurfaceMesh& mesh) override;
  void finished(const SurfaceMesh& mesh) override;
  void certified(const PromiseFigures& figures, const Promise& promise) override;

 private:
  [[nodiscard]] int number(VertexId v) const;
  [[nodiscard]] std::array<int, 4> corners(const RestrictedDelaunay& del_s, TetId t) const;
  [[nodiscard]] std::array<int, 3> corners(const RestrictedDelaunay& del_s, FacetId f) const;
  [[nodiscard]] TraceEvent facet(const DualEdge& edge) const;
  [[nodiscard]] TraceEvent changed_facets(const RestrictedDelaunay& del_s) const;
  [[nodiscard]] std::string signs_of_star(const RestrictedDelaunay& del_s) const;

  TraceSink sink_;
  std::vector<int> number_;  // of each vertex id of the triangulation, or -1
  int vertices_ = 0;
  TraceEvent pending_;              // what violation() and cavity() have told of the insertion under way
  std::vector<bool> rim_had_hits_;  // of rim()[i]
  Criteria limits_;                 // of stage 2
  SurfaceMesh told_;                // the latest mesh of stage 2 that an event has told of: points and triangles
  bool has_restarted_ = false;
  bool has_compared_ = false;  // the mesh that the next round begins with is written
};

}  // namespace deliso

// Recover of the paper (Dey and Levine, Figure 5) as one loop over a queue of violations, in a triangulation or a part
// of it. The paper runs four procedures in turn, each until its condition holds everywhere:
//
//   Del S = MultiIntersect(Del S)                        a dual edge meets the surface in one point at most
//   Del S = ExtractManifold(Del S)                       an umbrella is a disk
//   Del S = ApproximateGeom(Del S, epsilon, rho, r_min)  a triangle meets the criteria
//   Del S = ExtractManifold(Del S)
//
// A point that one of them inserts can break the condition of another, also of an earlier one. So all violations wait
// in one queue. The loop takes those of MultiIntersect first, then those of ExtractManifold, and those of
// ApproximateGeom only while there are no others; every insertion queues what it has changed. This is the paper's order
// with a return to an earlier line wherever its condition is broken again, and it ends where all conditions hold, but
// for the points that the size bound forbids.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/base/slab.h"
#include "surface/base/controls.h"
#include "surface/base/criteria.h"
#include "surface/recover/recover.h"
#include "surface/recover/violation_queue.h"
#include "surface/restricted/restricted_delaunay.h"
#include "surface/restricted/umbrella.h"

namespace deliso {

// A point to insert and where the search for its conflict region may begin.
struct RefinementPoint {
  Vec3 point;
  TetId start;
};

class RecoverLoop {
 public:
  // `pole_heights`: see recover(). Keeps references to all.
  RecoverLoop(RestrictedDelaunay& restricted, const RecoverOptions& options, RecoverStats& stats,
              std::vector<double>* pole_heights = nullptr)
      : restricted_(restricted),
        delaunay_(restricted.delaunay()),
        isosurface_(restricted.isosurface()),
        options_(options),
        stats_(stats),
        pole_heights_(pole_heights),
        umbrella_(restricted),
        queue_(options.order) {}

  // Looks for violations everywhere.
  void queue_everything();
  // Inserts points, and looks for the violations that this causes. Returns how many went in.
  std::int64_t insert_points(std::span<const Vec3> points, Controls& controls);
  // Until no violation is left that can be mended here, or there are `enough` vertices, or no room for another one.
  void run(Controls& controls, std::size_t enough = std::numeric_limits<std::size_t>::max());
  // The same on several threads, round after round, each in slabs of the volume that are refined apart from each other
  // (recover_slabs.cpp). What it leaves is for run(). The same for any number of threads.
  void run_in_slabs(Controls& controls);

 private:
  void treat(const Violation& violation);
  void queue_edge(DualEdgeId e);
  void queue_umbrella(VertexId q);
  void queue_touched();
  bool insert(const Violation& violation, const RefinementPoint& candidate);
  void tell_observer(const Violation& violation) const;
  void inherit_pole_height();

  // Figure 5: the point that each procedure inserts for a violation, if it still is one (refinement_points.cpp).
  [[nodiscard]] std::optional<RefinementPoint> multi_intersect(DualEdgeId e) const;
  std::optional<RefinementPoint> extract_manifold(VertexId q);
  [[nodiscard]] std::optional<RefinementPoint> approximate_geometry(DualEdgeId e) const;
  [[nodiscard]] RefinementPoint point_at(const DualEdge& edge, double t) const;
  [[nodiscard]] static double farthest_hit(const DualEdge& edge);
  bool is_disk(VertexId q);
  [[nodiscard]] std::optional<RefinementPoint> farthest_of_umbrella(VertexId q) const;
  std::optional<RefinementPoint> farthest_in_voronoi_cell(VertexId q);
  [[nodiscard]] std::optional<Vec3> onto_surface(const Vec3& p) const;
  [[nodiscard]] double geometric_badness(const DualEdge& edge) const;
  [[nodiscard]] bool is_below_size_bound(const TriangleMeasures& sigma) const;
  [[nodiscard]] double mean_pole_height(const DualEdge& edge) const;

  // Vertices on the faces of the volume's box.
  [[nodiscard]] std::size_t count_on_box() const;
  // A round of run_in_slabs(), with planes across an axis: returns how many were inserted.
  std::int64_t run_round(std::size_t axis, Controls& controls);
  [[nodiscard]] std::vector<Violation> take_waiting();
  [[nodiscard]] std::size_t most_insertions(std::span<const Violation> waiting) const;
  [[nodiscard]] std::vector<Slab> slabs_of(std::span<const Violation> waiting, std::size_t axis) const;
  [[nodiscard]] std::array<VertexId, 3> vertices_of(const Violation& violation) const;
  std::vector<Violation> hand_out(std::span<const Violation> waiting, std::span<const Slab> slabs,
                                  std::span<RecoverLoop> parts) const;
  void mend_blocked(std::span<const Violation> blocked, std::span<const VertexId> renamed, Controls& controls);
  void take_back(std::span<const Violation> left, std::span<const VertexId> renamed);

  RestrictedDelaunay& restricted_;
  const Tetrahedralization& delaunay_;
  const Isosurface& isosurface_;
  const RecoverOptions& options_;
  RecoverStats& stats_;
  std::vector<double>* pole_heights_;
  UmbrellaInspector umbrella_;
  ViolationQueue queue_;
  std::vector<Violation> blocked_;     // of a part: what only the whole can mend
  std::vector<bool> umbrella_queued_;  // of each vertex
  std::vector<Hit> hits_;
};

}  // namespace deliso

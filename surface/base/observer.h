// What happens step by step in the two stages, told to whoever watches: a lesson, a trace, a test. The pipeline runs
// with and without an observer alike, to the same bytes; without one, a step costs a comparison with null.
//
// Stage 1 tells of a triangulation that exists only until the next step, so an observer reads what it needs at once.
// With an observer the parts of stage 1 (recover_slabs.cpp) run one after the other. Stage 2 tells of single steps only
// where it works in the whole mesh: where slabs would begin (refinement_slabs.h) it throws InputError.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "delaunay/base/vec3.h"
#include "delaunay/ids.h"

namespace deliso {

struct Criteria;
struct DualEdge;
struct IsosurfaceTopology;
struct MatchedMesh;
struct Promise;
struct PromiseFigures;
struct RefinementCandidate;
struct RefinementMesh;
struct SurfaceMesh;
class CellLevels;
class RefinementDisk;
class RestrictedDelaunay;

// The steps of Recover (Dey and Levine, Figure 5), and ours after it: kCoverage inserts samples of parts of the
// isosurface that the mesh misses.
enum class RecoverStep : std::uint8_t { kMultiIntersect, kExtractManifold, kApproximateGeometry, kCoverage };

// Why a point is about to be inserted.
struct ObservedViolation {
  RecoverStep step = RecoverStep::kCoverage;
  const DualEdge* sigma = nullptr;     // of kMultiIntersect and kApproximateGeometry
  VertexId umbrella = {};              // of kExtractManifold: q; else none
  std::span<const FacetId> disk = {};  // D_q, seen from the tetrahedra above the isovalue
  const Criteria* limits = nullptr;
};

// What repair compares before and after a round: a mesh of the whole isosurface with the exact topology.
struct ObservedComparison {
  const MatchedMesh& mesh;  // and how its pieces match the components
  const IsosurfaceTopology& topology;
  const std::vector<bool>& done;  // of each exact component: some mesh so far has it right
  const CellLevels& levels;       // of the cells that are sampled by a lattice
};

class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  // Del S0, after InitTriangulation.
  virtual void triangulated(const RestrictedDelaunay& /*del_s*/) {}
  // One of Recover's conditions does not hold; the next call is cavity() or refused().
  virtual void violation(const RestrictedDelaunay& /*del_s*/, const ObservedViolation& /*violation*/) {}
  // The conflict region of p is found and not yet destroyed.
  virtual void cavity(const RestrictedDelaunay& /*del_s*/, const Vec3& /*p*/) {}
  // p is in; created() is its star, touched_edges() the dual edges that changed.
  virtual void inserted(const RestrictedDelaunay& /*del_s*/) {}
  // The point is nearer to a vertex than the size bound allows, or off the isosurface, or it waits for another part.
  virtual void refused(const RestrictedDelaunay& /*del_s*/, std::string_view /*cause*/) {}
  // Vertices got new numbers after parts have joined: that of each old one.
  virtual void renamed(std::span<const VertexId> /*renamed*/) {}

  // A round of repair begins: it refines these voxel cells (CellLevels::cell() tells where they are).
  virtual void round_begins(const ObservedComparison& /*comparison*/, std::span<const std::uint64_t> /*cells*/) {}
  virtual void round_ends(const ObservedComparison& /*comparison*/) {}

  // The mesh that RefineGeom begins with, with pole heights.
  virtual void meshed(const SurfaceMesh& /*mesh*/, const Criteria& /*limits*/) {}
  // E is about to be replaced by the star of the candidate's point, the next vertex.
  virtual void disk(const RefinementMesh& /*mesh*/, const RefinementDisk& /*e*/,
                    const RefinementCandidate& /*candidate*/) {}
  // x_sigma of a coarse triangle is refused, with this disk E; another point may be tried before disk_refused().
  virtual void attempt_refused(const RefinementMesh& /*mesh*/, const RefinementDisk& /*e*/,
                               const RefinementCandidate& /*candidate*/) {}
  // A coarse triangle stays as it is for now, for a cause of kRefusalNames.
  virtual void disk_refused(const RefinementMesh& /*mesh*/, std::uint32_t /*triangle*/, std::string_view /*cause*/) {}
  // Without insertions "folds": edges that lay across folds are flipped (stage2.h_min), insertions may follow; or
  // "angles": vertices are moved to where the angles around them are larger (shape.smoothing).
  virtual void improved(const RefinementMesh& /*mesh*/, std::string_view /*why*/) {}
  // All changes since meshed() are taken back.
  virtual void restarted() {}
  // RefineGeom has ended with this mesh.
  virtual void refined(const RefinementMesh& /*mesh*/) {}
  // The mesh of stage 2 after steps of another kind: those of the stage `shape`.
  virtual void reshaped(const SurfaceMesh& /*mesh*/) {}
  // The mesh that leaves the program, perhaps after steps that nothing tells of: those that bring it nearer, those of
  // stated sizes, components left out.
  virtual void finished(const SurfaceMesh& /*mesh*/) {}
  // What was found of the mesh that leaves the program, and what it has to keep.
  virtual void certified(const PromiseFigures& /*figures*/, const Promise& /*promise*/) {}
};

}  // namespace deliso

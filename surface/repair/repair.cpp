#include "surface/repair/repair.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "surface/intersection/self_intersection.h"
#include "surface/repair/finish/foreign_vertices.h"
#include "surface/repair/finish/inverted_umbrellas.h"
#include "surface/repair/finish/marching_cubes_fallback.h"
#include "surface/repair/rounds/component_selection.h"
#include "surface/repair/rounds/rounds.h"

namespace deliso {

Repair::Repair(const ExactSurfaceCache& cache, std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds,
               const RoundsOptions& options, Controls& controls, RepairStats& stats)
    : cache_(cache),
      surface_(cache.surface()),
      max_rounds_(max_rounds),
      nearness_(options.nearness),
      controls_(controls),
      stats_(stats),
      rounds_(cache, std::move(restricted), stats, options) {}

void Repair::mend_topology() {
  is_unrepaired_ = controls_.stopped();
  if (is_unrepaired_) return;
  is_assembled_ = rounds_.mend(
      max_rounds_, [this] { return ends_without_foreign_vertices(); }, controls_);
}

void Repair::compute_poles() {
  if (!is_unrepaired_ && !is_assembled_) rounds_.give_poles();
}

// Assembles the components, each from the latest mesh that agrees with it, so that most come from one triangulation.
// Stray pieces are dropped. A run that was stopped takes the mesh of stage 1 unchanged.
SurfaceMesh Repair::build_triangle_mesh() {
  if (is_unrepaired_) return rounds_.unrepaired_mesh();
  rounds_.end();
  if (!is_assembled_ && !assemble()) polygonize_rest();
  return std::exchange(result_.mesh, {});
}

void Repair::mend(SurfaceMesh& mesh) {
  if (is_unrepaired_) return;
  result_.mesh = std::move(mesh);
  mend_vertices();
  // A piece with foreign vertices may lie on the whole of another component, or have most of its vertices there.
  const bool may_be_misplaced = stats_.components_mixed > 0 && !controls_.poll();
  if (may_be_misplaced && polygonize_misplaced_pieces(result_.mesh, cache_, nearness_, is_polygonized_)) is_crossing_free_ = false;
  if (!is_crossing_free_) polygonize_crossing_pieces(result_.mesh, cache_, nearness_, is_polygonized_, controls_);
  stats_.components_polygonized = std::count(is_polygonized_.begin(), is_polygonized_.end(), true);
  stats_.vertices_after = static_cast<std::int64_t>(result_.mesh.points.size());
  mesh = std::move(result_.mesh);
}

// Removes foreign vertices and inverted umbrellas.
void Repair::mend_vertices() {
  if (!is_assembled_ && stats_.components_mixed > 0 && !controls_.poll()) take_foreign_vertices_out();
  if (controls_.poll()) return;
  stats_.inverted_umbrellas_removed = remove_inverted_umbrellas(result_.mesh, surface_.isosurface, surface_.threads);
}

// Whether foreign vertices are the only remaining defect and can be removed.
bool Repair::ends_without_foreign_vertices() {
  if (!rounds_.is_done_but_for_mixing()) return false;
  timed(inner_poles_, [this] { rounds_.give_poles(); });
  const bool is_whole = timed(inner_build_, [this] { return assemble(); });
  if (is_whole && take_foreign_vertices_out()) return true;
  result_ = {};
  is_crossing_free_ = false;
  stats_.foreign_vertices_removed = 0;
  return false;
}

// Assembles the components, each from the latest mesh that agrees with it, those given up from marching cubes. Returns
// whether these are all that have no such mesh; otherwise the others are missing, too.
bool Repair::assemble() {
  result_ = rounds_.selection().assemble(is_polygonized_, surface_.isosurface, surface_.threads, stats_);
  for (std::size_t c = 0; c < is_polygonized_.size(); ++c) {
    if (is_polygonized_[c] && !rounds_.selection().given_up()[c]) return false;
  }
  polygonize_rest();
  return true;
}

// Takes the components that have no mesh from marching cubes.
void Repair::polygonize_rest() {
  if (std::find(is_polygonized_.begin(), is_polygonized_.end(), true) == is_polygonized_.end()) return;
  append_cubes(cache_, is_polygonized_, nearness_, result_.mesh, &result_.component);
}

// Removes foreign vertices, unless the removal itself makes triangles cross. Returns whether no foreign vertex is left
// and no triangles cross.
bool Repair::take_foreign_vertices_out() {
  const auto crosses = [&](const SurfaceMesh& mesh) {
    return self_intersections(mesh.points, mesh.triangles, 0, surface_.threads).crossing_pairs > 0;
  };
  SurfaceMesh without = result_.mesh;
  const auto [removed, left] = remove_foreign_vertices(without, result_.component);
  if (removed == 0 && left > 0) return false;
  is_crossing_free_ = !crosses(without);
  if (removed == 0) return is_crossing_free_;
  if (!is_crossing_free_ && !crosses(result_.mesh)) {
    is_crossing_free_ = true;  // the mesh before the removal
    return false;
  }
  stats_.foreign_vertices_removed = removed;
  result_ = {std::move(without), {}};
  return left == 0 && is_crossing_free_;
}

}  // namespace deliso

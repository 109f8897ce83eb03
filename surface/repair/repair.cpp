#include "surface/repair/repair.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "surface/intersection/self_intersection.h"
#include "surface/repair/finish/foreign_vertices.h"
#include "surface/repair/finish/inverted_umbrellas.h"
#include "surface/repair/finish/marching_cubes_fallback.h"
#include "surface/repair/finish/missed_crossings.h"
#include "surface/repair/rounds/component_selection.h"
#include "surface/repair/rounds/rounds.h"

namespace deliso {

namespace {

// How often further rounds are started because crossings are missed, or triangles cross, although the topology is
// right.
constexpr int kMostReopenings = 2;
// Further rounds sample around at most this many pairs of crossing triangles.
constexpr std::size_t kMostPairs = 256;

}  // namespace

Repair::Repair(const ExactSurfaceCache& cache, std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds,
               const RoundsOptions& options, Controls& controls, RepairStats& stats)
    : cache_(cache),
      surface_(cache.surface()),
      max_rounds_(max_rounds),
      controls_(controls),
      stats_(stats),
      rounds_(cache, std::move(restricted), stats, options) {}

void Repair::mend_topology() {
  is_unrepaired_ = controls_.stopped();
  if (!is_unrepaired_) mend_by_rounds();
}

void Repair::compute_poles() {
  if (!is_unrepaired_ && !is_assembled_) rounds_.give_poles();
}

// Assembles the components, each from the latest mesh that agrees with it, so that most come from one triangulation.
// Stray pieces are dropped. A run that was stopped takes the mesh of stage 1 unchanged.
SurfaceMesh Repair::build_triangle_mesh() {
  if (is_unrepaired_) return rounds_.unrepaired_mesh();
  build();
  return std::exchange(result_.mesh, {});
}

void Repair::mend(SurfaceMesh& mesh) {
  if (is_unrepaired_) return;
  result_.mesh = std::move(mesh);
  mend_vertices();
  mend_crossing();
  mend_missed_crossings();
  rounds_.end();
  // A piece with foreign vertices may lie on the whole of another component, or have most of its vertices there.
  const bool may_be_misplaced = stats_.components_mixed > 0 && !controls_.poll();
  if (may_be_misplaced && polygonize_misplaced_pieces(result_.mesh, cache_, is_polygonized_)) is_crossing_free_ = false;
  if (!is_crossing_free_) polygonize_crossing_pieces(result_.mesh, cache_, is_polygonized_, controls_);
  stats_.components_polygonized = std::count(is_polygonized_.begin(), is_polygonized_.end(), true);
  stats_.vertices_after = static_cast<std::int64_t>(result_.mesh.points.size());
  mesh = std::move(result_.mesh);
}

// Makes rounds until every component is done, or only foreign vertices are left and can be removed.
void Repair::mend_by_rounds() {
  is_assembled_ = rounds_.mend(
      max_rounds_, [this] { return ends_without_foreign_vertices(); }, controls_);
}

// Assembles the mesh of the rounds so far. The triangulation is kept if another round may follow.
void Repair::build() {
  if (is_assembled_) return;
  if (!rounds_.is_done() || !rounds_.may_go_on(max_rounds_) || controls_.poll()) rounds_.end();
  if (!assemble()) polygonize_rest();
}

// Removes foreign vertices and inverted umbrellas.
void Repair::mend_vertices() {
  if (!is_assembled_ && stats_.components_mixed > 0 && !controls_.poll()) take_foreign_vertices_out();
  stats_.inverted_umbrellas_removed = 0;
  if (controls_.poll()) return;
  auto [removed, left] = remove_inverted_umbrellas(result_.mesh, surface_.isosurface, surface_.threads);
  stats_.inverted_umbrellas_removed = removed;
  inverted_ = std::move(left);
}

SelfIntersections Repair::crossing_triangles() const {
  return self_intersections(result_.mesh.points, result_.mesh.triangles, kMostPairs, surface_.threads);
}

std::vector<std::uint32_t> Repair::missed(std::span<const Box3> boxes) const {
  return missed_crossings(result_.mesh, boxes, surface_);
}

// Further rounds if the topology is right but triangles cross. If they do not help, the state before them is restored.
void Repair::mend_crossing() {
  if (is_crossing_free_ || !rounds_.may_go_on(max_rounds_) || controls_.poll()) return;
  SelfIntersections found = crossing_triangles();
  is_crossing_free_ = found.crossing_pairs == 0;
  for (int i = 0; i < kMostReopenings && rounds_.may_go_on(max_rounds_) && !controls_.poll(); ++i) {
    const std::vector<std::uint32_t> crossings = rounds_.crossings_at(found.crossing, result_.mesh);
    if (crossings.empty()) return;
    std::optional<State> before = mend_around(crossings);
    if (!before) return;
    if (is_crossing_free_) return;
    SelfIntersections left = crossing_triangles();
    if (left.crossing_pairs >= found.crossing_pairs) return restore(*std::move(before));
    found = std::move(left);
    is_crossing_free_ = found.crossing_pairs == 0;
  }
}

// Further rounds if the topology is right but the mesh misses crossings. If they do not help, the state before them is
// restored.
void Repair::mend_missed_crossings() {
  for (int i = 0; i < kMostReopenings && rounds_.may_go_on(max_rounds_) && !controls_.poll(); ++i) {
    const std::vector<std::uint32_t> crossings = missed(inverted_);
    if (crossings.empty()) return;
    std::optional<State> before = mend_around(crossings);
    if (!before) return;
    // Boxes around the inverted umbrellas before and after these rounds.
    std::vector<Box3> boxes = before->inverted;
    boxes.insert(boxes.end(), inverted_.begin(), inverted_.end());
    if (missed(boxes).size() >= crossings.size()) return restore(*std::move(before));
  }
}

// Makes rounds that begin with new samples around some crossings. If they lead to a mesh with the right topology,
// returns the state before them; otherwise restores that state and returns nothing.
std::optional<Repair::State> Repair::mend_around(std::span<const std::uint32_t> crossings) {
  State before = take_state();
  rounds_.mend_around(crossings, controls_);
  mend_by_rounds();
  const bool is_done = is_assembled_ || rounds_.is_done();
  if (is_done) {
    timed(inner_poles_, [this] { compute_poles(); });
    timed(inner_build_, [this] { build(); });
    mend_vertices();
  }
  if (is_done && !controls_.poll() && polygonizes_no_more_than(before.is_polygonized)) return before;
  restore(std::move(before));
  return std::nullopt;
}

// Whether all components from marching cubes have been so before, or are given up: these have the right topology and
// miss nothing of their own.
bool Repair::polygonizes_no_more_than(const std::vector<bool>& before) const {
  const std::vector<bool>& given_up = rounds_.selection().given_up();
  for (std::size_t c = 0; c < is_polygonized_.size(); ++c) {
    if (is_polygonized_[c] && !before[c] && !given_up[c]) return false;
  }
  return true;
}

Repair::State Repair::take_state() {
  State state{std::exchange(result_, {}), is_polygonized_, std::exchange(inverted_, {}),
              std::exchange(is_crossing_free_, false), stats_};
  stats_.foreign_vertices_removed = stats_.inverted_umbrellas_removed = 0;
  return state;
}

void Repair::restore(State state) {
  const std::int64_t rounds = stats_.rounds;
  result_ = std::move(state.result);
  is_polygonized_ = std::move(state.is_polygonized);
  inverted_ = std::move(state.inverted);
  is_crossing_free_ = state.is_crossing_free;
  stats_ = state.stats;
  stats_.rounds = rounds;
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
  const auto& [polygonized, component] = cache_.polygonized();
  append_pieces(polygonized, component, is_polygonized_, result_.mesh);
  std::copy_if(component.begin(), component.end(), std::back_inserter(result_.component),
               [&](std::uint32_t c) { return c < is_polygonized_.size() && is_polygonized_[c]; });
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

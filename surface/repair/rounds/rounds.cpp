#include "surface/repair/rounds/rounds.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "delaunay/base/memory.h"
#include "delaunay/base/parallel.h"
#include "surface/base/observer.h"
#include "surface/extract/edge_positions.h"
#include "surface/extract/pinch_separation.h"
#include "surface/repair/diagnosis/defect_cells.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/restricted/poles.h"

namespace deliso {

namespace {

// The boxes found by Euler curves are ignored if there are more than kMostBoxes of them; in the first round, where
// other defects are more reliable, if there are more than kFewBoxes.
constexpr std::size_t kFewBoxes = 30;
constexpr std::size_t kMostBoxes = 512;

// Normally only defects near the boxes found by Euler curves count. These boxes may be wrong, and then repair would
// never succeed. So in this round all defects count. In more than one such round there would be too many samples. From
// this round on angle defects are compared, too.
constexpr std::int32_t kRoundOfAllDefects = 3;

// So many more for a component whose best mesh has a handle in a wrong place. Most are mended by the first; those that
// are not lose it and find it again, with half as many samples more each time (a CT head at the skin).
constexpr std::uint8_t kRoundsDisplaced = 2;

}  // namespace

RepairRounds::RepairRounds(const ExactSurfaceCache& cache, std::unique_ptr<SignedDelaunay> restricted,
                           RepairStats& stats, const RoundsOptions& options)
    : surface_(cache.surface()),
      stats_(stats),
      lattice_(surface_),
      cell_levels_(surface_.isosurface),
      round_(std::in_place, surface_, cell_levels_, std::move(restricted)),
      samples_(round_->restricted(), options.fixed),
      kept_(surface_.topology.components.size()),
      rounds_displaced_(surface_.topology.components.size(), 0),
      differences_(cache),
      max_distance_(options.max_distance) {
  if (options.may_give_up) budget_.emplace(surface_);
  round_->take_plain_signs();
  take_mesh();
  stats_.vertices_before = static_cast<std::int64_t>(mesh_->built.mesh.points.size());
  stats_.components_before = std::count_if(mesh_->match.agreement.begin(), mesh_->match.agreement.end(),
                                           [](Agreement a) { return a != Agreement::kExact; });
}

bool RepairRounds::mend(std::int32_t max_rounds, const std::function<bool()>& ends, Controls& controls) {
  while (stats_.rounds < max_rounds && !controls.poll()) {
    give_up();
    if (kept_.is_done()) break;
    if (ends()) return true;
    controls.report("repair", samples_.size(), static_cast<std::size_t>(mesh_->match.error));
    const std::int64_t round = stats_.rounds + 1;
    const std::vector<IndexRanges> boxes = differing_boxes(round);
    mend_once(defect_cells({surface_, round_->restricted(), *mesh_, cell_levels_, round_->component_of_vertex(),
                            kept_.done(), boxes, round != kRoundOfAllDefects}),
              controls);
  }
  return false;
}

// Gives up the components whose samples are many more than their crossings. Not those that have a displaced mesh: these
// are rare, and mended by few samples more, or else their mesh is taken after a few rounds.
void RepairRounds::give_up() {
  std::vector<bool> is_spared = kept_.done();
  for (std::uint32_t c = 0; c < is_spared.size(); ++c) {
    if (is_spared[c] || kept_.best(c) != Agreement::kDisplaced) continue;
    is_spared[c] = true;
    if (rounds_displaced_[c]++ == kRoundsDisplaced) kept_.give_up(c);
  }
  if (!budget_) return;
  const std::vector<std::uint32_t> over = budget_->spend(round_->component_of_vertex(), is_spared);
  for (const std::uint32_t c : over) kept_.give_up(c);
  stats_.components_given_up += std::ssize(over);
}

// Of each exact component: where its main piece differs.
std::vector<IndexRanges> RepairRounds::differing_boxes(std::int64_t round) {
  std::vector<bool> settled = kept_.done();
  for (const SpanningTriangle& t : spanning_) settled[t.component] = true;
  std::vector<IndexRanges> boxes =
      differences_.find(mesh_, settled, {round == 1 ? kFewBoxes : kMostBoxes, round >= kRoundOfAllDefects});
  for (const SpanningTriangle& t : spanning_) {
    boxes[t.component].all.push_back(t.box);
    boxes[t.component].likely.push_back(t.box);
  }
  return boxes;
}

// Makes a round in which these cells are refined.
void RepairRounds::mend_once(std::vector<CellName> cells, Controls& controls) {
  Observer* const observer = controls.observer();
  if (observer != nullptr) observer->round_begins({*mesh_, surface_.topology, kept_.done(), cell_levels_}, cells);
  cell_levels_.refine(std::move(cells));
  stats_.cells_refined = static_cast<std::int64_t>(cell_levels_.levels().size());
  resample();
  release_free_memory();
  round_->take_signs();
  take_mesh();
  release_free_memory();
  ++stats_.rounds;
  if (observer != nullptr) observer->round_ends({*mesh_, surface_.topology, kept_.done(), cell_levels_});
}

// The latest mesh with its pinches separated, and the pole heights for the present samples.
SurfaceMesh RepairRounds::unrepaired_mesh() {
  BuiltMesh built = mesh_->built;
  find_other_positions(built.groups, surface_.isosurface);
  separate_pinches(built.mesh, built.groups, built.vertex_of, surface_.isosurface.box(),
                   surface_.isosurface.surface_box());
  const std::vector<double> heights = compute_poles(round_->restricted(), PoleHeight::kNearer);
  for (const VertexId v : built.vertex_of) built.mesh.pole_heights.push_back(heights[v.index()]);
  stats_.vertices_after = static_cast<std::int64_t>(built.mesh.points.size());
  return std::move(built.mesh);
}

// Exchanges samples. If few change, they are exchanged in the present triangulation; otherwise a new one is built. With
// several threads the new one is built while the pole heights of the present one are computed.
void RepairRounds::resample() {
  const Resampling resampling = samples_.resampling(cell_levels_, lattice_, surface_.isosurface);
  const bool is_continued = samples_.changes_few(resampling);
  if (is_continued || surface_.threads == 1) kept_.give_poles(*round_);
  ExchangedPoints exchanged;
  if (is_continued && round_->exchange(resampling.leaving, resampling.coming_points(), exchanged)) {
    samples_.exchange(resampling, exchanged.vertex_of);
    return;
  }
  samples_.replace(resampling);
  if (is_continued || surface_.threads == 1) round_.reset();
  std::vector<VertexId> vertex_of;
  std::unique_ptr<SignedDelaunay> next;
  run_tasks(2, surface_.threads, [&](std::size_t task) {
    if (task == 0)
      next = std::make_unique<SignedDelaunay>(surface_.isosurface, samples_.points(), surface_.threads, &vertex_of);
    if (task == 1 && round_) kept_.give_poles(*round_);
  });
  round_.emplace(surface_, cell_levels_, std::move(next));
  samples_.take_vertices(vertex_of);
}

// Assembles the mesh for the present signs, and keeps it if it improves some component.
void RepairRounds::take_mesh() {
  mesh_ = std::make_shared<MatchedMesh>(round_->assemble());
  spanning_ = spanning_triangles(*mesh_, surface_, kept_.done(), max_distance_);
  std::vector<bool> settled = kept_.done();
  for (const SpanningTriangle& t : spanning_) {
    if (settled[t.component]) continue;
    settled[t.component] = true;
    mesh_->match.agreement[t.component] = Agreement::kDisplaced;
    ++mesh_->match.error;
  }
  differences_.find_displaced(*mesh_, settled, kFewBoxes);
  kept_.keep(mesh_, round_->restricted().signs());
}

}  // namespace deliso

#include "surface/repair.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "delaunay/base/memory.h"
#include "delaunay/base/parallel.h"
#include "surface/crossing_pieces.h"
#include "surface/dents.h"
#include "surface/intruders.h"
#include "surface/kept_meshes.h"
#include "surface/mesh_differences.h"
#include "surface/poles.h"
#include "surface/raised_cells.h"
#include "surface/repair_round.h"
#include "surface/repair_samples.h"
#include "surface/sample_lattice.h"
#include "surface/self_intersection.h"
#include "surface/separate_copies.h"
#include "surface/sign_rules.h"
#include "surface/sign_trials.h"
#include "surface/trouble.h"

namespace deliso {

namespace {

// What sweeps find counts unless it is more than kMostPlaces; in the first round, when other signs tell more, unless it
// is more than kFewPlaces.
constexpr std::size_t kFewPlaces = 30;
constexpr std::size_t kMostPlaces = 512;

// Sweeps may err, and then nothing would ever be mended if no trouble counted but near what they find. In one round all
// of it counts; in several the samples would grow too many. From then on curvature tells what sweeps do not.
constexpr std::int32_t kRoundOfAllTrouble = 3;

class Repair {
 public:
  Repair(const SurfaceFacts& facts, std::unique_ptr<SignedDelaunay> restricted, int threads, RepairStats& stats)
      : facts_(facts),
        grid_(facts.grid()),
        isosurface_(restricted->isosurface()),
        topology_(facts.topology()),
        threads_(threads),
        stats_(stats),
        lattice_(grid_, isosurface_.isovalue(), topology_),
        raised_(grid_, isosurface_),
        round_(std::in_place, grid_, topology_, raised_, std::move(restricted), threads),
        samples_(round_->restricted()),
        kept_(topology_.components.size()),
        differences_(facts, isosurface_) {}

  SurfaceMesh run(std::int32_t max_rounds, Controls& controls);

 private:
  void mend(std::int32_t max_rounds, Controls& controls);
  SurfaceMesh as_it_is();
  void resample();
  bool try_rule(SignRule rule);
  bool take(RepairRound::Attempt& attempt);
  void try_rules(Controls& controls);
  void try_signs(Controls& controls);
  const std::vector<Places>& places_of_difference(std::size_t most, bool takes_curvature) {
    return differences_.find(mesh_, kept_.done(), {most, takes_curvature});
  }
  bool ends_without_intruders();
  bool assemble_kept();
  void polygonize_rest();
  bool take_intruders_out();

  const SurfaceFacts& facts_;
  const ScalarGrid& grid_;
  const Isosurface& isosurface_;
  const IsosurfaceTopology& topology_;
  int threads_;
  RepairStats& stats_;
  SampleLattice lattice_;
  RaisedCells raised_;
  std::optional<RepairRound> round_;
  RepairSamples samples_;              // its vertices
  std::shared_ptr<MatchedMesh> mesh_;  // the latest
  KeptMeshes kept_;
  AssembledMesh result_;              // at last
  std::vector<bool> is_polygonized_;  // of each component in it
  MeshDifferences differences_;
};

SurfaceMesh Repair::run(std::int32_t max_rounds, Controls& controls) {
  round_->take_plain_signs();
  mesh_ = std::make_shared<MatchedMesh>(round_->assemble().value());
  stats_.vertices_before = static_cast<std::int64_t>(mesh_->built.mesh.points.size());
  stats_.components_before = std::count_if(mesh_->match.agreement.begin(), mesh_->match.agreement.end(),
                                           [](Agreement a) { return a != Agreement::kExact; });
  if (controls.stopped()) return as_it_is();
  kept_.keep(mesh_, round_->restricted().signs());
  mend(max_rounds, controls);
  mesh_.reset();
  round_.reset();
  SurfaceMesh& mesh = result_.mesh;
  if (!controls.poll()) stats_.dents_removed = remove_dents(mesh, isosurface_);
  polygonize_crossing_pieces(mesh, facts_, isosurface_, is_polygonized_, threads_, controls);
  stats_.components_polygonized = std::count(is_polygonized_.begin(), is_polygonized_.end(), true);
  stats_.vertices_after = static_cast<std::int64_t>(mesh.points.size());
  return std::move(mesh);
}

// Rounds until every component is done, or nothing is left but what taking vertices out mends.
void Repair::mend(std::int32_t max_rounds, Controls& controls) {
  for (std::int32_t round = 1; round <= max_rounds && !kept_.is_done() && !controls.poll(); ++round) {
    if (ends_without_intruders()) return;
    controls.report("repair", samples_.size(), static_cast<std::size_t>(mesh_->match.error));
    raised_.raise(cells_in_trouble(
        {grid_, topology_, round_->restricted(), *mesh_, raised_, round_->component_of_vertex(), kept_.done(),
         places_of_difference(round == 1 ? kFewPlaces : kMostPlaces, round >= kRoundOfAllTrouble),
         round != kRoundOfAllTrouble, round_->evidence(), round_->located(facts_.critical_places()), threads_}));
    if (round == 1 && try_rule(SignRule::kCircumcenter)) break;  // new signs may do without new samples
    resample();
    release_free_memory();
    try_rules(controls);
    release_free_memory();
    try_signs(controls);
    stats_.rounds = round;
  }
  kept_.give_poles(*round_);
  mesh_.reset();
  round_.reset();
  if (!assemble_kept()) polygonize_rest();
  if (stats_.components_mixed > 0 && !controls.poll()) take_intruders_out();
}

// The first mesh, right or not, of a run that had to end before.
SurfaceMesh Repair::as_it_is() {
  BuiltMesh built = mesh_->built;
  separate_copies(built.mesh, built.groups, built.vertex_of, isosurface_.box());
  const std::vector<double> heights = compute_poles(round_->restricted(), PoleHeight::kNearer);
  for (const VertexId v : built.vertex_of) built.mesh.pole_heights.push_back(heights[v.index()]);
  stats_.vertices_after = static_cast<std::int64_t>(built.mesh.points.size());
  return std::move(built.mesh);
}

// Exchanges samples: in the triangulation as it is when few change, else in one made anew, before the present one goes
// where there are threads for both.
void Repair::resample() {
  const Resampling resampling = samples_.resampling(raised_, lattice_, isosurface_);
  const bool is_continued = samples_.changes_few(resampling);
  if (is_continued || threads_ == 1) kept_.give_poles(*round_);
  ExchangedPoints exchanged;
  const bool keeps_signs = stats_.rounds > 0;  // nobody has tried to mend those of stage 1
  if (is_continued && round_->exchange(resampling.leaving, resampling.coming_points(), keeps_signs, exchanged)) {
    samples_.exchange(resampling, exchanged.vertex_of);
    return;
  }
  samples_.replace(resampling);
  if (is_continued || threads_ == 1) round_.reset();
  std::vector<VertexId> vertex_of;
  std::unique_ptr<SignedDelaunay> next;
  run_tasks(2, threads_, [&](std::size_t task) {
    if (task == 0) next = std::make_unique<SignedDelaunay>(isosurface_, samples_.points(), threads_, &vertex_of);
    if (task == 1 && round_) kept_.give_poles(*round_);
  });
  round_.emplace(grid_, topology_, raised_, std::move(next), threads_);
  samples_.take_vertices(vertex_of);
}

// Takes signs by a rule and keeps the mesh if it helps; true when no component is left.
bool Repair::try_rule(SignRule rule) {
  return take(round_->attempts(std::span(&rule, 1), [](const MatchedMesh&) { return true; }).front());
}

bool Repair::take(RepairRound::Attempt& attempt) {
  if (!attempt.mesh) return false;
  mesh_ = std::make_shared<MatchedMesh>(*std::move(attempt.mesh));
  kept_.keep(mesh_, attempt.signs);
  return kept_.is_done();
}

// One rule after another until every component is done; the mesh with the smallest error stays.
void Repair::try_rules(Controls& controls) {
  std::shared_ptr<MatchedMesh> best;
  TetSigns signs;
  const std::span<const SignRule> rules = round_->rules();
  const std::size_t at_once = threads_ > 1 ? rules.size() : 1;
  bool is_over = false;
  for (std::size_t first = 0; first < rules.size() && !is_over; first += at_once) {
    for (RepairRound::Attempt& attempt :
         round_->attempts(rules.subspan(first, at_once), [&](const auto& m) { return kept_.would_be_done(m); })) {
      if (take(attempt)) return;
      is_over = controls.poll();
      if (!best || mesh_->match.error < best->match.error) {
        best = mesh_;
        signs = std::move(attempt.signs);
      }
      mesh_ = best;  // no other is needed any more
      if (is_over) break;
    }
  }
  round_->set_signs(signs);
}

// Single signs near the places where a component is wrong.
void Repair::try_signs(Controls& controls) {
  if (kept_.is_done() || controls.poll()) return;
  const std::vector<Places> places = places_of_difference(kMostPlaces, stats_.rounds + 1 >= kRoundOfAllTrouble);
  std::optional<SignTrials> trials;
  for (std::uint32_t c = 0; c < places.size(); ++c) {
    if (kept_.done()[c] || places[c].all.empty()) continue;
    if (!trials) trials.emplace(*round_, topology_, raised_, round_->rules(), places);
    const auto improved = [&](std::shared_ptr<MatchedMesh> mesh) {
      mesh_ = std::move(mesh);
      kept_.keep(mesh_, round_->restricted().signs());
      return static_cast<bool>(kept_.done()[c]);
    };
    trials->mend(c, mesh_, improved, controls);
  }
}

// Whether nothing is wrong any more but that components have vertices of others, and these can be taken out.
bool Repair::ends_without_intruders() {
  if (!kept_.is_done_but_for_mixing()) return false;
  kept_.give_poles(*round_);
  if (assemble_kept() && take_intruders_out()) return true;
  result_ = {};
  stats_.intruders_removed = 0;
  return false;
}

// Every component as the latest mesh that agrees with it has it, so that most come from one triangulation; strays are
// dropped. Whether that is all of them.
bool Repair::assemble_kept() {
  result_ = kept_.assemble(is_polygonized_, isosurface_.box(), threads_, stats_);
  return std::find(is_polygonized_.begin(), is_polygonized_.end(), true) == is_polygonized_.end();
}

void Repair::polygonize_rest() {
  const auto& [polygonized, component] = facts_.polygonized();
  append_pieces(polygonized, component, is_polygonized_, result_.mesh);
  std::copy_if(component.begin(), component.end(), std::back_inserter(result_.component),
               [&](std::uint32_t c) { return c < is_polygonized_.size() && is_polygonized_[c]; });
}

// What components taken with vertices of others have of them; unless that is what makes triangles cross. Whether none
// is left and nothing crosses.
bool Repair::take_intruders_out() {
  const auto crosses = [&](const SurfaceMesh& mesh) {
    return self_intersections(mesh.points, mesh.triangles, 0, threads_).crossing_pairs > 0;
  };
  SurfaceMesh without = result_.mesh;
  const auto [removed, left] = remove_intruders(without, result_.component);
  if (removed == 0) return left == 0 && !crosses(result_.mesh);
  const bool is_crossing = crosses(without);
  if (is_crossing && !crosses(result_.mesh)) return false;
  stats_.intruders_removed = removed;
  result_ = {std::move(without), {}};
  return left == 0 && !is_crossing;
}

}  // namespace

SurfaceMesh repair(const SurfaceFacts& facts, std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds,
                   int threads, Controls& controls, RepairStats& stats) {
  return Repair(facts, std::move(restricted), threads, stats).run(max_rounds, controls);
}

}  // namespace deliso

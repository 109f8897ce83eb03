#include "surface/repair.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "surface/blocks.h"
#include "surface/component_match.h"
#include "surface/mesh_differences.h"
#include "surface/poles.h"
#include "surface/raised_cells.h"
#include "surface/repair_round.h"
#include "surface/repair_samples.h"
#include "surface/sample_lattice.h"
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
// A surface of so many crossings is polygonized as a whole when one of its components has to be.
constexpr std::size_t kSmallSurface = 100000;

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
        done_(topology_.components.size(), false),
        best_(topology_.components.size(), Agreement::kNone),
        differences_(facts, isosurface_) {}

  SurfaceMesh run(std::int32_t max_rounds, Controls& controls);

 private:
  struct KeptMesh {
    std::shared_ptr<MatchedMesh> mesh;
    TetSigns signs;  // that it was made with; empty once it has its pole heights
  };

  SurfaceMesh as_it_is();
  void resample();
  bool try_rule(SignRule rule);
  bool take(RepairRound::Attempt& attempt);
  void try_rules(Controls& controls);
  void try_signs(Controls& controls);
  const std::vector<Places>& places_of_difference(std::size_t most) { return differences_.find(mesh_, done_, most); }
  [[nodiscard]] bool completes(const MatchedMesh& mesh) const;
  void keep(TetSigns signs);
  void drop_outdone();
  void give_poles();
  [[nodiscard]] bool may_give(const MatchedMesh& mesh, std::size_t component) const {
    return best_[component] != Agreement::kNone && mesh.match.agreement[component] >= best_[component];
  }
  SurfaceMesh assemble_kept();
  void append_given(std::vector<bool>& left, SurfaceMesh& kept);
  [[nodiscard]] bool is_done() const {
    return std::all_of(done_.begin(), done_.end(), [](bool done) { return done; });
  }

  const SurfaceFacts& facts_;
  const ScalarGrid& grid_;
  const Isosurface& isosurface_;
  const IsosurfaceTopology& topology_;
  int threads_;
  RepairStats& stats_;
  SampleLattice lattice_;
  RaisedCells raised_;
  std::optional<RepairRound> round_;
  bool is_own_ = false;                // whether the triangulation is repair's own, not that of stage 1
  RepairSamples samples_;              // its vertices
  std::shared_ptr<MatchedMesh> mesh_;  // the latest
  std::vector<bool> done_;             // of each exact component: needs no more work
  std::vector<Agreement> best_;        // of each: the best, kWithStrays at most, reached by some mesh in history_
  MeshDifferences differences_;
  std::vector<KeptMesh> history_;  // meshes that brought a component further
};

SurfaceMesh Repair::run(std::int32_t max_rounds, Controls& controls) {
  round_->take_plain_signs();
  mesh_ = std::make_shared<MatchedMesh>(round_->assemble().value());
  stats_.vertices_before = static_cast<std::int64_t>(mesh_->built.mesh.points.size());
  stats_.components_before = std::count_if(mesh_->match.agreement.begin(), mesh_->match.agreement.end(),
                                           [](Agreement a) { return a != Agreement::kExact; });
  if (controls.stopped()) return as_it_is();
  keep(round_->restricted().signs());
  for (std::int32_t round = 1; round <= max_rounds && !is_done() && !controls.poll(); ++round) {
    controls.report("repair", samples_.size(), static_cast<std::size_t>(mesh_->match.error));
    raised_.raise(
        cells_in_trouble({grid_, topology_, round_->restricted(), *mesh_, raised_, round_->component_of_vertex(), done_,
                          places_of_difference(round == 1 ? kFewPlaces : kMostPlaces), round_->evidence(),
                          round_->located(facts_.critical_places()), threads_}));
    if (round == 1 && try_rule(SignRule::kCircumcenter)) break;  // new signs may do without new samples
    resample();
    try_rules(controls);
    try_signs(controls);
    stats_.rounds = round;
  }
  give_poles();
  SurfaceMesh kept = assemble_kept();
  stats_.vertices_after = static_cast<std::int64_t>(kept.points.size());
  return kept;
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
  const bool is_continued = is_own_ && samples_.changes_few(resampling);
  if (is_continued || threads_ == 1) give_poles();
  ExchangedPoints exchanged;
  if (is_continued && round_->exchange(resampling.leaving, resampling.coming_points(), exchanged)) {
    samples_.exchange(resampling, exchanged.vertex_of);
    return;
  }
  samples_.replace(resampling);
  if (is_continued || threads_ == 1) round_.reset();
  std::vector<VertexId> vertex_of;
  std::unique_ptr<SignedDelaunay> next;
  run_tasks(2, threads_, [&](std::size_t task) {
    if (task == 0) next = std::make_unique<SignedDelaunay>(isosurface_, samples_.points(), threads_, &vertex_of);
    if (task == 1 && round_) give_poles();
  });
  round_.emplace(grid_, topology_, raised_, std::move(next), threads_);
  samples_.take_vertices(vertex_of);
  is_own_ = true;
}

// Takes signs by a rule and keeps the mesh if it helps; true when no component is left.
bool Repair::try_rule(SignRule rule) {
  return take(round_->attempts(std::span(&rule, 1), [](const MatchedMesh&) { return true; }).front());
}

bool Repair::take(RepairRound::Attempt& attempt) {
  if (!attempt.mesh) return false;
  mesh_ = std::make_shared<MatchedMesh>(*std::move(attempt.mesh));
  keep(attempt.signs);
  return is_done();
}

// One rule after another until every component is done; the mesh with the smallest error stays.
void Repair::try_rules(Controls& controls) {
  std::shared_ptr<MatchedMesh> best;
  TetSigns signs;
  const std::size_t at_once = threads_ > 1 ? kSignRules.size() : 1;
  for (std::size_t first = 0; first < kSignRules.size(); first += at_once) {
    for (RepairRound::Attempt& attempt :
         round_->attempts(std::span(kSignRules).subspan(first, at_once), [&](const auto& m) { return completes(m); })) {
      if (take(attempt)) return;
      if (best && mesh_->match.error >= best->match.error) continue;
      best = mesh_;
      signs = std::move(attempt.signs);
      if (controls.poll()) first = kSignRules.size();
      if (first == kSignRules.size()) break;
    }
  }
  mesh_ = std::move(best);
  round_->set_signs(signs);
}

// Whether nothing is left to do with this mesh.
bool Repair::completes(const MatchedMesh& mesh) const {
  for (std::size_t c = 0; c < done_.size(); ++c) {
    if (!done_[c] && mesh.match.agreement[c] < Agreement::kWithStrays) return false;
  }
  return true;
}

// Single signs near the places where a component is wrong.
void Repair::try_signs(Controls& controls) {
  if (is_done() || controls.poll()) return;
  const std::vector<Places> places = places_of_difference(kMostPlaces);
  std::optional<SignTrials> trials;
  for (std::uint32_t c = 0; c < done_.size(); ++c) {
    if (done_[c] || places[c].empty()) continue;
    if (!trials) trials.emplace(*round_, topology_, raised_, kSignRules);
    const auto improved = [&](std::shared_ptr<MatchedMesh> mesh) {
      mesh_ = std::move(mesh);
      keep(round_->restricted().signs());
      return static_cast<bool>(done_[c]);
    };
    trials->mend(c, places[c], mesh_, improved, controls);
  }
}

// Keeps the latest mesh when some component agrees with it that agreed with no earlier one.
void Repair::keep(TetSigns signs) {
  bool helps = false;
  for (std::size_t c = 0; c < done_.size(); ++c) {
    if (mesh_->match.agreement[c] <= best_[c]) continue;
    best_[c] = std::min(mesh_->match.agreement[c], Agreement::kWithStrays);
    done_[c] = best_[c] == Agreement::kWithStrays;
    helps = true;
  }
  if (!helps) return;
  history_.push_back({mesh_, std::move(signs)});
  drop_outdone();
}

// Every component is taken from the latest mesh that may give it; drops the meshes from which none will be.
void Repair::drop_outdone() {
  std::vector<bool> given(done_.size(), false);
  for (auto kept = history_.end(); kept != history_.begin();) {
    --kept;
    bool gives = false;
    for (std::size_t c = 0; c < given.size(); ++c) {
      if (given[c] || !may_give(*kept->mesh, c)) continue;
      given[c] = gives = true;
    }
    if (!gives) kept = history_.erase(kept);
  }
}

// Pole heights for the kept meshes of this round, before its triangulation goes: of the components that may be taken
// from them.
void Repair::give_poles() {
  for (KeptMesh& kept : history_) {
    if (kept.signs.empty()) continue;
    round_->set_signs(kept.signs);
    kept.signs.clear();
    BuiltMesh& built = kept.mesh->built;
    std::vector<bool> wanted(round_->restricted().delaunay().vertex_count(), false);
    for (std::size_t v = 0; v < built.vertex_of.size(); ++v) {
      const std::uint32_t piece = kept.mesh->match.piece_of[v];
      if (piece != kNoPiece && may_give(*kept.mesh, kept.mesh->match.pieces[piece].component)) {
        wanted[built.vertex_of[v].index()] = true;
      }
    }
    const std::vector<double>& heights = round_->pole_heights(wanted);
    for (const VertexId v : built.vertex_of) built.mesh.pole_heights.push_back(heights[v.index()]);
  }
}

// Every component as the latest mesh that agrees with it has it, so that most come from one triangulation; strays are
// dropped.
SurfaceMesh Repair::assemble_kept() {
  SurfaceMesh kept;
  std::vector<bool> left(done_.size(), true);
  stats_.components_polygonized = std::count(best_.begin(), best_.end(), Agreement::kNone);
  // Pieces of two meshes may cross where components come near each other; a small surface is polygonized as a whole.
  if (stats_.components_polygonized > 0 && topology_.crossings.size() <= kSmallSurface) {
    stats_.components_polygonized = static_cast<std::int64_t>(left.size());
  } else {
    append_given(left, kept);
  }
  if (stats_.components_polygonized == 0) return kept;
  append_pieces(facts_.polygonized().mesh, facts_.polygonized().component, left, kept);
  return kept;
}

// Those that some mesh gives; the others are left.
void Repair::append_given(std::vector<bool>& left, SurfaceMesh& kept) {
  std::vector<std::vector<bool>> wanted(history_.size());  // pieces of each mesh
  for (std::size_t i = history_.size(); i-- > 0;) {
    const ComponentMatch& match = history_[i].mesh->match;
    wanted[i].assign(match.pieces.size(), false);
    for (std::size_t c = 0; c < done_.size(); ++c) {
      if (!left[c] || !may_give(*history_[i].mesh, c)) continue;
      left[c] = false;
      wanted[i][match.main_piece[c]] = true;
      stats_.components_partial += match.agreement[c] == Agreement::kPartial ? 1 : 0;
      stats_.components_mixed += match.agreement[c] == Agreement::kMixed ? 1 : 0;
      stats_.components_stray += match.agreement[c] == Agreement::kWithStrays ? 1 : 0;
    }
  }
  run_tasks(history_.size(), threads_, [&](std::size_t i) {
    auto& [built, component, match] = *history_[i].mesh;
    if (std::find(wanted[i].begin(), wanted[i].end(), true) == wanted[i].end()) return;
    separate_copies(built.mesh, built.groups, built.vertex_of, isosurface_.box(), [&, &match = match](std::uint32_t v) {
      return match.piece_of[v] != kNoPiece && wanted[i][match.piece_of[v]];
    });
  });
  for (std::size_t i = history_.size(); i-- > 0;) {
    append_pieces(history_[i].mesh->built.mesh, history_[i].mesh->match.piece_of, wanted[i], kept);
  }
}

}  // namespace

SurfaceMesh repair(const SurfaceFacts& facts, std::unique_ptr<SignedDelaunay> restricted, std::int32_t max_rounds,
                   int threads, Controls& controls, RepairStats& stats) {
  return Repair(facts, std::move(restricted), threads, stats).run(max_rounds, controls);
}

}  // namespace deliso

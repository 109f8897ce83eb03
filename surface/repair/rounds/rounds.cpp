#include "surface/repair/rounds/rounds.h"

#include <algorithm>
#include <set>
#include <utility>

#include "delaunay/base/memory.h"
#include "delaunay/base/parallel.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/extract/pinch_separation.h"
#include "surface/repair/diagnosis/defect_cells.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/finish/missed_crossings.h"
#include "surface/repair/rounds/sign_search.h"
#include "surface/repair/signs/sign_rules.h"
#include "surface/restricted/poles.h"

namespace deliso {

namespace {

// What sweeps find counts unless it is more than kMostPlaces; in the first round, when other signs tell more, unless it
// is more than kFewPlaces.
constexpr std::size_t kFewPlaces = 30;
constexpr std::size_t kMostPlaces = 512;

// Sweeps may err, and then nothing would ever be mended if no trouble counted but near what they find. In one round all
// of it counts; in several the samples would grow too many. From then on curvature tells what sweeps do not.
constexpr std::int32_t kRoundOfAllTrouble = 3;

}  // namespace

RepairRounds::RepairRounds(const ExactSurfaceCache& facts, std::unique_ptr<SignedDelaunay> restricted,
                           RepairStats& stats)
    : surface_(facts.surface()),
      stats_(stats),
      lattice_(surface_),
      raised_(surface_.isosurface),
      round_(std::in_place, surface_, raised_, std::move(restricted)),
      samples_(round_->restricted()),
      kept_(surface_.topology.components.size()),
      differences_(facts) {
  round_->take_plain_signs();
  mesh_ = std::make_shared<MatchedMesh>(round_->assemble().value());
  stats_.vertices_before = static_cast<std::int64_t>(mesh_->built.mesh.points.size());
  stats_.components_before = std::count_if(mesh_->match.agreement.begin(), mesh_->match.agreement.end(),
                                           [](Agreement a) { return a != Agreement::kExact; });
  kept_.keep(mesh_, round_->restricted().signs());
}

bool RepairRounds::mend(std::int32_t max_rounds, const std::function<bool()>& ends, Controls& controls) {
  while (stats_.rounds < max_rounds && !kept_.is_done() && !controls.poll()) {
    if (ends()) return true;
    controls.report("repair", samples_.size(), static_cast<std::size_t>(mesh_->match.error));
    const std::int64_t round = stats_.rounds - rounds_around_ + 1;
    std::vector<CellName> cells =
        defect_cells({surface_, round_->restricted(), *mesh_, raised_, round_->component_of_vertex(), kept_.done(),
                      places_of_difference(round == 1 ? kFewPlaces : kMostPlaces, round >= kRoundOfAllTrouble),
                      round != kRoundOfAllTrouble, round_->evidence(), round_->located()});
    cells.insert(cells.end(), along_.begin(), along_.end());
    along_.clear();
    if (!mend_once(std::move(cells), controls)) break;
  }
  return false;
}

// With these cells raised. False when signs alone did.
bool RepairRounds::mend_once(std::vector<CellName> cells, Controls& controls) {
  raised_.raise(std::move(cells));
  if (stats_.rounds == 0 && try_rule(SignRule::kCircumcenter)) return false;  // may do without new samples
  resample();
  release_free_memory();
  try_rules(controls);
  release_free_memory();
  try_signs(controls);
  ++stats_.rounds;
  return true;
}

void RepairRounds::mend_around(std::span<const std::uint32_t> crossings, Controls& controls) {
  reopen(crossings);
  mend_once(cells_around(crossings, surface_, raised_), controls);
  ++rounds_around_;
}

void RepairRounds::take_along(std::span<const std::uint32_t> crossings) {
  reopen(crossings);
  along_ = cells_around(crossings, surface_, raised_);
}

// Their components.
void RepairRounds::reopen(std::span<const std::uint32_t> crossings) {
  std::set<std::uint32_t> components;
  for (const std::uint32_t crossing : crossings) components.insert(surface_.topology.crossings[crossing].component);
  for (const std::uint32_t c : components) kept_.reopen(c);
}

std::vector<std::uint32_t> RepairRounds::crossings_at(std::span<const TrianglePair> pairs,
                                                      const SurfaceMesh& mesh) const {
  std::vector<std::uint32_t> triangles;
  for (const TrianglePair& pair : pairs) triangles.insert(triangles.end(), {pair.first, pair.second});
  std::vector<bool> is_met(surface_.topology.components.size(), false);
  for (const std::uint32_t c : components_at(mesh, vertices_of(mesh, triangles), surface_)) {
    if (c < is_met.size()) is_met[c] = true;
  }
  std::vector<std::uint32_t> found;
  for (const TrianglePair& pair : pairs) {
    surface_.topology.index.for_each_crossing_of_cell(raised_.cell_of(pair.position), [&](std::uint32_t crossing) {
      if (is_met[surface_.topology.crossings[crossing].component]) found.push_back(crossing);
    });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

// Its copies moved apart, with the poles of the samples as they are.
SurfaceMesh RepairRounds::as_it_is() {
  BuiltMesh built = mesh_->built;
  separate_pinches(built.mesh, built.groups, built.vertex_of, surface_.isosurface.box());
  const std::vector<double> heights = compute_poles(round_->restricted(), PoleHeight::kNearer);
  for (const VertexId v : built.vertex_of) built.mesh.pole_heights.push_back(heights[v.index()]);
  stats_.vertices_after = static_cast<std::int64_t>(built.mesh.points.size());
  return std::move(built.mesh);
}

// Exchanges samples: in the triangulation as it is when few change, else in one made anew, before the present one goes
// where there are threads for both.
void RepairRounds::resample() {
  const Resampling resampling = samples_.resampling(raised_, lattice_, surface_.isosurface);
  const bool is_continued = samples_.changes_few(resampling);
  if (is_continued || surface_.threads == 1) kept_.give_poles(*round_);
  ExchangedPoints exchanged;
  const bool keeps_signs = stats_.rounds > 0;  // nobody has tried to mend those of stage 1
  if (is_continued && round_->exchange(resampling.leaving, resampling.coming_points(), keeps_signs, exchanged)) {
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
  round_.emplace(surface_, raised_, std::move(next));
  samples_.take_vertices(vertex_of);
}

// Takes signs by a rule and keeps the mesh if it helps; true when no component is left.
bool RepairRounds::try_rule(SignRule rule) {
  return take(round_->attempts(std::span(&rule, 1), [](const MatchedMesh&) { return true; }).front());
}

bool RepairRounds::take(RepairRound::Attempt& attempt) {
  if (!attempt.mesh) return false;
  mesh_ = std::make_shared<MatchedMesh>(*std::move(attempt.mesh));
  kept_.keep(mesh_, attempt.signs);
  return kept_.is_done();
}

// One rule after another until every component is done; the mesh with the smallest error stays.
void RepairRounds::try_rules(Controls& controls) {
  std::shared_ptr<MatchedMesh> best;
  TetSigns signs;
  const std::span<const SignRule> rules = round_->rules();
  const std::size_t at_once = surface_.threads > 1 ? rules.size() : 1;
  bool is_over = false;
  for (std::size_t first = 0; first < rules.size() && !is_over; first += at_once) {
    for (RepairRound::Attempt& attempt :
         round_->attempts(rules.subspan(first, at_once), [&](const auto& m) { return kept_.would_be_done(m); })) {
      if (take(attempt)) return round_->set_signs(attempt.signs);
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
void RepairRounds::try_signs(Controls& controls) {
  if (kept_.is_done() || controls.poll()) return;
  const std::vector<IndexRanges> places = places_of_difference(kMostPlaces, stats_.rounds + 1 >= kRoundOfAllTrouble);
  std::optional<SignSearch> trials;
  for (std::uint32_t c = 0; c < places.size(); ++c) {
    if (kept_.done()[c] || places[c].all.empty()) continue;
    if (!trials) trials.emplace(*round_, surface_.topology, raised_, round_->rules(), places);
    const auto improved = [&](std::shared_ptr<MatchedMesh> mesh) {
      mesh_ = std::move(mesh);
      kept_.keep(mesh_, round_->restricted().signs());
      return static_cast<bool>(kept_.done()[c]);
    };
    trials->mend(c, mesh_, improved, controls);
  }
}

}  // namespace deliso

#include "surface/repair/rounds/round.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "surface/base/parallel_blocks.h"
#include "surface/certificate/component_match.h"
#include "surface/extract/build_triangle_mesh.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/search/covering_triangles.h"

namespace deliso {

namespace {

constexpr std::uint32_t kNoFacet = 0xFFFFFFFFu;
constexpr std::size_t kVerticesAtOnce = 2048;

// Of a component whose main piece has the right topology, and yet not all of it.
void make_partial(ComponentMatch& match, std::uint32_t component) {
  if (match.agreement[component] <= Agreement::kPartial) return;
  match.agreement[component] = Agreement::kPartial;
  ++match.error;
}

}  // namespace

RepairRound::RepairRound(const ExactSurface& surface, const CellLevels& raised,
                         std::unique_ptr<SignedDelaunay> restricted)
    : surface_(surface),
      raised_(raised),
      specks_(surface),
      restricted_(std::move(restricted)),
      at_circumcenters_(restricted_->signs()),
      flat_(*restricted_, surface.threads),
      unfounded_(*restricted_, surface.grid(), surface.threads),
      poles_(*restricted_) {
  find_components(0);
}

// Of the vertices from this one on.
void RepairRound::find_components(std::size_t first_vertex) {
  component_of_vertex_.resize(restricted_->delaunay().vertex_count(), 0);
  const Isosurface& isosurface = restricted_->isosurface();
  const Vec3& step = isosurface.step();
  covered_by_.resize(component_of_vertex_.size(), kNoFacet);
  const auto find = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first_vertex + first; i < first_vertex + last; ++i) {
      if (restricted_->is_virtual(VertexId(i))) continue;
      const Vec3& p = restricted_->delaunay().point(VertexId(i));
      const Vec3 index_point{p.x / step.x, p.y / step.y, p.z / step.z};
      component_of_vertex_[i] =
          component_of(surface_.grid(), isosurface.isovalue(), surface_.topology, index_point).value_or(0);
    }
  };
  for_each_block(component_of_vertex_.size() - first_vertex, surface_.threads, find, kVerticesAtOnce);
}

bool RepairRound::exchange(std::span<const VertexId> leaving, std::span<const Vec3> coming, bool keeps_signs,
                           ExchangedPoints& exchanged) {
  if (!restricted_->exchange(leaving, coming, exchanged)) return false;
  forget_rules();
  at_circumcenters_.resize(restricted_->delaunay().tet_slots(), 0);
  for (const TetId t : exchanged.renewed) at_circumcenters_[t.index()] = restricted_->is_above(t) ? 1 : 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < exchanged.renamed.size(); ++i) {
    if (exchanged.renamed[i].is_none()) continue;
    covered_by_[kept] = covered_by_[i];
    component_of_vertex_[kept++] = component_of_vertex_[i];
  }
  covered_by_.resize(kept);
  component_of_vertex_.resize(kept);
  find_components(kept);
  if (rules_) {
    rules_->renew(exchanged);
    rules_->update();
    as_before_.clear();
    if (keeps_signs) keep_signs(exchanged);
  }
  flat_.renew(exchanged);
  unfounded_.renew(exchanged);
  if (pairing_) pairing_->renew(exchanged);
  if (located_) located_->renew(exchanged);
  poles_.renew(exchanged);
  has_assembled_ = false;
  return true;
}

void RepairRound::keep_signs(const ExchangedPoints& exchanged) {
  as_before_ = restricted_->signs();
  rules_->take_signs(SignRule::kCentroidWithRing, at_circumcenters_);
  const TetSigns by_rule = restricted_->signs();
  for (const TetId t : exchanged.renewed) as_before_[t.index()] = by_rule[t.index()];
}

void RepairRound::settle_signs() {
  flat_.settle(*restricted_);
  unfounded_.overturn(*restricted_);
}

void RepairRound::take_plain_signs() {
  restricted_->set_signs(at_circumcenters_);
  settle_signs();
}

void RepairRound::take_signs(SignRule rule) {
  TetSigns& known = signs_by_rule_[static_cast<std::size_t>(rule)];
  if (!known.empty()) return restricted_->set_signs(known);
  if (!rules_) rules_.emplace(*restricted_, surface_.grid(), raised_, surface_.threads);
  rules_->take_signs(rule, rule == SignRule::kAsBefore ? as_before_ : at_circumcenters_);
  settle_signs();
  known = restricted_->signs();
}

void RepairRound::overturn(std::span<const TetId> tets) {
  for (const TetId t : tets) restricted_->overturn_sign(t);
  settle_signs();
}

// None when they would be the same as the last time in this round.
std::optional<PairedTriangles> RepairRound::take_triangles(const TetSigns& signs) {
  if (!pairing_) {
    pairing_.emplace(*restricted_, signs, surface_.threads);
  } else if (!pairing_->update(signs) && has_assembled_) {
    return std::nullopt;
  }
  has_assembled_ = true;
  return pairing_->triangles();
}

std::optional<MatchedMesh> RepairRound::assemble(const IsOfUse& is_of_use) {
  std::optional<PairedTriangles> triangles = take_triangles(restricted_->signs());
  if (!triangles) return std::nullopt;
  return finished(*std::move(triangles), is_of_use, surface_.threads);
}

std::vector<RepairRound::Attempt> RepairRound::attempts(std::span<const SignRule> rules,
                                                        const std::function<bool(const MatchedMesh&)>& is_last) {
  std::vector<Attempt> attempts(rules.size());
  std::vector<std::optional<PairedTriangles>> triangles(rules.size());
  std::atomic<bool> has_last = false;
  const int threads = rules.size() > 1 ? 1 : surface_.threads;
  run_in_turn(
      rules.size(), surface_.threads,
      [&](std::size_t i) {
        if (has_last) return;
        take_signs(rules[i]);
        attempts[i].signs = restricted_->signs();
      },
      [&](std::size_t i) {
        if (!attempts[i].signs.empty()) triangles[i] = take_triangles(attempts[i].signs);
      },
      [&](std::size_t i) {
        if (!triangles[i]) return;
        attempts[i].mesh = finished(*std::exchange(triangles[i], std::nullopt), {}, threads);
        if (attempts[i].mesh && is_last(*attempts[i].mesh)) has_last = true;
      });
  return attempts;
}

// Takes no account of signs, so that several threads may finish one mesh each while signs change.
std::optional<MatchedMesh> RepairRound::finished(PairedTriangles triangles, const IsOfUse& is_of_use, int threads) {
  const std::vector<FacetId> facets = std::move(triangles.facets);
  MatchedMesh mesh{build_triangle_mesh(*restricted_, std::move(triangles)), {}, {}};
  mesh.component.reserve(mesh.built.vertex_of.size());
  for (const VertexId v : mesh.built.vertex_of) mesh.component.push_back(component_of_vertex_[v.index()]);
  mesh.match = match_components(mesh.built.mesh, mesh.component, surface_.topology.components);
  if (is_of_use && !is_of_use(mesh)) return std::nullopt;
  find_missing_parts(mesh, facets, threads);
  for (const std::uint32_t component : specks_.missed_by(mesh)) make_partial(mesh.match, component);
  return mesh;
}

// A piece can have the right topology and still lack a branch that was cut off. Samples that the main pieces leave out
// tell: each must have one of their triangles near. `facets`: of the triangles, ascending, but for the last ones.
void RepairRound::find_missing_parts(MatchedMesh& mesh, std::span<const FacetId> facets, int threads) {
  ComponentMatch& match = mesh.match;
  const auto on_main_piece = [&](std::uint32_t v) {
    const std::uint32_t piece = match.piece_of[v];
    return piece != kNoPiece && match.main_piece[match.pieces[piece].component] == piece;
  };
  const auto takes = [&](std::uint32_t t) { return on_main_piece(mesh.built.mesh.triangles[t][0]); };
  std::vector<bool> used(restricted_->delaunay().vertex_count(), false);
  for (std::uint32_t v = 0; v < mesh.component.size(); ++v) {
    if (on_main_piece(v)) used[mesh.built.vertex_of[v].index()] = true;
  }
  // Most are covered by the triangle that covered them in an earlier mesh.
  const auto is_still_covered = [&](std::size_t vertex, std::uint32_t facet) {
    const auto at = std::lower_bound(facets.begin(), facets.end(), FacetId(facet));
    if (facet == kNoFacet || at == facets.end() || *at != FacetId(facet)) return false;
    const auto t = static_cast<std::uint32_t>(at - facets.begin());
    return takes(t) && is_covered_by(restricted_->delaunay().point(VertexId(vertex)), mesh.built.mesh, t);
  };
  std::vector<std::size_t> left_out;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] || restricted_->is_virtual(VertexId(i))) continue;
    if (match.agreement[component_of_vertex_[i]] <= Agreement::kPartial) continue;
    if (is_still_covered(i, std::atomic_ref(covered_by_[i]).load(std::memory_order_relaxed))) continue;
    left_out.push_back(i);
    points.push_back(restricted_->delaunay().point(VertexId(i)));
  }
  const std::vector<std::uint32_t> at_strays = crossings_at_strays(mesh);
  for (const std::uint32_t i : at_strays) {
    points.push_back(
        scaled(crossing_position(surface_.grid(), surface_.topology.crossings[i]), restricted_->isosurface().step()));
  }
  const std::vector<std::uint32_t> covering = covering_triangles(points, mesh.built.mesh, takes, threads);
  const auto take_account = [&](std::uint32_t component, std::uint32_t covered_by) {
    if (covered_by == kNoTriangle) make_partial(match, component);
  };
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    const std::uint32_t facet = covering[i] < facets.size() ? facets[covering[i]].value : kNoFacet;
    std::atomic_ref(covered_by_[left_out[i]]).store(facet, std::memory_order_relaxed);
    take_account(component_of_vertex_[left_out[i]], covering[i]);
  }
  for (std::size_t i = 0; i < at_strays.size(); ++i) {
    take_account(surface_.topology.crossings[at_strays[i]].component, covering[left_out.size() + i]);
  }
}

// The grid-edge crossings of components with strays in the cells that strays have vertices in: a stray may be a part of
// the surface that has come off, larger than its few samples tell.
std::vector<std::uint32_t> RepairRound::crossings_at_strays(const MatchedMesh& mesh) const {
  const ComponentMatch& match = mesh.match;
  std::vector<std::uint32_t> found;
  for (std::uint32_t v = 0; v < mesh.component.size(); ++v) {
    const std::uint32_t piece = match.piece_of[v];
    if (piece == kNoPiece) continue;
    const std::uint32_t component = match.pieces[piece].component;
    if (match.main_piece[component] == piece || match.agreement[component] <= Agreement::kPartial) continue;
    surface_.topology.index.for_each_crossing_of_cell(
        raised_.cell_of(mesh.built.mesh.points[v]), [&](std::uint32_t crossing) {
          if (surface_.topology.crossings[crossing].component == component) found.push_back(crossing);
        });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace deliso

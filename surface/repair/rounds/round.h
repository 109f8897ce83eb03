// The triangulation of repair and the meshes that the sign rules make of it.
//
// The rules differ in few signs, and most rounds in few points from what was before. So whatever depends on the
// triangulation alone is found once, and again only where points have been exchanged; and what depends on signs only
// where they have changed from one rule to the next.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/extract/facet_pairing.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/diagnosis/small_components.h"
#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/signs/euler_change.h"
#include "surface/repair/signs/located_critical_points.h"
#include "surface/repair/signs/sign_rules.h"
#include "surface/repair/signs/sliver_signs.h"
#include "surface/repair/signs/spurious_pockets.h"
#include "surface/restricted/poles.h"
#include "surface/restricted/signed_delaunay.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

class RepairRound {
 public:
  // The signs of `restricted` are those of the circumcenters. Keeps references to the others. Nothing but the
  // time depends on the number of threads.
  RepairRound(const ExactSurface& surface, const CellLevels& raised, std::unique_ptr<SignedDelaunay> restricted);

  // Exchanges points and takes account of that and of the cells raised by now: from here on it is another round. See
  // SignedDelaunay::exchange; when that says no, this round is of no more use. `keeps_signs`: the signs as they
  // are, of a round that has tried to mend, are to be tried again (SignRule::kAsBefore).
  bool exchange(std::span<const VertexId> leaving, std::span<const Vec3> coming, bool keeps_signs,
                ExchangedPoints& exchanged);

  // Takes the signs of the circumcenters, less folds (sliver_signs.h) and signs without foundation
  // (spurious_pockets.h).
  void take_plain_signs();
  // Takes signs by a rule (with the cells as they are raised when the first rule is tried), less the same.
  void take_signs(SignRule rule);
  void set_signs(const TetSigns& signs) { restricted_->set_signs(signs); }
  // Before meshes are put together, after which there is hardly ever another round: what can be found again goes.
  void rest() {
    forget_rules();
    pairing_.reset();
  }
  // Turns some signs over; then those of folds and those without foundation.
  void overturn(std::span<const TetId> tets);
  // What that would change (euler_change.h).
  [[nodiscard]] std::int64_t euler_change(std::span<const TetId> tets) {
    return deliso::euler_change(*restricted_, tets);
  }

  // The mesh for the signs as they stand and its match with the exact components; none when that would be the same mesh
  // as the last time in this round, or is of no use: is_of_use(mesh) may be asked before missing parts have been looked
  // for, which can only make the error larger and agreements partial.
  using IsOfUse = std::function<bool(const MatchedMesh&)>;
  std::optional<MatchedMesh> assemble(const IsOfUse& is_of_use = {});
  // Takes signs by each of several rules and assembles the meshes, beside each other on several threads. Those after
  // the first one for which is_last(mesh) holds may be left out; it is called by several threads. The signs are those
  // of any of the rules then.
  struct Attempt {
    TetSigns signs;
    std::optional<MatchedMesh> mesh;  // as assemble() gives it
  };
  std::vector<Attempt> attempts(std::span<const SignRule> rules,
                                const std::function<bool(const MatchedMesh&)>& is_last);
  // The saddles and critical samples of the volume in the triangulation, as far as they are asked for.
  LocatedCriticalPoints& located() { return located_ ? *located_ : located_.emplace(*restricted_); }
  // The pole heights of the wanted vertices for the signs as they stand.
  const std::vector<double>& pole_heights(const std::vector<bool>& wanted) {
    return poles_.heights(wanted, surface_.threads);
  }

  // The rules that are worth trying now, in order. Where the signs before are tried, too, the last ones hardly ever
  // help: where they did, that is in those signs.
  [[nodiscard]] std::span<const SignRule> rules() const {
    return as_before_.empty() ? std::span(kSignRules).subspan(1) : std::span(kSignRules).first(kRulesAfterExchange);
  }
  [[nodiscard]] int threads() const { return surface_.threads; }
  [[nodiscard]] const SignedDelaunay& restricted() const { return *restricted_; }
  // Of each vertex: the exact component it lies on.
  [[nodiscard]] const std::vector<std::uint32_t>& component_of_vertex() const { return component_of_vertex_; }
  // What is known of the sides in the tetrahedra (sign_constraints.h); empty before the first rule is tried.
  [[nodiscard]] std::span<const std::uint8_t> evidence() const {
    return rules_ ? std::span<const std::uint8_t>(rules_->evidence()) : std::span<const std::uint8_t>();
  }

 private:
  static constexpr std::size_t kRulesAfterExchange = 3;

  void forget_rules() {
    for (TetSigns& signs : signs_by_rule_) TetSigns().swap(signs);
  }
  void find_components(std::size_t first);
  void settle_signs();
  void keep_signs(const ExchangedPoints& exchanged);
  std::optional<PairedTriangles> take_triangles(const TetSigns& signs);
  std::optional<MatchedMesh> finished(PairedTriangles triangles, const IsOfUse& is_of_use, int threads);
  void find_missing_parts(MatchedMesh& mesh, std::span<const FacetId> facets, int threads);
  [[nodiscard]] std::vector<std::uint32_t> crossings_at_strays(const MatchedMesh& mesh) const;

  ExactSurface surface_;
  const CellLevels& raised_;
  SmallComponents specks_;
  std::unique_ptr<SignedDelaunay> restricted_;
  TetSigns at_circumcenters_;
  TetSigns as_before_;  // of the round before at last, new tetrahedra by the rule that is tried first; or none
  std::vector<std::uint32_t> component_of_vertex_;
  std::optional<SignRules> rules_;
  std::array<TetSigns, kSignRules.size()> signs_by_rule_;  // in this round; empty for a rule that has not been tried
  SliverSigns flat_;
  SpuriousPockets unfounded_;
  std::optional<FacetPairing> pairing_;
  bool has_assembled_ = false;  // in this round
  // Of each vertex: the facet of a triangle that covered it when it was last left out; kNoFacet when there was none.
  std::vector<std::uint32_t> covered_by_;
  std::optional<LocatedCriticalPoints> located_;
  KnownPoles poles_;
};

}  // namespace deliso

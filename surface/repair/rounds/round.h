// The triangulation of repair and the meshes that its signs make of it.
//
// Most rounds differ in few points from what was before. So whatever depends on the triangulation alone is found once,
// and again only where points have been exchanged; and what depends on signs only where they have changed.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/extract/facet_pairing.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/signs/euler_change.h"
#include "surface/repair/signs/located_critical_points.h"
#include "surface/repair/signs/sign_rule.h"
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
  // SignedDelaunay::exchange; when that says no, this round is of no more use.
  bool exchange(std::span<const VertexId> leaving, std::span<const Vec3> coming, ExchangedPoints& exchanged);

  // Takes the signs of the circumcenters, less folds (sliver_signs.h) and signs without foundation
  // (spurious_pockets.h).
  void take_plain_signs();
  // Takes signs by the rule for raised cells (sign_rule.h), less the same.
  void take_signs();
  void set_signs(const TetSigns& signs) { restricted_->set_signs(signs); }
  // Before meshes are put together, after which there is hardly ever another round: what can be found again goes.
  void rest() { pairing_.reset(); }
  // Turns a sign over; then those of folds and those without foundation.
  void overturn(TetId t);
  // What that would change (euler_change.h).
  [[nodiscard]] std::int64_t euler_change(TetId t) { return deliso::euler_change(*restricted_, t); }

  // The mesh for the signs as they stand and its match with the exact components; none when that would be the same mesh
  // as the last time in this round, or is of no use: is_of_use(mesh) may be asked before missing parts have been looked
  // for, which can only make the error larger and agreements partial.
  using IsOfUse = std::function<bool(const MatchedMesh&)>;
  std::optional<MatchedMesh> assemble(const IsOfUse& is_of_use = {});
  // The saddles and critical samples of the volume in the triangulation, as far as they are asked for.
  LocatedCriticalPoints& located() { return located_ ? *located_ : located_.emplace(*restricted_); }
  // The pole heights of the wanted vertices for the signs as they stand.
  const std::vector<double>& pole_heights(const std::vector<bool>& wanted) {
    return poles_.heights(wanted, surface_.threads);
  }

  [[nodiscard]] int threads() const { return surface_.threads; }
  [[nodiscard]] const SignedDelaunay& restricted() const { return *restricted_; }
  // Of each vertex: the exact component it lies on, or kNoComponent.
  [[nodiscard]] const std::vector<std::uint32_t>& component_of_vertex() const { return component_of_vertex_; }
  // What is known of the sides in the tetrahedra (sign_constraints.h); empty before signs are taken by the rule.
  [[nodiscard]] std::span<const std::uint8_t> evidence() const {
    return rule_ ? std::span<const std::uint8_t>(rule_->evidence()) : std::span<const std::uint8_t>();
  }

 private:
  void find_components(std::size_t first);
  void settle_signs();
  std::optional<PairedTriangles> take_triangles();
  void find_missing_parts(MatchedMesh& mesh, std::span<const FacetId> facets);

  ExactSurface surface_;
  const CellLevels& raised_;
  std::unique_ptr<SignedDelaunay> restricted_;
  TetSigns at_circumcenters_;
  std::vector<std::uint32_t> component_of_vertex_;
  std::optional<SignRule> rule_;  // when first needed
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

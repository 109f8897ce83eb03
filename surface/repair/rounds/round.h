// The triangulation of a round of repair, and the meshes that follow from its signs.
//
// Most rounds change few points. So what takes long to find is updated only where points were exchanged, if it depends
// on the triangulation alone, and only where signs have changed, if it depends on them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surface/base/exact_surface.h"
#include "surface/extract/facet_pairing.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/lattice/cell_levels.h"
#include "surface/repair/signs/sign_rule.h"
#include "surface/restricted/poles.h"
#include "surface/restricted/signed_delaunay.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

class RepairRound {
 public:
  // Precondition: the signs of `restricted` are those of the circumcenters. Keeps references to the other arguments.
  // Only the time depends on the number of threads.
  RepairRound(const ExactSurface& surface, const CellLevels& cell_levels, std::unique_ptr<SignedDelaunay> restricted);

  // Exchanges points and updates all data for them and for the cells refined meanwhile: this begins a new round.
  // Returns false if SignedDelaunay::exchange() fails; then this object must not be used any more.
  bool exchange(std::span<const VertexId> leaving, std::span<const Vec3> coming, ExchangedPoints& exchanged);

  // Sets the signs of the circumcenters, then corrects the signs of slivers (sliver_signs.h) and of spurious pockets
  // (spurious_pockets.h).
  void take_plain_signs();
  // Sets the signs by the rule for refined cells (sign_rule.h), then makes the same two corrections.
  void take_signs();
  void set_signs(const TetSigns& signs) { restricted_->set_signs(signs); }
  // Frees data that can be computed again. Called before meshes are assembled, after which a further round is rare.
  void drop_pairing() { pairing_.reset(); }
  // The mesh for the present signs, matched with the exact components.
  MatchedMesh assemble();
  // The pole heights of the wanted vertices for the present signs.
  const std::vector<double>& pole_heights(const std::vector<bool>& wanted) {
    return poles_.heights(wanted, surface_.threads);
  }

  [[nodiscard]] int threads() const { return surface_.threads; }
  [[nodiscard]] const SignedDelaunay& restricted() const { return *restricted_; }
  // The exact component on which each vertex lies, or kNoComponent.
  [[nodiscard]] const std::vector<std::uint32_t>& component_of_vertex() const { return component_of_vertex_; }

 private:
  void find_components(std::size_t first);
  void settle_signs();
  PairedTriangles take_triangles();
  void find_missing_parts(MatchedMesh& mesh) const;

  ExactSurface surface_;
  const CellLevels& cell_levels_;
  std::unique_ptr<SignedDelaunay> restricted_;
  TetSigns at_circumcenters_;
  std::vector<std::uint32_t> component_of_vertex_;
  std::optional<SignRule> rule_;  // made when first needed
  std::optional<FacetPairing> pairing_;
  KnownPoles poles_;
};

}  // namespace deliso

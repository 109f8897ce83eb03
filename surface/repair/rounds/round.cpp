#include "surface/repair/rounds/round.h"

#include <algorithm>
#include <utility>

#include "surface/base/parallel_blocks.h"
#include "surface/certificate/component_match.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/extract/build_triangle_mesh.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/signs/sliver_signs.h"
#include "surface/repair/signs/spurious_pockets.h"
#include "surface/search/covering_triangles.h"

namespace deliso {

namespace {

constexpr std::size_t kVerticesAtOnce = 2048;

// Marks a component whose main piece has the right topology but misses a part of it.
void make_partial(ComponentMatch& match, std::uint32_t component) {
  if (match.agreement[component] <= Agreement::kPartial) return;
  match.agreement[component] = Agreement::kPartial;
  ++match.error;
}

}  // namespace

RepairRound::RepairRound(const ExactSurface& surface, const CellLevels& cell_levels,
                         std::unique_ptr<SignedDelaunay> restricted)
    : surface_(surface),
      cell_levels_(cell_levels),
      restricted_(std::move(restricted)),
      at_circumcenters_(restricted_->signs()),
      poles_(*restricted_) {
  find_components(0);
}

// Finds the exact components of the vertices from this one on.
void RepairRound::find_components(std::size_t first_vertex) {
  component_of_vertex_.resize(restricted_->delaunay().vertex_count(), kNoComponent);
  const auto find = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first_vertex + first; i < first_vertex + last; ++i) {
      if (restricted_->is_virtual(VertexId(i))) continue;
      const Vec3& p = restricted_->delaunay().point(VertexId(i));
      component_of_vertex_[i] = surface_.component_at(p).value_or(kNoComponent);
    }
  };
  for_each_block(component_of_vertex_.size() - first_vertex, surface_.threads, find, kVerticesAtOnce);
}

bool RepairRound::exchange(std::span<const VertexId> leaving, std::span<const Vec3> coming,
                           ExchangedPoints& exchanged) {
  if (!restricted_->exchange(leaving, coming, exchanged)) return false;
  at_circumcenters_.resize(restricted_->delaunay().tet_slots(), 0);
  for (const TetId t : exchanged.renewed) at_circumcenters_[t.index()] = restricted_->is_above(t) ? 1 : 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < exchanged.renamed.size(); ++i) {
    if (exchanged.renamed[i].is_none()) continue;
    component_of_vertex_[kept++] = component_of_vertex_[i];
  }
  component_of_vertex_.resize(kept);
  find_components(kept);
  if (rule_) {
    rule_->renew(exchanged);
    rule_->update();
  }
  if (pairing_) pairing_->renew(exchanged);
  poles_.renew(exchanged);
  return true;
}

void RepairRound::settle_signs() {
  settle_slivers(*restricted_, surface_.threads);
  flip_spurious_pockets(*restricted_, surface_.threads);
}

void RepairRound::take_plain_signs() {
  restricted_->set_signs(at_circumcenters_);
  settle_signs();
}

void RepairRound::take_signs() {
  if (!rule_) rule_.emplace(*restricted_, cell_levels_, surface_.threads);
  rule_->take_signs(at_circumcenters_);
  settle_signs();
}

// Pairs the facets for the present signs.
PairedTriangles RepairRound::take_triangles() {
  const TetSigns signs = restricted_->signs();
  if (!pairing_) {
    pairing_.emplace(*restricted_, signs, surface_.threads);
  } else {
    pairing_->update(signs);
  }
  return pairing_->triangles();
}

MatchedMesh RepairRound::assemble() {
  MatchedMesh mesh{build_triangle_mesh(*restricted_, take_triangles()), {}, {}};
  mesh.component.reserve(mesh.built.vertex_of.size());
  for (const VertexId v : mesh.built.vertex_of) mesh.component.push_back(component_of_vertex_[v.index()]);
  mesh.match = match_components(mesh.built.mesh, mesh.component, surface_.topology.components);
  find_missing_parts(mesh);
  return mesh;
}

// Finds components whose main piece has the right topology but misses a part, for example a branch that was cut off.
// Every sample that is no vertex of a main piece must have a triangle of a main piece near it.
void RepairRound::find_missing_parts(MatchedMesh& mesh) const {
  ComponentMatch& match = mesh.match;
  const auto on_main_piece = [&](std::uint32_t v) {
    const std::uint32_t piece = match.piece_of[v];
    return piece != kNoPiece && match.is_main(piece);
  };
  const auto takes = [&](std::uint32_t t) { return on_main_piece(mesh.built.mesh.triangles[t][0]); };
  std::vector<bool> used(restricted_->delaunay().vertex_count(), false);
  for (std::uint32_t v = 0; v < mesh.component.size(); ++v) {
    if (on_main_piece(v)) used[mesh.built.vertex_of[v].index()] = true;
  }
  std::vector<std::size_t> unused;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] || restricted_->is_virtual(VertexId(i))) continue;
    const std::uint32_t component = component_of_vertex_[i];
    if (component == kNoComponent || match.agreement[component] <= Agreement::kPartial) continue;
    unused.push_back(i);
    points.push_back(restricted_->delaunay().point(VertexId(i)));
  }
  const std::vector<std::uint32_t> covering = covering_triangles(points, mesh.built.mesh, takes, surface_.threads);
  for (std::size_t i = 0; i < unused.size(); ++i) {
    if (covering[i] == kNoTriangle) make_partial(match, component_of_vertex_[unused[i]]);
  }
}

}  // namespace deliso

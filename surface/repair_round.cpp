#include "surface/repair_round.h"

#include <utility>

#include "surface/blocks.h"
#include "surface/build_triangle_mesh.h"
#include "surface/component_match.h"
#include "surface/coverage.h"

namespace deliso {

RepairRound::RepairRound(const ScalarGrid& grid, const IsosurfaceTopology& topology, const RaisedCells& raised,
                         std::unique_ptr<SignedDelaunay> restricted, int threads)
    : grid_(grid),
      topology_(topology),
      raised_(raised),
      threads_(threads),
      restricted_(std::move(restricted)),
      at_circumcenters_(restricted_->signs()),
      unfounded_(*restricted_, grid),
      poles_(*restricted_) {
  find_components(0);
}

// Of the vertices from this one on.
void RepairRound::find_components(std::size_t first_vertex) {
  component_of_vertex_.resize(restricted_->delaunay().vertex_count(), 0);
  const Isosurface& isosurface = restricted_->isosurface();
  const Vec3& step = isosurface.step();
  for_each_block(component_of_vertex_.size() - first_vertex, threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first_vertex + first; i < first_vertex + last; ++i) {
      if (restricted_->is_virtual(VertexId(i))) continue;
      const Vec3& p = restricted_->delaunay().point(VertexId(i));
      const Vec3 index_point{p.x / step.x, p.y / step.y, p.z / step.z};
      component_of_vertex_[i] = component_of(grid_, isosurface.isovalue(), topology_, index_point).value_or(0);
    }
  });
}

bool RepairRound::exchange(std::span<const VertexId> leaving, std::span<const Vec3> coming,
                           ExchangedPoints& exchanged) {
  if (!restricted_->exchange(leaving, coming, exchanged)) return false;
  at_circumcenters_.resize(restricted_->delaunay().tet_slots(), false);
  for (const TetId t : exchanged.renewed) at_circumcenters_[t.index()] = restricted_->is_above(t);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < exchanged.renamed.size(); ++i) {
    if (!exchanged.renamed[i].is_none()) component_of_vertex_[kept++] = component_of_vertex_[i];
  }
  component_of_vertex_.resize(kept);
  find_components(kept);
  if (rules_) {
    rules_->renew(exchanged);
    rules_->update();
  }
  unfounded_.renew(exchanged);
  if (pairing_) pairing_->renew(exchanged);
  if (critical_) critical_->renew(exchanged);
  poles_.renew(exchanged);
  has_assembled_ = false;
  return true;
}

void RepairRound::take_plain_signs() {
  restricted_->set_signs(at_circumcenters_);
  unfounded_.overturn(*restricted_);
}

void RepairRound::take_signs(SignRule rule) {
  if (!rules_) rules_.emplace(*restricted_, grid_, raised_, threads_);
  rules_->take_signs(rule, at_circumcenters_);
  unfounded_.overturn(*restricted_);
}

void RepairRound::overturn(std::span<const TetId> tets) {
  for (const TetId t : tets) restricted_->overturn_sign(t);
  unfounded_.overturn(*restricted_);
}

const std::vector<CriticalPlace>& RepairRound::critical_places(std::span<const CellIndex> cells) {
  if (!critical_) critical_.emplace(*restricted_, grid_, cells, threads_);
  return critical_->places();
}

std::optional<MatchedMesh> RepairRound::assemble() {
  if (!pairing_) {
    pairing_.emplace(*restricted_);
  } else if (!pairing_->update() && has_assembled_) {
    return std::nullopt;
  }
  has_assembled_ = true;
  MatchedMesh mesh{build_triangle_mesh(*pairing_), {}, {}};
  for (const VertexId v : mesh.built.vertex_of) mesh.component.push_back(component_of_vertex_[v.index()]);
  mesh.match = match_components(mesh.built.mesh, mesh.component, topology_.components);
  find_missing_parts(mesh);
  return mesh;
}

// A piece can have the right topology and still lack a branch that was cut off. Samples that the main pieces leave out
// tell: each must have one of their triangles near.
void RepairRound::find_missing_parts(MatchedMesh& mesh) const {
  ComponentMatch& match = mesh.match;
  const auto on_main_piece = [&](std::uint32_t v) {
    const std::uint32_t piece = match.piece_of[v];
    return piece != kNoPiece && match.main_piece[match.pieces[piece].component] == piece;
  };
  std::vector<bool> used(restricted_->delaunay().vertex_count(), false);
  for (std::uint32_t v = 0; v < mesh.component.size(); ++v) {
    if (on_main_piece(v)) used[mesh.built.vertex_of[v].index()] = true;
  }
  std::vector<Vec3> left_out;
  std::vector<std::uint32_t> component;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] || restricted_->is_virtual(VertexId(i))) continue;
    if (match.agreement[component_of_vertex_[i]] <= Agreement::kPartial) continue;
    left_out.push_back(restricted_->delaunay().point(VertexId(i)));
    component.push_back(component_of_vertex_[i]);
  }
  const std::vector<bool> covered = covered_points(
      left_out, mesh.built.mesh, [&](std::uint32_t t) { return on_main_piece(mesh.built.mesh.triangles[t][0]); },
      threads_);
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    Agreement& agreement = match.agreement[component[i]];
    if (covered[i] || agreement == Agreement::kPartial) continue;
    agreement = Agreement::kPartial;
    ++match.error;
  }
}

}  // namespace deliso

#include "surface/repair/rounds/component_selection.h"

#include <algorithm>
#include <utility>

#include "delaunay/base/disjoint_sets.h"
#include "delaunay/base/parallel.h"
#include "surface/certificate/mesh_pieces.h"
#include "surface/extract/edge_positions.h"
#include "surface/extract/pinch_separation.h"
#include "surface/repair/diagnosis/matched_mesh.h"

namespace deliso {

namespace {

// A mesh is reduced to the pieces still needed if these have fewer vertices by this factor.
constexpr std::int64_t kWorthCutting = 2;

// The wanted pieces, and all pieces connected to them, directly or not, by copies of one vertex.
std::vector<bool> with_pieces_touched(const MatchedMesh& mesh, const std::vector<bool>& wanted) {
  const std::vector<VertexId>& vertex_of = mesh.built.vertex_of;
  DisjointSets sets(wanted.size());
  std::vector<std::uint32_t> piece_at;  // of each vertex of the triangulation: the first piece there
  for (std::size_t v = 0; v < vertex_of.size(); ++v) {
    const std::uint32_t piece = mesh.match.piece_of[v];
    if (piece == kNoPiece) continue;
    if (vertex_of[v].index() >= piece_at.size()) piece_at.resize(vertex_of[v].index() + 1, kNoPiece);
    std::uint32_t& first = piece_at[vertex_of[v].index()];
    if (first == kNoPiece) first = piece;
    sets.unite(piece, first);
  }
  std::vector<bool> is_touched(wanted.size(), false);
  for (std::uint32_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i]) is_touched[sets.find(i)] = true;
  }
  for (std::uint32_t i = 0; i < wanted.size(); ++i) is_touched[i] = is_touched[sets.find(i)];
  return is_touched;
}

// Some pieces of a mesh; they keep their numbers.
MatchedMesh part_of(const MatchedMesh& whole, const std::vector<bool>& pieces) {
  MatchedMesh part;
  const std::vector<std::uint32_t>& piece_of = whole.match.piece_of;
  append_pieces(whole.built.mesh, piece_of, pieces, part.built.mesh);
  part.match = {whole.match.pieces, {}, whole.match.main_piece, whole.match.agreement, whole.match.error};
  std::vector<std::uint32_t> name(piece_of.size(), kNoPiece);
  for (std::size_t v = 0; v < piece_of.size(); ++v) {
    if (piece_of[v] == kNoPiece || !pieces[piece_of[v]]) continue;
    name[v] = static_cast<std::uint32_t>(part.component.size());
    part.component.push_back(whole.component[v]);
    part.match.piece_of.push_back(piece_of[v]);
    part.built.vertex_of.push_back(whole.built.vertex_of[v]);
  }
  const auto stays = [&](std::uint32_t v) { return name[v] != kNoPiece; };
  for (const std::uint32_t v : whole.built.copies) {
    if (stays(v)) part.built.copies.push_back(name[v]);
  }
  for (const PinchGroup& group : whole.built.groups) {
    if (!stays(group.front().vertex)) continue;  // the other copies of the group do not stay either
    part.built.groups.push_back(group);
    for (Copy& copy : part.built.groups.back()) copy.vertex = name[copy.vertex];
  }
  return part;
}

}  // namespace

// Keeps a mesh if some component agrees with it better than with every earlier mesh.
void ComponentSelection::keep(std::shared_ptr<MatchedMesh> mesh, TetSigns signs) {
  std::vector<Agreement> agreement = mesh->match.agreement;
  bool helps = false;
  for (std::size_t c = 0; c < done_.size(); ++c) {
    if (agreement[c] == Agreement::kDisplaced && best_[c] == Agreement::kDisplaced) agreement[c] = Agreement::kNone;
    if (agreement[c] <= best_[c]) continue;
    best_[c] = std::min(agreement[c], Agreement::kWithStrays);
    done_[c] = best_[c] == Agreement::kWithStrays;
    helps = true;
  }
  if (!helps) return;
  kept_.push_back({std::move(mesh), std::move(signs), std::move(agreement)});
  drop_superseded();
}

// Every component is taken from the latest mesh that may give it. Drops the meshes that give no component, and reduces
// the others to the pieces that they give.
void ComponentSelection::drop_superseded() {
  std::vector<bool> given(done_.size(), false);
  for (auto kept = kept_.end(); kept != kept_.begin();) {
    --kept;
    std::vector<bool> gives(given.size(), false);
    for (std::size_t c = 0; c < given.size(); ++c) {
      if (given[c] || !may_give(*kept, c)) continue;
      given[c] = gives[c] = true;
    }
    if (std::find(gives.begin(), gives.end(), true) == gives.end()) {
      kept = kept_.erase(kept);
    } else {
      cut_down(*kept, gives);
    }
  }
}

// Reduces a mesh to the main pieces of the components that it gives and the pieces that touch them. The latter are
// needed when pinches are separated.
void ComponentSelection::cut_down(KeptMesh& kept, const std::vector<bool>& gives) const {
  const MatchedMesh& whole = *kept.mesh;
  std::vector<bool> wanted(whole.match.pieces.size(), false);
  for (std::size_t c = 0; c < gives.size(); ++c) {
    if (gives[c]) wanted[whole.match.main_piece[c]] = true;
  }
  const std::vector<bool> stays = with_pieces_touched(whole, wanted);
  std::int64_t left = 0;
  for (std::size_t i = 0; i < stays.size(); ++i) left += stays[i] ? whole.match.pieces[i].vertices : 0;
  if (kWorthCutting * left > static_cast<std::int64_t>(whole.built.mesh.points.size())) return;
  kept.mesh = std::make_shared<MatchedMesh>(part_of(whole, stays));
  for (std::size_t c = 0; c < gives.size(); ++c) {
    if (!gives[c]) kept.agreement[c] = Agreement::kNone;
  }
}

// Computes the pole heights of the kept meshes of this round, for the components that may be taken from them.
// Afterwards the triangulation may be destroyed.
void ComponentSelection::give_poles(RepairRound& round) {
  if (std::all_of(kept_.begin(), kept_.end(), [](const KeptMesh& kept) { return kept.signs.empty(); })) return;
  const TetSigns signs = round.restricted().signs();
  for (KeptMesh& kept : kept_) {
    if (kept.signs.empty()) continue;
    round.set_signs(kept.signs);
    kept.signs.clear();
    BuiltMesh& built = kept.mesh->built;
    std::vector<bool> wanted(round.restricted().delaunay().vertex_count(), false);
    for (std::size_t v = 0; v < built.vertex_of.size(); ++v) {
      const std::uint32_t piece = kept.mesh->match.piece_of[v];
      if (piece == kNoPiece) continue;
      const std::uint32_t component = kept.mesh->match.pieces[piece].component;
      if (component != kNoComponent && may_give(kept, component)) {
        wanted[built.vertex_of[v].index()] = true;
      }
    }
    const std::vector<double>& heights = round.pole_heights(wanted);
    for (const VertexId v : built.vertex_of) built.mesh.pole_heights.push_back(heights[v.index()]);
  }
  round.set_signs(signs);
}

AssembledMesh ComponentSelection::assemble(std::vector<bool>& left, const Isosurface& isosurface, int threads,
                                           RepairStats& stats) const {
  left.assign(done_.size(), true);
  stats.components_mixed = stats.components_displaced = stats.components_stray = 0;
  std::vector<std::vector<bool>> wanted(kept_.size());  // the wanted pieces of each mesh
  for (std::size_t i = kept_.size(); i-- > 0;) {
    const ComponentMatch& match = kept_[i].mesh->match;
    wanted[i].assign(match.pieces.size(), false);
    for (std::size_t c = 0; c < done_.size(); ++c) {
      if (!left[c] || !may_give(kept_[i], c)) continue;
      left[c] = false;
      wanted[i][match.main_piece[c]] = true;
      const Agreement agreement = kept_[i].agreement[c];
      const bool is_displaced = agreement == Agreement::kDisplaced;
      const bool is_mixed = is_displaced ? match.pieces[match.main_piece[c]].mixed : agreement == Agreement::kMixed;
      stats.components_displaced += is_displaced ? 1 : 0;
      stats.components_mixed += is_mixed ? 1 : 0;
      stats.components_stray += agreement == Agreement::kWithStrays ? 1 : 0;
    }
  }
  const auto is_wanted = [&](std::size_t i, std::uint32_t v) {
    const std::uint32_t piece = kept_[i].mesh->match.piece_of[v];
    return piece != kNoPiece && wanted[i][piece];
  };
  std::vector<SurfaceMesh> given(kept_.size());
  run_tasks(kept_.size(), threads, [&](std::size_t i) {
    const BuiltMesh& built = kept_[i].mesh->built;
    given[i] = built.mesh;
    std::vector<PinchGroup> groups = built.groups;
    find_other_positions(groups, isosurface);
    separate_pinches(given[i], groups, built.vertex_of, isosurface.box(), isosurface.surface_box(),
                     [&](std::uint32_t v) { return is_wanted(i, v); });
  });
  AssembledMesh all;
  for (std::size_t i = kept_.size(); i-- > 0;) {
    const auto& [built, component, match] = *kept_[i].mesh;
    append_pieces(std::exchange(given[i], {}), match.piece_of, wanted[i], all.mesh);
    for (std::uint32_t v = 0; v < component.size(); ++v) {
      if (is_wanted(i, v)) all.component.push_back(component[v]);
    }
  }
  return all;
}

}  // namespace deliso

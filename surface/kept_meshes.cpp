#include "surface/kept_meshes.h"

#include <algorithm>
#include <utility>

#include "delaunay/base/parallel.h"
#include "surface/separate_copies.h"

namespace deliso {

bool KeptMeshes::would_be_done(const MatchedMesh& mesh) const {
  for (std::size_t c = 0; c < done_.size(); ++c) {
    if (!done_[c] && mesh.match.agreement[c] < Agreement::kWithStrays) return false;
  }
  return true;
}

// Keeps a mesh when some component agrees with it that agreed with no earlier one.
void KeptMeshes::keep(std::shared_ptr<MatchedMesh> mesh, TetSigns signs) {
  bool helps = false;
  for (std::size_t c = 0; c < done_.size(); ++c) {
    if (mesh->match.agreement[c] <= best_[c]) continue;
    best_[c] = std::min(mesh->match.agreement[c], Agreement::kWithStrays);
    done_[c] = best_[c] == Agreement::kWithStrays;
    helps = true;
  }
  if (!helps) return;
  kept_.push_back({std::move(mesh), std::move(signs)});
  drop_outdone();
}

// Every component is taken from the latest mesh that may give it; drops the meshes from which none will be.
void KeptMeshes::drop_outdone() {
  std::vector<bool> given(done_.size(), false);
  for (auto kept = kept_.end(); kept != kept_.begin();) {
    --kept;
    bool gives = false;
    for (std::size_t c = 0; c < given.size(); ++c) {
      if (given[c] || !may_give(*kept->mesh, c)) continue;
      given[c] = gives = true;
    }
    if (!gives) kept = kept_.erase(kept);
  }
}

// Pole heights for the kept meshes of this round, before its triangulation goes: of the components that may be taken
// from them.
void KeptMeshes::give_poles(RepairRound& round) {
  for (KeptMesh& kept : kept_) {
    if (kept.signs.empty()) continue;
    round.set_signs(kept.signs);
    kept.signs.clear();
    BuiltMesh& built = kept.mesh->built;
    std::vector<bool> wanted(round.restricted().delaunay().vertex_count(), false);
    for (std::size_t v = 0; v < built.vertex_of.size(); ++v) {
      const std::uint32_t piece = kept.mesh->match.piece_of[v];
      if (piece != kNoPiece && may_give(*kept.mesh, kept.mesh->match.pieces[piece].component)) {
        wanted[built.vertex_of[v].index()] = true;
      }
    }
    const std::vector<double>& heights = round.pole_heights(wanted);
    for (const VertexId v : built.vertex_of) built.mesh.pole_heights.push_back(heights[v.index()]);
  }
}

void KeptMeshes::append_to(SurfaceMesh& mesh, std::vector<bool>& left, const Box3& box, int threads,
                           RepairStats& stats) {
  std::vector<std::vector<bool>> wanted(kept_.size());  // pieces of each mesh
  for (std::size_t i = kept_.size(); i-- > 0;) {
    const ComponentMatch& match = kept_[i].mesh->match;
    wanted[i].assign(match.pieces.size(), false);
    for (std::size_t c = 0; c < done_.size(); ++c) {
      if (!left[c] || !may_give(*kept_[i].mesh, c)) continue;
      left[c] = false;
      wanted[i][match.main_piece[c]] = true;
      stats.components_partial += match.agreement[c] == Agreement::kPartial ? 1 : 0;
      stats.components_mixed += match.agreement[c] == Agreement::kMixed ? 1 : 0;
      stats.components_stray += match.agreement[c] == Agreement::kWithStrays ? 1 : 0;
    }
  }
  run_tasks(kept_.size(), threads, [&](std::size_t i) {
    auto& [built, component, match] = *kept_[i].mesh;
    if (std::find(wanted[i].begin(), wanted[i].end(), true) == wanted[i].end()) return;
    separate_copies(built.mesh, built.groups, built.vertex_of, box, [&, &match = match](std::uint32_t v) {
      return match.piece_of[v] != kNoPiece && wanted[i][match.piece_of[v]];
    });
  });
  for (std::size_t i = kept_.size(); i-- > 0;) {
    append_pieces(kept_[i].mesh->built.mesh, kept_[i].mesh->match.piece_of, wanted[i], mesh);
  }
}

}  // namespace deliso

// The meshes of repair that brought some component further, and what is taken from them at last.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "surface/base/stage_stats.h"
#include "surface/certificate/component_match.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/repair/diagnosis/matched_mesh.h"
#include "surface/repair/rounds/round.h"

namespace deliso {

// A mesh, and the exact component that the sample of each vertex lies on.
struct AssembledMesh {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> component;
};

class ComponentSelection {
 public:
  explicit ComponentSelection(std::size_t components) : done_(components, false), best_(components, Agreement::kNone) {}

  // Of each exact component: needs no more work.
  [[nodiscard]] const std::vector<bool>& done() const { return done_; }
  [[nodiscard]] bool is_done() const {
    return std::all_of(done_.begin(), done_.end(), [](bool done) { return done; });
  }
  // Whether every component is done, or has the right topology with vertices of others mixed in.
  [[nodiscard]] bool is_done_but_for_mixing() const {
    return std::all_of(best_.begin(), best_.end(), [](Agreement best) { return best >= Agreement::kMixed; });
  }
  // A component is to be mended further; no mesh kept so far may give it. Precondition: the meshes have pole heights.
  void reopen(std::uint32_t component);
  // Keeps a mesh, made with these signs, when it helps some component. Of all of them no more stays than may still be
  // taken.
  void keep(std::shared_ptr<MatchedMesh> mesh, TetSigns signs);
  // Finds pole heights for the meshes of a round, before its triangulation goes.
  void give_poles(RepairRound& round);
  // Every component as the latest mesh that agrees with it at its best has it, less the copies of vertices that find no
  // place on the surface; unless no mesh has all of it or such a copy cannot be taken out: then it is `left`.
  // Precondition: the meshes have pole heights.
  AssembledMesh assemble(std::vector<bool>& left, const Box3& box, int threads, RepairStats& stats) const;

 private:
  struct KeptMesh {
    std::shared_ptr<MatchedMesh> mesh;
    TetSigns signs;  // that it was made with; empty once it has its pole heights
  };
  void drop_outdone();
  void cut_down(KeptMesh& kept, const std::vector<bool>& gives) const;
  [[nodiscard]] bool may_give(const MatchedMesh& mesh, std::size_t component) const {
    return best_[component] > Agreement::kPartial && mesh.match.agreement[component] >= best_[component];
  }

  std::vector<bool> done_;       // of each exact component
  std::vector<Agreement> best_;  // of each: the best, kWithStrays at most, reached by some mesh
  std::vector<KeptMesh> kept_;   // in the order in which they came
};

}  // namespace deliso

// The meshes of repair that improved some component, and the selection of components from them.
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

// A mesh, and for each vertex the exact component on which its sample lies.
struct AssembledMesh {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> component;
};

class ComponentSelection {
 public:
  explicit ComponentSelection(std::size_t components)
      : done_(components, false), given_up_(components, false), best_(components, Agreement::kNone) {}

  // Of each exact component: whether it is done, or given up.
  [[nodiscard]] const std::vector<bool>& done() const { return done_; }
  [[nodiscard]] bool is_done() const {
    return std::all_of(done_.begin(), done_.end(), [](bool done) { return done; });
  }
  // The best agreement of any mesh so far.
  [[nodiscard]] Agreement best(std::size_t component) const { return best_[component]; }
  // Whether every component is done or given up, or has the right topology but foreign vertices.
  [[nodiscard]] bool is_done_but_for_mixing() const {
    for (std::size_t c = 0; c < best_.size(); ++c) {
      if (best_[c] < Agreement::kMixed && !given_up_[c]) return false;
    }
    return true;
  }
  // Nothing more is done for a component. It is taken from the meshes kept so far, if one of them may give it.
  void give_up(std::uint32_t component) { done_[component] = given_up_[component] = true; }
  [[nodiscard]] const std::vector<bool>& given_up() const { return given_up_; }
  // Keeps a mesh, made with these signs, if it improves some component. Meshes, and parts of meshes, from which no
  // component can be taken any more are dropped.
  void keep(std::shared_ptr<MatchedMesh> mesh, TetSigns signs);
  // Computes the pole heights of the meshes of this round. Call before its triangulation is changed or destroyed.
  void give_poles(RepairRound& round);
  // Takes every component from the latest mesh that agrees with it best. A component is `left` if no mesh has it
  // completely. Precondition: the meshes have pole heights.
  AssembledMesh assemble(std::vector<bool>& left, const Isosurface& isosurface, int threads, RepairStats& stats) const;

 private:
  struct KeptMesh {
    std::shared_ptr<MatchedMesh> mesh;
    TetSigns signs;  // the signs it was made with; empty once it has pole heights
    // Of each exact component, as far as it counts: a second mesh with a displaced handle is no better than the first
    // one, and has more samples.
    std::vector<Agreement> agreement;
  };
  void drop_superseded();
  void cut_down(KeptMesh& kept, const std::vector<bool>& gives) const;
  [[nodiscard]] bool may_give(const KeptMesh& kept, std::size_t component) const {
    return best_[component] > Agreement::kPartial && kept.agreement[component] >= best_[component];
  }

  std::vector<bool> done_;       // of each exact component
  std::vector<bool> given_up_;   // likewise; these are done, too
  std::vector<Agreement> best_;  // of each exact component: the best agreement of any mesh so far, at most kWithStrays
  std::vector<KeptMesh> kept_;   // in the order of keep()
};

}  // namespace deliso

// The shape stage within a patch: its badly shaped triangles, the worst first.
#pragma once

#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "delaunay/base/rng.h"
#include "raycast/isosurface.h"
#include "surface/base/controls.h"
#include "surface/shape/patch.h"
#include "surface/shape/patches.h"
#include "surface/shape/shape_options.h"
#include "surface/shape/shape_steps.h"
#include "surface/shape/step_guard.h"

namespace deliso {

class PatchImprovement {
 public:
  // A step's triangles, old and new, lie within one of the plan's boxes.
  PatchImprovement(NumberedPatch& patch, const PatchPlan& plan, const Isosurface& isosurface,
                   const ShapeOptions& options, Controls controls, ShapeStats& stats);

  // The triangles below a goal: of those given with the patch, and of those added since. (Other bad ones in it belong
  // to other passes, where they have been or will be tried.)
  [[nodiscard]] std::vector<std::uint32_t> bad_triangles(double goal) const;

  // Improves the given triangles as long as steps are found. Each improves the worst of what it replaces and adds no
  // more than one bad triangle beyond those that it removes. `freedom`: by this factor steps may leave the isosurface
  // farther than usual. `depth`: up to so many steps are tried together; from 2 on also shorter ways to better places.
  void run(std::span<const std::uint32_t> bad, double freedom, int depth);
  // Refines the mesh around the given triangles, where that leaves better ones and no more bad ones
  // (local_refinement.cpp). `may_be_far`: on the way.
  void refine_around(std::span<const std::uint32_t> bad, double freedom, bool may_be_far);
  // Looks for better triangles by steps at random, again and again (iterated_search.cpp). `goal`: a sine, at most that
  // of min_angle.
  void search_on(int turns, double goal);

 private:
  struct Queued {
    double quality;
    std::uint32_t triangle;
    // The worst first, then the lowest number.
    friend bool operator<(const Queued& a, const Queued& b) {
      return a.quality != b.quality ? a.quality > b.quality : a.triangle > b.triangle;
    }
  };
  // A step must improve the least quality of what it replaces by this factor: so few steps lead to the end.
  static constexpr double kLeastGain = 1.02;
  // Searches go on until the quality is beyond the goal by this factor.
  static constexpr double kEnough = 1.15;
  // In one round, for so many triangles, the worst ones, several steps are tried together, and for one more of each so
  // many triangles of the patch. It takes hundreds of times as long as single steps, and fields over many magnitudes
  // have thousands of bad triangles that stay. In all rounds: so many times the former, and as many of the latter as in
  // one. (Level sets after advection, saturated scans and orbitals at 1e-12 spent nine tenths of the run here.)
  static constexpr std::size_t kMostSeveral = 20, kTrianglesPerSeveral = 500, kSeveralRounds = 10;
  // So many triangles are tried in one round, and one more of each so many triangles of the patch.
  static constexpr std::size_t kMostTries = 1000, kTrianglesPerTry = 20;

  bool improve(std::uint32_t triangle);
  bool improve_on_the_way();
  [[nodiscard]] bool improves(const PatchStep& step) const;
  std::vector<PatchStep> all_steps(std::uint32_t triangle, bool is_thorough);
  bool improve_by_several(std::uint32_t triangle, int depth);
  struct Replaced {
    double least = 1;     // quality
    std::size_t bad = 0;  // triangles below the goal
  };
  bool try_several(std::uint32_t triangle, const Replaced& old, std::size_t first_added, int depth);
  [[nodiscard]] std::size_t count_bad(std::span<const std::uint32_t> triangles) const;
  [[nodiscard]] std::size_t bad_added(std::size_t first_added) const;
  [[nodiscard]] std::uint32_t worst_added(std::size_t first_added) const;
  // Triangles below the goal: how many, and their qualities, in goals. As logarithms, for the worst count most.
  struct BadLeft {
    std::size_t count = 0;
    double logarithms = 0;  // their sum
    void add(double quality, double goal);
  };
  void search_around(std::uint32_t triangle, int turn, Rng& random);
  void disturb(std::uint32_t triangle, bool is_wide, Rng& random);
  void try_refinement(std::uint32_t triangle, std::vector<std::uint32_t>& tried);
  bool is_improved(const Replaced& old, std::optional<double> old_volume, std::size_t first_added);
  bool refine_until_sound(std::uint32_t triangle, std::size_t first_added);
  std::vector<std::uint32_t> wrong_added(std::size_t first_added);
  bool split_longest(std::uint32_t triangle);
  bool bisect(std::uint32_t triangle, std::size_t corner);
  bool try_step(const PatchStep& step);
  [[nodiscard]] bool betters(const PatchStep& step, std::size_t first_added) const;
  [[nodiscard]] bool has_room(const PatchStep& step);
  [[nodiscard]] double least_removed(const PatchStep& step) const;
  void queue_added(std::size_t first);

  Patch& patch_;
  const std::vector<std::uint32_t> given_;
  const std::uint32_t first_added_;  // triangle, by a step
  const BoxSet& room_;
  bool is_refining_ = false, may_be_far_ = false;
  int depth_ = 1;
  std::size_t several_in_all_, several_left_ = 0;
  double goal_;  // the sine of min_angle
  StepGuard guard_;
  Controls controls_;  // of this patch
  ShapeStats& stats_;
  ShapeSteps steps_;
  std::priority_queue<Queued> queue_;
  std::vector<std::uint32_t> near_;
  std::vector<PatchStep> candidates_;
};

}  // namespace deliso

// Bad triangles that neither steps nor refinement improve: iterated local search (Lourenço, Martin and Stützle,
// Iterated local search, 2003).
//
// Steps end at triangles that are just good enough and leave those beside them no room: at rims of flat parts, in walls
// and necks thinner than triangles are long, with a goal of 30 degrees everywhere. So what is around bad triangles is
// disturbed at random, vertices going some way to a neighbour, sides split, vertices removed; single steps follow.
// Where then fewer triangles are bad, or as many of which the worst is no worse, that stays; else all of it is taken
// back.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "surface/shape/patch_improvement.h"

namespace deliso {

namespace {

constexpr double kFreedom = 16;  // to leave the isosurface, as in the last refinements
// Shares of the triangles around at which there is a step at random.
constexpr double kMoves = 0.5, kSplits = 0.05, kRemovals = 0.05;
constexpr double kLeastWay = 0.1, kLongestWay = 0.5;  // that a vertex goes to a neighbour
constexpr double kLeastQuality = 0.4;                 // of what such a step adds, in goals
// One turn in eight first improves what is just good enough, one in ten tries several steps together.
constexpr int kRaisedTurns = 8, kDeepTurns = 10, kDepth = 3;
constexpr double kRaised = 1.3;  // goals

}  // namespace

void PatchImprovement::search_on(int turns) {
  guard_.set_freedom(kFreedom);
  for (int turn = 0; turn < turns && !controls_.poll(); ++turn) {
    const Replaced before = all_bad();
    if (before.bad == 0) return;
    const std::size_t steps_before = patch_.steps();
    const auto counted = stats_.steps;
    Rng random(static_cast<std::uint64_t>(turn));
    disturb(random);
    if (turn % kRaisedTurns == 0) make_room();
    run(patch_.triangles_below(goal_), kFreedom, turn % kDeepTurns == kDeepTurns - 1 ? kDepth : 1);
    const Replaced now = all_bad();
    if (now.bad < before.bad || (now.bad == before.bad && now.least >= before.least)) continue;
    while (patch_.steps() > steps_before) patch_.undo();
    stats_.steps = counted;
  }
}

PatchImprovement::Replaced PatchImprovement::all_bad() const {
  Replaced all;
  for (const std::uint32_t t : patch_.triangles_below(goal_)) {
    all.least = std::min(all.least, patch_.quality(t));
    ++all.bad;
  }
  return all;
}

// Steps at random at the triangles that share a corner with a bad one.
void PatchImprovement::disturb(Rng& random) {
  std::vector<std::uint32_t> around;
  for (const std::uint32_t t : patch_.triangles_below(goal_)) {
    for (const std::uint32_t v : patch_.corners(t)) {
      around.insert(around.end(), patch_.star(v).begin(), patch_.star(v).end());
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  for (const std::uint32_t t : around) {
    const double kind = random.uniform();
    const std::size_t corner = random.below(3);
    if (!patch_.has(t)) continue;
    candidates_.clear();
    if (kind < kMoves) {
      const auto& corners = patch_.corners(t);
      steps_.displace(corners[corner], corners[(corner + 1) % 3], random.uniform(kLeastWay, kLongestWay), candidates_);
    } else if (kind < kMoves + kSplits) {
      steps_.bisect(t, corner, candidates_);
    } else if (kind < kMoves + kSplits + kRemovals) {
      steps_.propose(ShapeStep::kRemove, t, corner, goal_, candidates_);
    }
    const std::size_t first = patch_.triangle_count();
    if (candidates_.empty() || !has_room(candidates_[0]) || !guard_.apply(candidates_[0])) continue;
    const std::uint32_t worst = worst_added(first);
    if (worst != kNoVertex && patch_.quality(worst) < kLeastQuality * goal_) {
      patch_.undo();
    } else {
      ++stats_.steps[static_cast<std::size_t>(candidates_[0].kind)];
    }
  }
}

// Triangles just good enough get better, where single steps help: so there is room to move them.
void PatchImprovement::make_room() {
  const double goal = goal_;
  goal_ = std::min(1.0, kRaised * goal);
  run(patch_.triangles_below(goal_), kFreedom, 1);
  goal_ = goal;
}

}  // namespace deliso

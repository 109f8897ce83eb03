// Bad triangles that neither steps nor refinement improve: iterated local search (Lourenço, Martin and Stützle,
// Iterated local search, 2003).
//
// Steps end at triangles that are just good enough and leave those beside them no room: at rims of flat parts, in walls
// and necks thinner than triangles are long, with a goal of 30 degrees everywhere. So what is around a bad triangle is
// disturbed at random, vertices going some way to a neighbour, sides split, vertices removed; single steps follow.
// Where then fewer triangles are bad, or as many that are no worse, that stays; else all of it is taken back. One
// triangle after the other: what mends one of many would be taken back with what spoils another.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
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
// One turn in four disturbs what is around bad triangles beside it, too, one in eight first improves what is just good
// enough, one in ten tries several steps together.
constexpr int kWideTurns = 4, kRaisedTurns = 8, kDeepTurns = 10, kDepth = 3;
constexpr double kRaised = 1.3;  // goals

}  // namespace

void PatchImprovement::search_on(int turns, double goal) {
  guard_.set_freedom(kFreedom);
  const double whole_goal = std::exchange(goal_, goal);
  for (int turn = 0; turn < turns; ++turn) {
    const std::vector<std::uint32_t> bad = bad_triangles(goal_);
    if (bad.empty()) break;
    Rng random(static_cast<std::uint64_t>(turn));
    for (const std::uint32_t t : bad) {
      if (controls_.poll()) break;
      if (patch_.has(t)) search_around(t, turn, random);
    }
  }
  goal_ = whole_goal;
}

void PatchImprovement::search_around(std::uint32_t triangle, int turn, Rng& random) {
  const std::size_t steps_before = patch_.steps(), first_added = patch_.triangle_count();
  const auto counted = stats_.steps;
  disturb(triangle, turn % kWideTurns == kWideTurns - 1, random);
  const auto added_below = [&](double goal) {
    std::vector<std::uint32_t> below;
    if (patch_.has(triangle)) below.push_back(triangle);
    for (auto t = static_cast<std::uint32_t>(first_added); t < patch_.triangle_count(); ++t) {
      if (patch_.has(t) && patch_.quality(t) < goal) below.push_back(t);
    }
    return below;
  };
  if (turn % kRaisedTurns == 0) {
    const double goal = std::exchange(goal_, std::min(1.0, kRaised * goal_));
    run(added_below(goal_), kFreedom, 1);
    goal_ = goal;
  }
  run(added_below(goal_), kFreedom, turn % kDeepTurns == kDeepTurns - 1 ? kDepth : 1);
  BadLeft before, now;
  for (const std::uint32_t t : patch_.removed_since(steps_before)) {
    if (t < first_added) before.add(patch_.quality(t), goal_);
  }
  for (auto t = static_cast<std::uint32_t>(first_added); t < patch_.triangle_count(); ++t) {
    if (patch_.has(t)) now.add(patch_.quality(t), goal_);
  }
  if (now.count < before.count || (now.count == before.count && now.logarithms >= before.logarithms)) return;
  while (patch_.steps() > steps_before) patch_.undo();
  stats_.steps = counted;
}

void PatchImprovement::BadLeft::add(double quality, double goal) {
  constexpr double kLeast = 1e-6;  // of one that is too far
  if (quality >= goal) return;
  ++count;
  logarithms += std::log(std::max(quality, kLeast) / goal);
}

// Steps at random at the triangles that share a corner with a bad one; with `is_wide` also with bad ones among these.
void PatchImprovement::disturb(std::uint32_t triangle, bool is_wide, Rng& random) {
  std::vector<std::uint32_t> around;
  const auto add_around = [&](std::uint32_t t) {
    for (const std::uint32_t v : patch_.corners(t)) {
      around.insert(around.end(), patch_.star(v).begin(), patch_.star(v).end());
    }
  };
  add_around(triangle);
  if (is_wide) {
    for (const std::uint32_t t : std::vector(around)) {
      if (patch_.quality(t) < goal_) add_around(t);
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

}  // namespace deliso

#include "surface/shape/patch_improvement.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace deliso {

namespace {

void sort_best_first(std::vector<PatchStep>& steps) {
  std::stable_sort(steps.begin(), steps.end(),
                   [](const PatchStep& a, const PatchStep& b) { return a.quality > b.quality; });
}

}  // namespace

PatchImprovement::PatchImprovement(NumberedPatch& patch, const PatchPlan& plan, const Isosurface& isosurface,
                                   const ShapeOptions& options, Controls controls, ShapeStats& stats)
    : patch_(patch.patch),
      given_(patch.bad),
      first_added_(static_cast<std::uint32_t>(patch_.triangle_count())),
      room_(plan.room),
      several_in_all_(kSeveralRounds * kMostSeveral + patch_.triangle_count() / kTrianglesPerSeveral),
      goal_(std::sin(options.min_angle)),
      guard_(patch_, plan.crossings, isosurface, options, stats.search),
      controls_(std::move(controls)),
      stats_(stats),
      steps_(patch_, isosurface, stats.search) {}

std::vector<std::uint32_t> PatchImprovement::bad_triangles(double goal) const {
  std::vector<std::uint32_t> bad;
  const auto add_bad = [&](std::uint32_t t) {
    if (patch_.has(t) && patch_.quality(t) < goal) bad.push_back(t);
  };
  for (const std::uint32_t t : given_) add_bad(t);
  for (std::uint32_t t = first_added_; t < patch_.triangle_count(); ++t) add_bad(t);
  return bad;
}

void PatchImprovement::run(std::span<const std::uint32_t> bad, double freedom, int depth) {
  guard_.set_freedom(freedom);
  depth_ = depth;
  const std::size_t most_several =
      std::min(several_in_all_, kMostSeveral + patch_.triangle_count() / kTrianglesPerSeveral);
  several_left_ = most_several;
  steps_.set_thorough(depth > 1);
  for (const std::uint32_t t : bad) {
    if (patch_.has(t)) queue_.push({patch_.quality(t), t});
  }
  std::size_t left = kMostTries + patch_.triangle_count() / kTrianglesPerTry;
  for (; !queue_.empty() && left > 0 && !controls_.poll(); --left) {
    const std::uint32_t t = queue_.top().triangle;
    queue_.pop();
    if (patch_.has(t)) improve(t);
  }
  several_in_all_ -= most_several - several_left_;
  queue_ = {};
}

double PatchImprovement::least_removed(const PatchStep& step) const {
  double least = 1;
  for (const std::uint32_t t : step.removed) least = std::min(least, patch_.quality(t));
  return least;
}

// Whether all that the step changes lies within one of the boxes, so that all triangles near it are in the patch.
bool PatchImprovement::has_room(const PatchStep& step) {
  Box3 box;
  for (const std::uint32_t t : step.removed) {
    for (const Vec3& p : patch_.corner_points(t)) box.extend(p);
  }
  if (step.vertex != kNoVertex) box.extend(step.point);
  return room_.holds(box, near_);
}

bool PatchImprovement::try_step(const PatchStep& step) {
  if (!has_room(step)) return false;
  const std::size_t first = patch_.triangle_count();
  const std::size_t most_bad = count_bad(step.removed);
  if (!guard_.apply(step)) return false;
  if (bad_added(first) > most_bad + 1 || !betters(step, first)) {
    patch_.undo();
    return false;
  }
  ++stats_.steps[static_cast<std::size_t>(step.kind)];
  queue_added(first);
  return true;
}

// Whether what was added is as good as the step said: a triangle that is too far counts as the worst of all.
bool PatchImprovement::betters(const PatchStep& step, std::size_t first_added) const {
  const std::uint32_t worst = worst_added(first_added);
  return worst == kNoVertex || patch_.quality(worst) >= goal_ || patch_.quality(worst) > least_removed(step);
}

std::size_t PatchImprovement::count_bad(std::span<const std::uint32_t> triangles) const {
  return static_cast<std::size_t>(
      std::count_if(triangles.begin(), triangles.end(), [&](std::uint32_t t) { return patch_.quality(t) < goal_; }));
}

std::size_t PatchImprovement::bad_added(std::size_t first_added) const {
  std::size_t count = 0;
  for (auto t = static_cast<std::uint32_t>(first_added); t < patch_.triangle_count(); ++t) {
    count += patch_.has(t) && patch_.quality(t) < goal_ ? 1 : 0;
  }
  return count;
}

void PatchImprovement::queue_added(std::size_t first) {
  for (std::size_t t = first; t < patch_.triangle_count(); ++t) {
    const double quality = patch_.quality(static_cast<std::uint32_t>(t));
    if (quality < goal_) queue_.push({quality, static_cast<std::uint32_t>(t)});
  }
}

// The first step that reaches the goal; else, of all, the one that improves most.
bool PatchImprovement::improve(std::uint32_t triangle) {
  candidates_.clear();
  for (std::size_t kind = 0; kind < static_cast<std::size_t>(ShapeStep::kCount); ++kind) {
    // What a refinement has brought would only be taken away.
    const bool takes_away =
        kind == static_cast<std::size_t>(ShapeStep::kRemove) || kind == static_cast<std::size_t>(ShapeStep::kMerge);
    if (is_refining_ && takes_away) continue;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t first = candidates_.size();
      steps_.propose(static_cast<ShapeStep>(kind), triangle, corner, kEnough * goal_, candidates_);
      for (std::size_t i = first; i < candidates_.size(); ++i) {
        if (candidates_[i].quality >= goal_ && try_step(candidates_[i])) return true;
      }
    }
  }
  sort_best_first(candidates_);
  for (const PatchStep& step : candidates_) {
    if (step.quality < goal_ && improves(step) && try_step(step)) return true;
  }
  if (depth_ == 1 || several_left_ == 0) return false;
  --several_left_;
  return improve_on_the_way() || improve_by_several(triangle, depth_);
}

bool PatchImprovement::improves(const PatchStep& step) const {
  return step.quality > std::min(goal_, kLeastGain * least_removed(step));
}

// With places nearer to where the searches started than the best ones, which are refused.
bool PatchImprovement::improve_on_the_way() {
  constexpr int kHalvings = 3;
  for (int i = 0; i < kHalvings; ++i) {
    for (PatchStep& step : candidates_) {
      if (steps_.halve(step) && improves(step) && try_step(step)) return true;
    }
  }
  return false;
}

std::vector<PatchStep> PatchImprovement::all_steps(std::uint32_t triangle, bool is_thorough) {
  std::vector<PatchStep> steps;
  steps_.set_thorough(is_thorough);
  for (std::size_t kind = 0; kind < static_cast<std::size_t>(ShapeStep::kCount); ++kind) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      steps_.propose(static_cast<ShapeStep>(kind), triangle, corner, kEnough * goal_, steps);
    }
  }
  steps_.set_thorough(true);
  sort_best_first(steps);
  return steps;
}

// Several steps that only together are an improvement: after each, one that replaces the worst of what was added. The
// steps of a trial are taken back unless it ends well.
bool PatchImprovement::improve_by_several(std::uint32_t triangle, int depth) {
  const std::size_t first_added = patch_.triangle_count();
  if (!try_several(triangle, {1, 0}, first_added, depth)) return false;
  queue_added(first_added);
  return true;
}

// `old`: what the trial has replaced, of the triangles from before it. After the first step fewer are tried, to less
// good places: that takes half of the time, and 14 to 21 of a hundred trials end well, not 18.
bool PatchImprovement::try_several(std::uint32_t triangle, const Replaced& old, std::size_t first_added, int depth) {
  constexpr std::size_t kMostFirst = 6, kMostLater = 3;
  const bool is_first = patch_.triangle_count() == first_added;
  std::size_t left = is_first ? kMostFirst : kMostLater;
  for (const PatchStep& step : all_steps(triangle, is_first)) {
    if (left == 0) return false;
    Replaced all = old;
    for (const std::uint32_t t : step.removed) {
      if (t >= first_added) continue;
      all.least = std::min(all.least, patch_.quality(t));
      all.bad += patch_.quality(t) < goal_ ? 1 : 0;
    }
    const double wanted = std::min(goal_, kLeastGain * all.least);
    if ((depth == 1 && step.quality <= wanted) || !has_room(step) || !guard_.apply(step)) continue;
    --left;
    const std::uint32_t worst = worst_added(first_added);
    const bool is_better =
        worst == kNoVertex || (patch_.quality(worst) > wanted && bad_added(first_added) <= all.bad + 1);
    if (is_better || (depth > 1 && try_several(worst, all, first_added, depth - 1))) {
      ++stats_.steps[static_cast<std::size_t>(step.kind)];
      return true;
    }
    patch_.undo();
  }
  return false;
}

std::uint32_t PatchImprovement::worst_added(std::size_t first_added) const {
  std::uint32_t worst = kNoVertex;
  for (auto t = static_cast<std::uint32_t>(first_added); t < patch_.triangle_count(); ++t) {
    if (patch_.has(t) && (worst == kNoVertex || patch_.quality(t) < patch_.quality(worst))) worst = t;
  }
  return worst;
}

}  // namespace deliso

// Triangles that no step improves: refined together with what is around them.
//
// In a neck or a wall thinner than its triangles are long no few steps give good angles: the triangles have to be small
// enough first, on both sides of it. So longest sides are split, as in refinement by longest edges (Rivara, New
// longest-edge algorithms for the refinement and/or improvement of unstructured triangulations, 1997), whatever meets
// for now; what is bad, far or meets others is improved by single steps or split further, until nothing is. Where that
// does not end well, all of it is taken back.
#include <algorithm>
#include <optional>
#include <utility>

#include "surface/shape/patch_improvement.h"

namespace deliso {

namespace {

constexpr int kMostTrialSteps = 300;
constexpr std::size_t kMostTurned = 400;  // triangles of a component that a trial could turn inside out
constexpr std::size_t kMostThen = kMostTurned + 4 * std::size_t{kMostTrialSteps};  // that it may come to have
constexpr double kLeastEdge = 1e-2;                                                // that is split, in mesh-space units

double squared_side(const Patch& patch, std::uint32_t t, std::size_t corner) {
  const auto& corners = patch.corners(t);
  return squared_distance(patch.point(corners[(corner + 1) % 3]), patch.point(corners[(corner + 2) % 3]));
}

// The corner across from the longest side.
std::size_t apex_of(const Patch& patch, std::uint32_t t) {
  std::size_t apex = 0;
  for (std::size_t corner = 1; corner < 3; ++corner) {
    if (squared_side(patch, t, corner) > squared_side(patch, t, apex)) apex = corner;
  }
  return apex;
}

}  // namespace

void PatchImprovement::refine_around(std::span<const std::uint32_t> bad, double freedom, bool may_be_far) {
  guard_.set_freedom(freedom);
  depth_ = 1;
  is_refining_ = true;
  may_be_far_ = may_be_far;
  steps_.set_thorough(true);
  std::vector<std::uint32_t> worst_first(bad.begin(), bad.end());
  std::stable_sort(worst_first.begin(), worst_first.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return patch_.quality(a) < patch_.quality(b); });
  std::vector<std::uint32_t> tried;
  std::size_t left = kMostSeveral + patch_.triangle_count() / kTrianglesPerSeveral;
  for (const std::uint32_t t : worst_first) {
    if (left == 0 || controls_.poll()) break;
    if (!patch_.has(t) || std::find(tried.begin(), tried.end(), t) != tried.end()) continue;
    --left;
    try_refinement(t, tried);
  }
  queue_ = {};  // of a trial that was taken back
  is_refining_ = false;
}

// Appends the bad triangles that a refinement taken back had replaced to `tried`.
void PatchImprovement::try_refinement(std::uint32_t triangle, std::vector<std::uint32_t>& tried) {
  const std::size_t steps_before = patch_.steps(), first_added = patch_.triangle_count();
  const auto counted = stats_.steps;
  const std::optional<double> old_volume = guard_.volume_around(triangle, kMostTurned);
  tried.push_back(triangle);
  const bool is_sound = refine_until_sound(triangle, first_added);
  Replaced old;
  const std::size_t first_tried = tried.size();
  for (const std::uint32_t t : patch_.removed_since(steps_before)) {
    if (t >= first_added || patch_.quality(t) >= goal_) continue;
    ++old.bad;
    old.least = std::min(old.least, patch_.quality(t));
    tried.push_back(t);
  }
  if (is_sound && is_improved(old, old_volume, first_added)) {
    tried.resize(first_tried);
    return;
  }
  while (patch_.steps() > steps_before) patch_.undo();
  stats_.steps = counted;
}

// Whether there are no more bad triangles than those replaced, and better ones.
bool PatchImprovement::is_improved(const Replaced& old, std::optional<double> old_volume, std::size_t first_added) {
  const std::uint32_t worst = worst_added(first_added);
  if (worst == kNoVertex || old.bad == 0 || bad_added(first_added) > old.bad) return false;
  if (patch_.quality(worst) < std::min(goal_, kLeastGain * old.least)) return false;
  return guard_.keeps_volume(old_volume, worst, kMostThen);
}

// Whether in the end no triangle added meets another or lies far.
bool PatchImprovement::refine_until_sound(std::uint32_t triangle, std::size_t first_added) {
  guard_.forget_far();
  queue_ = {};
  queue_.push({patch_.quality(triangle), triangle});
  for (int left = kMostTrialSteps; left > 0;) {
    for (; left > 0 && !queue_.empty(); --left) {
      const std::uint32_t t = queue_.top().triangle;
      queue_.pop();
      if (!patch_.has(t) || improve(t)) continue;
      if (split_longest(t) && patch_.has(t)) queue_.push({patch_.quality(t), t});
    }
    const std::vector<std::uint32_t> wrong = wrong_added(first_added);
    if (wrong.empty()) return true;
    bool is_any_split = false;
    for (const std::uint32_t t : wrong) {
      if (left-- == 0) return false;
      is_any_split = (patch_.has(t) && split_longest(t)) || is_any_split;
    }
    if (!is_any_split) return false;
  }
  return false;
}

// The triangles added since that meet others, with these, and those that are far from the isosurface.
std::vector<std::uint32_t> PatchImprovement::wrong_added(std::size_t first_added) {
  std::vector<std::uint32_t> wrong;
  for (auto t = static_cast<std::uint32_t>(first_added); t < patch_.triangle_count(); ++t) {
    if (!patch_.has(t)) continue;
    const std::size_t before = wrong.size();
    guard_.append_meeting(t, wrong);
    if (wrong.size() > before) wrong.push_back(t);
  }
  for (const std::uint32_t t : guard_.far()) {
    if (patch_.has(t)) wrong.push_back(t);
  }
  std::sort(wrong.begin(), wrong.end());
  wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
  return wrong;
}

// Splits the longest side of a triangle, or that of the triangle across where it has a longer one, and so on.
bool PatchImprovement::split_longest(std::uint32_t triangle) {
  constexpr int kLongestPath = 32;
  std::uint32_t t = triangle;
  std::size_t apex = apex_of(patch_, t);
  for (int i = 0; i < kLongestPath; ++i) {
    const auto& corners = patch_.corners(t);
    const std::uint32_t beyond = patch_.across(t, corners[(apex + 1) % 3], corners[(apex + 2) % 3]);
    if (beyond == kNoVertex) break;
    const std::size_t next = apex_of(patch_, beyond);
    if (!(squared_side(patch_, beyond, next) > squared_side(patch_, t, apex))) break;
    t = beyond;
    apex = next;
  }
  return bisect(t, apex);
}

bool PatchImprovement::bisect(std::uint32_t triangle, std::size_t corner) {
  if (squared_side(patch_, triangle, corner) < kLeastEdge * kLeastEdge) return false;
  candidates_.clear();
  steps_.bisect(triangle, corner, candidates_);
  const std::size_t first = patch_.triangle_count();
  guard_.set_lenience(true, may_be_far_);
  const bool is_applied = !candidates_.empty() && has_room(candidates_[0]) && guard_.apply(candidates_[0]);
  guard_.set_lenience(false, false);
  if (!is_applied) return false;
  ++stats_.steps[static_cast<std::size_t>(ShapeStep::kSplit)];
  queue_added(first);
  return true;
}

}  // namespace deliso

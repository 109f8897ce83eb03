#include "surface/sizes/error_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "delaunay/base/parallel.h"
#include "surface/certificate/triangle_nearness.h"
#include "surface/shape/patches.h"
#include "surface/shape/shape_steps.h"
#include "surface/shape/step_guard.h"

namespace deliso {

namespace {

constexpr double kReach = 3;  // of the surroundings of a far triangle, in its longest edges

// The far triangles of one patch.
class NearnessSteps {
 public:
  NearnessSteps(NumberedPatch& patch, const PatchPlan& plan, const ExactSurface& surface, double most,
                const ShapeOptions& options, ShapeStats& stats)
      : patch_(patch.patch),
        room_(plan.room),
        isosurface_(surface.isosurface),
        most_(most),
        guard_(patch_, plan.crossings, isosurface_, options, stats.search),
        steps_(patch_, isosurface_, stats.search),
        stats_(stats),
        left_(patch.bad) {}

  void remove_spikes();
  // Up to `depth` steps are tried together.
  void run(double freedom, int depth, const Controls& controls);

 private:
  [[nodiscard]] double far_area(std::uint32_t t);
  [[nodiscard]] bool is_spike(std::uint32_t v);
  [[nodiscard]] bool has_room(const PatchStep& step);
  // What a trial of several steps has to be better than.
  struct Trial {
    std::uint32_t first_added;  // by the trial
    double old_area = 0;        // too far, of what it has replaced
  };
  bool improve(std::uint32_t t, const Trial& trial, int depth);
  bool try_step(const PatchStep& step, Trial trial, int depth);

  Patch& patch_;
  const BoxSet& room_;
  const Isosurface& isosurface_;
  double most_;
  StepGuard guard_;
  ShapeSteps steps_;
  ShapeStats& stats_;
  std::vector<std::uint32_t> left_, near_;
  struct Known {
    std::array<Vec3, 3> corners;  // the number of a triangle undone may be another's
    double far_area = 0;
  };
  std::vector<Known> known_;  // by triangle
};

// Its area, if samples of it are too far. Most are asked for again and again.
double NearnessSteps::far_area(std::uint32_t t) {
  const auto corners = patch_.corner_points(t);
  if (known_.size() <= t) known_.resize(patch_.triangle_count());
  Known& known = known_[t];
  if (known.corners != corners) {
    const bool is_far = count_far_parts(isosurface_, corners, most_, 1) > 0;
    known = {corners, is_far ? norm(cross(corners[1] - corners[0], corners[2] - corners[0])) : 0};
  }
  return known.far_area;
}

bool NearnessSteps::has_room(const PatchStep& step) {
  Box3 box;
  for (const std::uint32_t t : step.removed) {
    for (const Vec3& p : patch_.corner_points(t)) box.extend(p);
  }
  if (step.vertex != kNoVertex) box.extend(step.point);
  return room_.holds(box, near_);
}

// A vertex of one sheet to which another has come to reach: most of its triangles span what is no isosurface. What it
// covers alone is missed then, and is looked for where it is.
void NearnessSteps::remove_spikes() {
  constexpr double kEnough = 0.3;  // the sine of an angle that is good enough
  guard_.set_freedom(16);
  guard_.set_witnesses(false);
  std::vector<PatchStep> steps;
  for (std::size_t i = 0; i < left_.size(); ++i) {
    const std::uint32_t t = left_[i];
    for (std::size_t corner = 0; corner < 3 && patch_.has(t); ++corner) {
      if (!is_spike(patch_.corners(t)[corner])) continue;
      steps.clear();
      steps_.propose(ShapeStep::kRemove, t, corner, kEnough, steps);
      const auto first = static_cast<std::uint32_t>(patch_.triangle_count());
      const bool is_done = std::any_of(steps.begin(), steps.end(),
                                       [&](const PatchStep& step) { return has_room(step) && guard_.apply(step); });
      if (!is_done) continue;
      ++stats_.steps[static_cast<std::size_t>(ShapeStep::kRemove)];
      for (std::uint32_t added = first; added < patch_.triangle_count(); ++added) left_.push_back(added);
    }
  }
  guard_.set_witnesses(true);
}

bool NearnessSteps::is_spike(std::uint32_t v) {
  constexpr double kMost = 0.5;  // of the area around it
  double area = 0, far = 0;
  for (const std::uint32_t t : patch_.star(v)) {
    const auto [a, b, c] = patch_.corner_points(t);
    area += norm(cross(b - a, c - a));
    far += far_area(t);
  }
  return far > kMost * area;
}

void NearnessSteps::run(double freedom, int depth, const Controls& controls) {
  guard_.set_freedom(freedom);
  Controls own = controls;
  constexpr std::size_t kMostTogether = 24;  // triangles for which several steps are tried
  std::size_t tries = depth > 1 ? kMostTogether : 20 + 20 * left_.size();
  std::vector<std::uint32_t> stuck;
  while (!left_.empty() && tries-- > 0 && !own.poll()) {
    const std::uint32_t t = left_.back();
    left_.pop_back();
    if (!patch_.has(t) || far_area(t) == 0) continue;
    const auto first = static_cast<std::uint32_t>(patch_.triangle_count());
    if (!improve(t, {first}, depth)) {
      stuck.push_back(t);
      continue;
    }
    for (std::uint32_t added = first; added < patch_.triangle_count(); ++added) left_.push_back(added);
  }
  left_.insert(left_.end(), stuck.begin(), stuck.end());
}

bool NearnessSteps::improve(std::uint32_t t, const Trial& trial, int depth) {
  constexpr double kEnough = 0.3;  // the sine of an angle that is good enough
  std::vector<PatchStep> steps;
  for (std::size_t kind = 0; kind < static_cast<std::size_t>(ShapeStep::kCount); ++kind) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      steps_.propose(static_cast<ShapeStep>(kind), t, corner, kEnough, steps);
    }
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const PatchStep& a, const PatchStep& b) { return a.quality > b.quality; });
  return std::any_of(steps.begin(), steps.end(), [&](const PatchStep& step) { return try_step(step, trial, depth); });
}

// Keeps a step that leaves less area too far than there was, or one after which another one does.
bool NearnessSteps::try_step(const PatchStep& step, Trial trial, int depth) {
  constexpr double kLess = 0.9;
  for (const std::uint32_t t : step.removed) trial.old_area += t < trial.first_added ? far_area(t) : 0;
  if (!has_room(step) || !guard_.apply(step)) return false;
  double area = 0, worst_area = 0;
  std::uint32_t worst = kNoVertex;
  for (std::uint32_t t = trial.first_added; t < patch_.triangle_count(); ++t) {
    const double its = patch_.has(t) ? far_area(t) : 0;
    area += its;
    if (its > worst_area) {
      worst_area = its;
      worst = t;
    }
  }
  if (area <= kLess * trial.old_area || (depth > 1 && worst != kNoVertex && improve(worst, trial, depth - 1))) {
    ++stats_.steps[static_cast<std::size_t>(step.kind)];
    return true;
  }
  patch_.undo();
  return false;
}

}  // namespace

void bring_near(SurfaceMesh& mesh, const ExactSurface& surface, std::span<const std::uint32_t> far,
                const Nearness& wanted, const ShapeOptions& options, const Controls& controls, ShapeStats& stats) {
  if (far.empty()) return;
  const std::vector<PatchPlan> plans = plan_patches(mesh, far, kReach, surface);
  work_in_patches(mesh, plans, surface.threads, stats,
                  [&](NumberedPatch& patch, const PatchPlan& plan, ShapeStats& counted) {
                    NearnessSteps steps(patch, plan, surface, wanted.most, options, counted);
                    const Controls part = controls.for_part(1, mesh.points.size());
                    if (wanted.removes_spikes) steps.remove_spikes();
                    for (const double freedom : {1.0, 4.0, 16.0}) steps.run(freedom, 1, part);
                    for (const int depth : {2, 3}) steps.run(16, depth, part);  // a few
                  });
}

}  // namespace deliso

#include "surface/sizes/error_steps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "delaunay/base/parallel.h"
#include "surface/certificate/geometry_check.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/box_tree.h"
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

  // Up to `depth` steps are tried together.
  void run(double freedom, int depth, const Controls& controls);

 private:
  [[nodiscard]] double far_area(std::uint32_t t) const;
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
};

// Its area, as far as samples of it are too far.
double NearnessSteps::far_area(std::uint32_t t) const {
  const auto corners = patch_.corner_points(t);
  const std::int64_t count = count_far_samples(isosurface_, corners, most_);
  const double area = norm(cross(corners[1] - corners[0], corners[2] - corners[0]));
  return count == 0 ? 0 : area;
}

bool NearnessSteps::has_room(const PatchStep& step) {
  Box3 box;
  for (const std::uint32_t t : step.removed) {
    for (const Vec3& p : patch_.corner_points(t)) box.extend(p);
  }
  if (step.vertex != kNoVertex) box.extend(step.point);
  return room_.holds(box, near_);
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

void bring_near(SurfaceMesh& mesh, const ExactSurface& surface, std::span<const std::uint32_t> far, double most,
                const ShapeOptions& options, const Controls& controls, ShapeStats& stats) {
  if (far.empty()) return;
  const std::vector<PatchPlan> plans = plan_patches(mesh, far, kReach, surface);
  work_in_patches(mesh, plans, surface.threads, stats,
                  [&](NumberedPatch& patch, const PatchPlan& plan, ShapeStats& counted) {
                    NearnessSteps steps(patch, plan, surface, most, options, counted);
                    const Controls part = controls.for_part(1, mesh.points.size());
                    for (const double freedom : {1.0, 4.0, 16.0}) steps.run(freedom, 1, part);
                    for (const int depth : {2, 3}) steps.run(16, depth, part);  // a few
                  });
}

namespace {

// The nearest of a patch's triangles; kNoVertex if there is none.
std::uint32_t nearest_in(const Patch& patch, const Vec3& p) {
  std::uint32_t nearest = kNoVertex;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t t = 0; t < patch.triangle_count(); ++t) {
    if (!patch.has(t)) continue;
    const auto [a, b, c] = patch.corner_points(t);
    const double squared = squared_distance_to_triangle(p, a, b, c);
    if (squared < least) {
      least = squared;
      nearest = t;
    }
  }
  return nearest;
}

// The star of a new vertex over the rim of a triangle and those of its neighbours that `sides` names, as bits.
PatchStep star_step(const Patch& patch, std::uint32_t t, const Vec3& p, unsigned sides) {
  PatchStep step;
  step.kind = ShapeStep::kInsert;
  step.removed = {t};
  step.vertex = static_cast<std::uint32_t>(patch.vertex_count());
  step.point = step.start = p;
  const auto& corners = patch.corners(t);
  for (unsigned side = 0; side < 3; ++side) {
    const std::uint32_t a = corners[(side + 1) % 3], b = corners[(side + 2) % 3];
    const std::uint32_t beyond = (sides >> side & 1u) != 0 ? patch.across(t, a, b) : kNoVertex;
    if (beyond == kNoVertex) {
      step.added.push_back({step.vertex, a, b});
      continue;
    }
    const auto& others = patch.corners(beyond);
    const std::uint32_t apex =
        *std::find_if(others.begin(), others.end(), [&](std::uint32_t v) { return v != a && v != b; });
    step.removed.push_back(beyond);
    step.added.push_back({step.vertex, a, apex});
    step.added.push_back({step.vertex, apex, b});
  }
  return step;
}

// The star of a new vertex over the rim of some triangles. Corners that are theirs alone are gone.
PatchStep cavity_step(const Patch& patch, const std::vector<std::uint32_t>& cavity, const Vec3& p) {
  PatchStep step;
  step.kind = ShapeStep::kInsert;
  step.removed = cavity;
  step.vertex = static_cast<std::uint32_t>(patch.vertex_count());
  step.point = step.start = p;
  for (const std::uint32_t t : cavity) {
    const auto& corners = patch.corners(t);
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t a = corners[(side + 1) % 3], b = corners[(side + 2) % 3];
      const std::uint32_t beyond = patch.across(t, a, b);
      if (std::find(cavity.begin(), cavity.end(), beyond) == cavity.end()) step.added.push_back({step.vertex, a, b});
    }
  }
  return step;
}

// The triangles around a vertex, as far as they face a point that is beyond it, or all face away from one below it.
std::vector<std::uint32_t> facing(const Patch& patch, std::uint32_t v, const Vec3& p) {
  const auto side = [&](std::uint32_t t) {
    const auto [a, b, c] = patch.corner_points(t);
    return dot(cross(b - a, c - a), p - patch.point(v));
  };
  double sum = 0;
  for (const std::uint32_t t : patch.star(v)) sum += side(t);
  std::vector<std::uint32_t> found;
  for (const std::uint32_t t : patch.star(v)) {
    if ((side(t) > 0) == (sum > 0)) found.push_back(t);
  }
  return found;
}

// A tip of a finger may stand out beyond a vertex: over the rim of what faces it, or of all triangles around the
// vertex, which is gone then.
std::vector<PatchStep> tip_steps(const Patch& patch, std::uint32_t t, const Vec3& p) {
  const auto& corners = patch.corners(t);
  const std::uint32_t nearest =
      *std::min_element(corners.begin(), corners.end(), [&](std::uint32_t v, std::uint32_t u) {
        return squared_distance(patch.point(v), p) < squared_distance(patch.point(u), p);
      });
  const std::span<const std::uint32_t> star = patch.star(nearest);
  return {cavity_step(patch, facing(patch, nearest, p), p), cavity_step(patch, {star.begin(), star.end()}, p)};
}

void insert_in(NumberedPatch& numbered, const PatchPlan& plan, std::span<const Vec3> missed,
               const ExactSurface& surface, const ShapeOptions& options, ShapeStats& stats) {
  constexpr double kFreedom = 16;
  Patch& patch = numbered.patch;
  StepGuard guard(patch, plan.crossings, surface.isosurface, options, stats.search);
  guard.set_freedom(kFreedom);
  std::vector<std::uint32_t> near;
  for (const Vec3& p : missed) {
    Box3 at;
    at.extend(p);
    if (!plan.room.holds(at, near)) continue;
    const std::uint32_t t = nearest_in(patch, p);
    if (t == kNoVertex) continue;
    const auto& corners = patch.corners(t);
    if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return patch.point(v) == p; })) continue;
    std::vector<PatchStep> steps;
    for (const unsigned sides : {7u, 0u, 1u, 2u, 4u, 3u, 5u, 6u}) steps.push_back(star_step(patch, t, p, sides));
    for (PatchStep& step : tip_steps(patch, t, p)) steps.push_back(std::move(step));
    const bool is_done =
        std::any_of(steps.begin(), steps.end(), [&](const PatchStep& step) { return guard.apply(step); });
    if (is_done) ++stats.steps[static_cast<std::size_t>(ShapeStep::kInsert)];
  }
}

}  // namespace

void insert_missed(SurfaceMesh& mesh, const ExactSurface& surface, std::span<const Vec3> missed,
                   const ShapeOptions& options, const Controls& controls, ShapeStats& stats) {
  Controls own = controls;
  if (missed.empty() || own.poll()) return;
  const BoxTree tree(
      mesh.triangles.size(), [&](std::size_t t) { return box_of(mesh, static_cast<std::uint32_t>(t)); },
      surface.threads);
  std::vector<std::uint32_t> nearest;
  const double farthest = surface.isosurface.box().diagonal();
  for (const Vec3& p : missed) {
    const auto measure = [&](std::uint32_t t) {
      const auto& [a, b, c] = mesh.triangles[t];
      return squared_distance_to_triangle(p, mesh.points[a], mesh.points[b], mesh.points[c]);
    };
    const std::uint32_t t = tree.nearest(p, farthest * farthest, measure).first;
    if (t != BoxTree::kNone) nearest.push_back(t);
  }
  std::sort(nearest.begin(), nearest.end());
  nearest.erase(std::unique(nearest.begin(), nearest.end()), nearest.end());
  const std::vector<PatchPlan> plans = plan_patches(mesh, nearest, kReach, surface);
  work_in_patches(mesh, plans, surface.threads, stats,
                  [&](NumberedPatch& patch, const PatchPlan& plan, ShapeStats& counted) {
                    insert_in(patch, plan, missed, surface, options, counted);
                  });
}

}  // namespace deliso

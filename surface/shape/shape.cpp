#include "surface/shape/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "delaunay/base/parallel.h"
#include "surface/base/parallel_blocks.h"
#include "surface/mesh/triangle_shape.h"
#include "surface/shape/patch_improvement.h"
#include "surface/shape/patches.h"

namespace deliso {

namespace {

constexpr double kReach = 3;         // of the surroundings of a bad triangle, in its longest edges
constexpr int kMostDepth = 3;        // of steps that are tried together
constexpr double kMostFreedom = 16;  // to leave the isosurface (patch_improvement.h)
constexpr std::size_t kMostWorst = 10;
constexpr std::size_t kMostBoxes = 1000;  // of a patch that is worked on as a whole

std::vector<std::uint32_t> bad_triangles(const SurfaceMesh& mesh, double goal, int threads) {
  return collect_in_blocks<std::uint32_t>(
      mesh.triangles.size(), threads, [&](std::size_t t, std::vector<std::uint32_t>& bad) {
        const auto& [a, b, c] = mesh.triangles[t];
        if (!(squared_sine_of_least_angle(mesh.points[a], mesh.points[b], mesh.points[c]) >= goal * goal)) {
          bad.push_back(static_cast<std::uint32_t>(t));
        }
      });
}

// Steps first; then refinements, one after the other freer to leave the isosurface.
void improve_patch(NumberedPatch& patch, PatchImprovement& improvement, double goal, int rounds) {
  for (int round = 0; round < rounds && !patch.bad.empty(); ++round) {
    improvement.run(patch.bad, std::ldexp(2.0, round), std::min(round + 1, kMostDepth));
    patch.bad = patch.patch.triangles_below(goal);
  }
  if (rounds < kMostDepth) return;
  struct Refinement {
    double freedom;
    bool may_be_far;
  };
  for (const auto& [freedom, may_be_far] : {Refinement{4, false}, {kMostFreedom, false}, {kMostFreedom, true}}) {
    if (patch.bad.empty()) return;
    improvement.refine_around(patch.bad, freedom, may_be_far);
    patch.bad = patch.patch.triangles_below(goal);
  }
}

// Turns of iterated search for each of so many bad triangles of a mesh: no fewer than these, or none.
constexpr std::size_t kFewestTurns = 25;
constexpr std::size_t kTrianglesPerTurn = 50, kTurnsAtLeast = 400;  // of all bad triangles together

int turns_of_search(std::size_t bad, std::size_t triangles) {
  constexpr std::size_t kMostTurns = 200;
  if (bad == 0) return 0;
  const std::size_t turns = std::min(kMostTurns, (kTurnsAtLeast + triangles / kTrianglesPerTurn) / bad);
  return turns < kFewestTurns ? 0 : static_cast<int>(turns);
}

// The goal that is missed by no more triangles than can be searched for. Masks and labels have one bad triangle in a
// few hundred: for all of them it would take longer than all else, for the worst of them it does not.
double goal_of_search(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double goal) {
  // Of a sine: its square, which is compared, may be rounded to more than that of the same triangle.
  constexpr double kJustBelow = 1 - 1e-12;
  const std::size_t most = (kTurnsAtLeast + mesh.triangles.size() / kTrianglesPerTurn) / kFewestTurns;
  if (bad.size() <= most) return goal;
  std::vector<double> sines;
  sines.reserve(bad.size());
  for (const std::uint32_t t : bad) {
    const auto& [a, b, c] = mesh.triangles[t];
    sines.push_back(sine_of_least_angle(mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  const auto first_without = sines.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(sines.begin(), first_without, sines.end());
  return kJustBelow * *first_without;
}

void forget_known(const SurfaceMesh& mesh, const KnownTriangles& known, std::vector<std::uint32_t>& triangles) {
  std::erase_if(triangles, [&](std::uint32_t t) { return known.has(mesh, t); });
}

// Has the patches of each pass worked on: work(patch, plan, counted).
template <class Work>
void work_in_passes(SurfaceMesh& mesh, std::vector<std::uint32_t> bad, const KnownTriangles& left,
                    const ExactSurface& surface, double goal, Controls& controls, ShapeStats& stats, const Work& work) {
  const PatchBoxes boxes(mesh, bad, kReach, kMostBoxes);
  for (std::size_t pass = 0; pass < boxes.passes().size() && !controls.poll(); ++pass) {
    if (pass > 0) {
      bad = bad_triangles(mesh, goal, surface.threads);
      forget_known(mesh, left, bad);
    }
    controls.report("shape", mesh.points.size(), bad.size());
    work_in_patches(mesh, plan_pass(mesh, bad, boxes, pass, surface), surface.threads, stats, work);
  }
}

}  // namespace

void improve_shape(SurfaceMesh& mesh, const ExactSurface& surface, const ShapeOptions& options, Controls& controls,
                   ShapeStats& stats, KnownTriangles& left) {
  double goal = std::sin(options.min_angle);
  std::vector<std::uint32_t> bad = bad_triangles(mesh, goal, surface.threads);
  forget_known(mesh, left, bad);
  stats.bad_before += static_cast<std::int64_t>(bad.size());
  const auto improve = [&](int rounds, int turns) {
    work_in_passes(mesh, bad, left, surface, goal, controls, stats,
                   [&](NumberedPatch& patch, const PatchPlan& plan, ShapeStats& part) {
                     PatchImprovement improvement(patch.patch, plan, surface.isosurface, options,
                                                  controls.for_part(1, mesh.points.size()), part);
                     improve_patch(patch, improvement, goal, rounds);
                     improvement.search_on(turns, goal);
                   });
  };
  improve(options.rounds, 0);
  if (options.rounds < kMostDepth || controls.poll()) return;
  // What these have left is searched for on its own, in smaller patches.
  bad = bad_triangles(mesh, goal, surface.threads);
  forget_known(mesh, left, bad);
  const double lower = goal_of_search(mesh, bad, goal);
  if (lower < goal) {
    bad = bad_triangles(mesh, lower, surface.threads);
    forget_known(mesh, left, bad);
  }
  goal = lower;
  const int turns = turns_of_search(bad.size(), mesh.triangles.size());
  if (turns > 0) improve(0, turns);
  if (controls.poll()) return;
  for (const std::uint32_t t : bad_triangles(mesh, std::sin(options.min_angle), surface.threads)) left.add(mesh, t);
}

void count_bad_triangles(const SurfaceMesh& mesh, const ShapeOptions& options, int threads, ShapeStats& stats) {
  const std::vector<std::uint32_t> bad = bad_triangles(mesh, std::sin(options.min_angle), threads);
  stats.bad_after = static_cast<std::int64_t>(bad.size());
  stats.worst.clear();
  for (const std::uint32_t t : bad) {
    const auto& [a, b, c] = mesh.triangles[t];
    const std::array<Vec3, 3> corners = {mesh.points[a], mesh.points[b], mesh.points[c]};
    stats.worst.push_back(
        {sine_of_least_angle(corners[0], corners[1], corners[2]), (corners[0] + corners[1] + corners[2]) / 3});
  }
  stats.keep_worst(kMostWorst);
}

void replace_wrong_triangles(SurfaceMesh& mesh, std::span<const std::uint32_t> wrong, const ExactSurface& surface,
                             const ShapeOptions& options, Controls& controls, ShapeStats& stats) {
  const double goal = std::sin(options.min_angle);
  const std::size_t triangles = mesh.triangles.size();
  const std::vector<PatchPlan> plans = plan_patches(mesh, wrong, kReach, surface);
  work_in_patches(mesh, plans, surface.threads, stats,
                  [&](NumberedPatch& patch, const PatchPlan& plan, ShapeStats& part) {
                    for (const std::uint32_t t : patch.bad) patch.patch.spoil(t);
                    PatchImprovement improvement(patch.patch, plan, surface.isosurface, options,
                                                 controls.for_part(1, mesh.points.size()), part);
                    improve_patch(patch, improvement, goal, options.rounds);
                    // The search is for all that are bad in a patch, on masks many more than are wrong. The turns are
                    // shared as if the other patches had as many.
                    improvement.search_on(turns_of_search(plans.size() * patch.bad.size(), triangles), goal);
                  });
}

}  // namespace deliso

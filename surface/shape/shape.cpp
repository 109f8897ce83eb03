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
// The first rounds are for all bad triangles, those after them, which take ten times as long for each, for so many.
constexpr int kShallowRounds = 2;
constexpr std::size_t kDeepAtLeast = 1000, kTrianglesPerDeep = 500;

std::vector<std::uint32_t> bad_triangles(const SurfaceMesh& mesh, double goal, int threads) {
  return collect_in_blocks<std::uint32_t>(
      mesh.triangles.size(), threads, [&](std::size_t t, std::vector<std::uint32_t>& bad) {
        const auto& [a, b, c] = mesh.triangles[t];
        if (!(squared_sine_of_least_angle(mesh.points[a], mesh.points[b], mesh.points[c]) >= goal * goal)) {
          bad.push_back(static_cast<std::uint32_t>(t));
        }
      });
}

// Rounds of steps from `first` to before `end`, each freer to leave the isosurface.
void improve_by_steps(PatchImprovement& improvement, double goal, int first, int end) {
  std::vector<std::uint32_t> bad = improvement.bad_triangles(goal);
  for (int round = first; round < end && !bad.empty(); ++round) {
    improvement.run(bad, std::ldexp(2.0, round), std::min(round + 1, kMostDepth));
    bad = improvement.bad_triangles(goal);
  }
}

// Refinements, one after the other freer to leave the isosurface.
void improve_by_refinement(PatchImprovement& improvement, double goal) {
  struct Refinement {
    double freedom;
    bool may_be_far;
  };
  for (const auto& [freedom, may_be_far] : {Refinement{4, false}, {kMostFreedom, false}, {kMostFreedom, true}}) {
    const std::vector<std::uint32_t> bad = improvement.bad_triangles(goal);
    if (bad.empty()) return;
    improvement.refine_around(bad, freedom, may_be_far);
  }
}

// Turns of iterated search for all bad triangles of a mesh together, where others have been spent already: in calls for
// a few components from finer cubes, those of the first for all of the mesh. A quarter is always left.
std::size_t turns_left(std::size_t triangles, std::size_t spent) {
  constexpr std::size_t kTrianglesPerTurn = 30, kTurnsAtLeast = 400;
  const std::size_t all = triangles / kTrianglesPerTurn;
  return kTurnsAtLeast + all - std::min(all / 4 * 3, spent);
}

constexpr std::size_t kFewestTurns = 25;  // for each of them, or none
constexpr int kMostTurns = 200;
constexpr std::size_t kVeryWorst = 16;  // one in so many of those searched for

int turns_for_each(std::size_t bad, std::size_t turns) {
  if (bad == 0 || turns / bad < kFewestTurns) return 0;
  return static_cast<int>(std::min(std::size_t{kMostTurns}, turns / bad));
}

// The goal that is missed by no more than `most` triangles. Masks and labels have one bad triangle in a few hundred:
// for all of them deep search would take longer than all else, for the worst of them it does not.
double lowered_goal(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double goal, std::size_t most) {
  // Of a sine: its square, which is compared, may be rounded to more than that of the same triangle.
  constexpr double kJustBelow = 1 - 1e-12;
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

}  // namespace

void improve_shape(SurfaceMesh& mesh, const ExactSurface& surface, const ShapeOptions& options, Controls& controls,
                   ShapeStats& stats, KnownTriangles& left) {
  const double goal = std::sin(options.min_angle);
  const auto bad_now = [&](double below) {
    std::vector<std::uint32_t> bad = bad_triangles(mesh, below, surface.threads);
    std::erase_if(bad, [&](std::uint32_t t) { return left.has(mesh, t); });
    return bad;
  };
  std::vector<std::uint32_t> bad = bad_now(goal);
  stats.bad_before += std::ssize(bad);
  // Each phase works on so many of the worst of what those before have left, in patches of their own.
  const auto improve = [&](std::size_t most, const auto& work) {
    if (bad.empty() || controls.poll()) return;
    const double lower = lowered_goal(mesh, bad, goal, most);
    if (lower < goal) bad = bad_now(lower);
    const PatchBoxes boxes(mesh, bad, kReach, kMostBoxes);
    for (std::size_t pass = 0; pass < boxes.passes().size() && !controls.poll(); ++pass) {
      if (pass > 0) bad = bad_now(lower);
      controls.report("shape", mesh.points.size(), bad.size());
      work_in_patches(mesh, plan_pass(mesh, bad, boxes, pass, surface), surface.threads, stats,
                      [&](NumberedPatch& patch, const PatchPlan& plan, ShapeStats& part) {
                        PatchImprovement improvement(patch, plan, surface.isosurface, options,
                                                     controls.for_part(1, mesh.points.size()), part);
                        work(improvement, lower);
                      });
    }
    bad = bad_now(goal);
  };
  const std::size_t triangles = mesh.triangles.size();
  const int shallow = std::min(options.rounds, kShallowRounds);
  improve(triangles, [&](auto& patch, double below) { improve_by_steps(patch, below, 0, shallow); });
  improve(kDeepAtLeast + triangles / kTrianglesPerDeep, [&](auto& patch, double below) {
    improve_by_steps(patch, below, shallow, options.rounds);
    if (options.rounds >= kMostDepth) improve_by_refinement(patch, below);
  });
  if (options.rounds < kMostDepth) return;
  const std::size_t all_turns = turns_left(triangles, stats.turns);
  const auto search = [&](std::size_t most, int turns) {
    const std::size_t searched = std::min(bad.size(), most);
    improve(most, [&](auto& patch, double below) { patch.search_on(turns, below); });
    stats.turns += searched * static_cast<std::size_t>(turns);
  };
  const std::size_t most = all_turns / kFewestTurns;
  search(most, turns_for_each(std::min(bad.size(), most), all_turns));
  // The very worst, by which a mesh is judged, once more for as long as a few would be.
  if (bad.size() > most) search(most / kVeryWorst, kMostTurns);
  if (controls.poll()) return;
  for (const std::uint32_t t : bad) left.add(mesh, t);
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
                    PatchImprovement improvement(patch, plan, surface.isosurface, options,
                                                 controls.for_part(1, mesh.points.size()), part);
                    improve_by_steps(improvement, goal, 0, options.rounds);
                    if (options.rounds >= kMostDepth) improve_by_refinement(improvement, goal);
                    // The turns are shared as if the other patches had as many left.
                    const std::size_t left = plans.size() * improvement.bad_triangles(goal).size();
                    improvement.search_on(turns_for_each(left, turns_left(triangles, 0)), goal);
                  });
}

}  // namespace deliso

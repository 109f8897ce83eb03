#include "surface/sizes/long_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/base/parallel.h"
#include "surface/base/parallel_blocks.h"
#include "surface/shape/patches.h"
#include "surface/shape/shape_steps.h"
#include "surface/shape/step_guard.h"

namespace deliso {

namespace {

constexpr double kAroundEdge = 2;  // of the surroundings of a long edge, in its triangle's longest edges
constexpr double kFreedom = 16;    // a split brings vertices to the isosurface: what it replaces was no nearer

// The lengths of a triangle's sides, across from its corners.
std::array<double, 3> sides_of(const Patch& patch, std::uint32_t t) {
  const auto [a, b, c] = patch.corner_points(t);
  return {distance(b, c), distance(c, a), distance(a, b)};
}

void split_in(NumberedPatch& numbered, const PatchPlan& plan, const ExactSurface& surface, const ShapeOptions& options,
              Controls controls, ShapeStats& stats) {
  Patch& patch = numbered.patch;
  StepGuard guard(patch, plan.crossings, surface.isosurface, options, stats.search);
  guard.set_freedom(kFreedom);
  ShapeSteps steps(patch, surface.isosurface, stats.search);
  std::vector<std::uint32_t> left = numbered.bad;
  for (std::size_t at = 0; at < left.size() && !controls.poll(); ++at) {
    const std::uint32_t t = left[at];
    if (!patch.has(t)) continue;
    const std::array<double, 3> sides = sides_of(patch, t);
    const auto corner = static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
    if (!(sides[corner] > options.max_edge)) continue;
    std::vector<PatchStep> found;
    steps.propose(ShapeStep::kSplit, t, corner, 0, found);
    const auto first = static_cast<std::uint32_t>(patch.triangle_count());
    const auto is_done = [&](const PatchStep& step) { return guard.apply(step); };
    if (std::none_of(found.begin(), found.end(), is_done)) continue;
    ++stats.steps[static_cast<std::size_t>(ShapeStep::kSplit)];
    for (std::uint32_t added = first; added < patch.triangle_count(); ++added) left.push_back(added);
  }
}

}  // namespace

void split_long_edges(SurfaceMesh& mesh, const ExactSurface& surface, const ShapeOptions& options,
                      const Controls& controls, ShapeStats& stats) {
  const double most = options.max_edge * options.max_edge;
  const auto longer = collect_in_blocks<std::uint32_t>(
      mesh.triangles.size(), surface.threads, [&](std::size_t t, std::vector<std::uint32_t>& found) {
        if (squared_longest_edge(mesh, static_cast<std::uint32_t>(t)) > most) found.push_back(std::uint32_t(t));
      });
  if (longer.empty()) return;
  const std::vector<PatchPlan> plans = plan_patches(mesh, longer, kAroundEdge, surface);
  work_in_patches(mesh, plans, surface.threads, stats,
                  [&](NumberedPatch& patch, const PatchPlan& plan, ShapeStats& part) {
                    split_in(patch, plan, surface, options, controls.for_part(1, mesh.points.size()), part);
                  });
}

}  // namespace deliso

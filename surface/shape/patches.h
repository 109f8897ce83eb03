// The patches of a mesh: disjoint surroundings of its badly shaped triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/base/parallel.h"
#include "surface/base/exact_surface.h"
#include "surface/mesh/surface_mesh.h"
#include "surface/shape/box_set.h"
#include "surface/shape/patch.h"
#include "surface/shape/patch_boxes.h"
#include "surface/shape/shape_options.h"

namespace deliso {

struct PatchPlan {
  BoxSet room;                           // boxes around the bad triangles; those of different patches do not meet
  std::vector<std::uint32_t> bad;        // triangles of the mesh
  std::vector<std::uint32_t> triangles;  // of the mesh, that meet the boxes, ascending
  std::vector<Vec3> crossings;           // of the isosurface with edges of the grid, in the boxes
};

// The triangles of a mesh that meet one of some boxes, ascending. The same for any number of threads.
std::vector<std::uint32_t> triangles_meeting(const SurfaceMesh& mesh, const BoxSet& boxes, int threads);

// The patches of a pass: `bad` are the bad triangles of the mesh as earlier passes have left it. The same for any
// number of threads.
std::vector<PatchPlan> plan_pass(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, const PatchBoxes& boxes,
                                 std::size_t pass, const ExactSurface& surface);
// One patch for all bad triangles whose boxes, with this reach, overlap one after the other, however many.
std::vector<PatchPlan> plan_patches(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double reach,
                                    const ExactSurface& surface);

// A patch with the numbers that its vertices and triangles have in the mesh.
struct NumberedPatch {
  Patch patch;
  std::vector<std::uint32_t> vertices;  // of the patch's first vertices, ascending
  std::vector<std::uint32_t> bad;       // triangles of the patch
};

// The mean length of the edges of some triangles (mesh-space units); 0 of none.
double mean_edge(const SurfaceMesh& mesh, std::span<const std::uint32_t> triangles);

NumberedPatch take_patch(const SurfaceMesh& mesh, const PatchPlan& plan);

// Brings what was changed in patches into the mesh, which then has neither neighbours nor pole heights; removes
// vertices without triangles.
void put_back(std::span<const PatchPlan> plans, std::span<const NumberedPatch> patches, SurfaceMesh& mesh);

// The plans' numbers, those with the most bad triangles first, so that no long one is begun last.
std::vector<std::size_t> longest_first(std::span<const PatchPlan> plans);

// Takes the patches, has each worked on apart from the others, on any thread, and puts them back: work(patch, plan,
// counted), whose counters are added to `stats` in the order of the plans.
template <class Work>
void work_in_patches(SurfaceMesh& mesh, std::span<const PatchPlan> plans, int threads, ShapeStats& stats,
                     const Work& work) {
  std::vector<NumberedPatch> patches(plans.size());
  std::vector<ShapeStats> counted(plans.size());
  const std::vector<std::size_t> order = longest_first(plans);
  run_tasks(plans.size(), threads, [&](std::size_t i) {
    const std::size_t k = order[i];
    patches[k] = take_patch(mesh, plans[k]);
    work(patches[k], plans[k], counted[k]);
    if (patches[k].patch.steps() == 0) patches[k].patch = {};
  });
  put_back(plans, patches, mesh);
  for (const ShapeStats& part : counted) stats.add(part);
}

}  // namespace deliso

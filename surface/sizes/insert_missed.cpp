// Insertion of crossings that the mesh misses.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "surface/certificate/mesh_pieces.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/box_tree.h"
#include "surface/shape/box_set.h"
#include "surface/shape/patches.h"
#include "surface/shape/step_guard.h"
#include "surface/sizes/error_steps.h"
#include "surface/sizes/insertion_steps.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

namespace {

constexpr double kMissedReach = 3;  // of the surroundings of a triangle, in its longest edges

// A point that the mesh misses, and the component of the isosurface on which it lies.
struct Missed {
  Vec3 point;
  std::uint32_t component = kNoComponent;
};

// The triangles of a patch on a component that a point may be inserted at, the nearest first: of those that share a
// corner only the nearest, none twice as far as that, since another sheet may lie nearer than the right one.
// `component_of`: of each vertex.
std::vector<std::uint32_t> nearest_in(const Patch& patch, std::span<const std::uint32_t> component_of,
                                      const Missed& missed) {
  constexpr double kFirstReach = 0.5;  // voxels
  constexpr int kMostDoublings = 7;    // then all triangles are asked
  constexpr double kTimes = 2;
  constexpr std::size_t kMost = 4;
  const Vec3& p = missed.point;
  std::vector<std::pair<double, std::uint32_t>> found;  // with squared distances
  const auto ask = [&](std::uint32_t t) {
    if (!patch.has(t) || component_of[patch.corners(t)[0]] != missed.component) return;
    const auto [a, b, c] = patch.corner_points(t);
    found.emplace_back(squared_distance_to_triangle(p, a, b, c), t);
  };
  std::vector<std::uint32_t> near;
  double reach = kFirstReach;
  for (int i = 0; i <= kMostDoublings; ++i, reach *= 2) {
    near.clear();
    found.clear();
    patch.append_near({p - reach * Vec3{1, 1, 1}, p + reach * Vec3{1, 1, 1}}, near);
    for (const std::uint32_t t : near) ask(t);
    const auto first = std::min_element(found.begin(), found.end());
    if (first != found.end() && kTimes * kTimes * first->first <= reach * reach) break;
    if (i < kMostDoublings) continue;
    found.clear();
    for (std::uint32_t t = 0; t < patch.triangle_count(); ++t) ask(t);
  }
  std::sort(found.begin(), found.end());
  std::vector<std::uint32_t> nearest, corners;
  for (const auto& [squared, t] : found) {
    if (nearest.size() == kMost || squared > kTimes * kTimes * found.front().first) break;
    const auto& its = patch.corners(t);
    const bool is_beside = std::any_of(its.begin(), its.end(), [&](std::uint32_t v) {
      return std::find(corners.begin(), corners.end(), v) != corners.end();
    });
    if (is_beside) continue;
    nearest.push_back(t);
    corners.insert(corners.end(), its.begin(), its.end());
  }
  return nearest;
}

// `component_of`: of each vertex of the mesh, that of its piece.
void insert_in(NumberedPatch& numbered, const PatchPlan& plan, std::span<const Missed> missed,
               std::span<const std::uint32_t> component_of, const Box3& box, StepGuard& guard, ShapeStats& stats) {
  Patch& patch = numbered.patch;
  std::vector<std::uint32_t> of_vertex, near;
  for (const std::uint32_t v : numbered.vertices) of_vertex.push_back(component_of[v]);
  for (const Missed& one : missed) {
    const Vec3& p = one.point;
    Box3 at;
    at.extend(p);
    if (!plan.room.holds(at, near)) continue;
    const auto is_inserted_at = [&](std::uint32_t t) {
      const std::vector<PatchStep> steps = insertion_steps(patch, t, p, box);
      return std::any_of(steps.begin(), steps.end(), [&](const PatchStep& step) { return guard.apply(step); });
    };
    const std::vector<std::uint32_t> nearest = nearest_in(patch, of_vertex, one);
    if (nearest.empty()) continue;
    const auto& corners = patch.corners(nearest.front());
    if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return patch.point(v) == p; })) continue;
    if (std::none_of(nearest.begin(), nearest.end(), is_inserted_at)) continue;
    of_vertex.resize(patch.vertex_count(), one.component);
    ++stats.steps[static_cast<std::size_t>(ShapeStep::kInsert)];
  }
}

// Triangles of a mesh as one of their own.
struct Part {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> vertices, triangles;  // their numbers in the whole mesh, ascending
};

// The triangles that meet the boxes of this reach around some points.
Part part_near(const SurfaceMesh& mesh, std::span<const Missed> missed, double reach, int threads) {
  BoxSet boxes;
  for (const auto& [p, component] : missed) {
    Box3 box;
    box.extend(p - reach * Vec3{1, 1, 1});
    box.extend(p + reach * Vec3{1, 1, 1});
    boxes.add(box);
  }
  Part part;
  part.triangles = triangles_meeting(mesh, boxes, threads);
  for (const std::uint32_t t : part.triangles) {
    part.vertices.insert(part.vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  }
  std::sort(part.vertices.begin(), part.vertices.end());
  part.vertices.erase(std::unique(part.vertices.begin(), part.vertices.end()), part.vertices.end());
  for (const std::uint32_t v : part.vertices) part.mesh.points.push_back(mesh.points[v]);
  for (const std::uint32_t t : part.triangles) {
    std::array<std::uint32_t, 3> corners = mesh.triangles[t];
    for (std::uint32_t& v : corners) {
      v = static_cast<std::uint32_t>(std::lower_bound(part.vertices.begin(), part.vertices.end(), v) -
                                     part.vertices.begin());
    }
    part.mesh.triangles.push_back(corners);
  }
  set_side_adjacency(part.mesh);
  return part;
}

// Where points that are missed may be inserted.
struct NearMissed {
  std::vector<std::uint32_t> nearest;       // triangles on their own components, ascending, each once
  std::vector<std::uint32_t> component_of;  // of each vertex of the mesh near them: that of its piece
};

// Looks near the points, which mostly are few on a large mesh, and in all of the mesh for those with nothing near.
NearMissed find_near(const SurfaceMesh& mesh, std::vector<Missed> missed, const ExactSurface& surface) {
  constexpr double kNear = 4, kFarther = 32;  // voxels
  NearMissed found;
  found.component_of.assign(mesh.points.size(), kNoComponent);
  const double farthest = surface.isosurface.box().diagonal();
  for (const double reach : {kNear, kFarther, farthest}) {
    if (missed.empty()) break;
    const Part part = part_near(mesh, missed, reach, surface.threads);
    const PieceComponents pieces = piece_components(part.mesh, surface);
    for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[part.triangles[t]]) found.component_of[v] = pieces.component_of(t);
    }
    const BoxTree tree(
        part.triangles.size(), [&](std::size_t t) { return box_of(part.mesh, static_cast<std::uint32_t>(t)); },
        surface.threads);
    std::erase_if(missed, [&](const Missed& one) {
      const auto measure = [&](std::uint32_t t) {
        if (pieces.component_of(t) != one.component) return std::numeric_limits<double>::infinity();
        const auto& [a, b, c] = mesh.triangles[part.triangles[t]];
        return squared_distance_to_triangle(one.point, mesh.points[a], mesh.points[b], mesh.points[c]);
      };
      const std::uint32_t t = tree.nearest(one.point, reach * reach, measure).first;
      if (t != BoxTree::kNone) found.nearest.push_back(part.triangles[t]);
      return t != BoxTree::kNone;
    });
  }
  std::sort(found.nearest.begin(), found.nearest.end());
  found.nearest.erase(std::unique(found.nearest.begin(), found.nearest.end()), found.nearest.end());
  return found;
}

}  // namespace

void insert_missed(SurfaceMesh& mesh, const ExactSurface& surface, std::span<const Vec3> points, double freedom,
                   const ShapeOptions& options, const Controls& controls, ShapeStats& stats) {
  Controls own = controls;
  if (points.empty() || own.poll()) return;
  std::vector<Missed> missed;
  for (const Vec3& p : points) {
    if (const auto component = surface.component_at(p)) missed.push_back({p, *component});
  }
  const NearMissed near = find_near(mesh, missed, surface);
  const std::vector<PatchPlan> plans = plan_patches(mesh, near.nearest, kMissedReach, surface);
  work_in_patches(mesh, plans, surface.threads, stats,
                  [&](NumberedPatch& patch, const PatchPlan& plan, ShapeStats& counted) {
                    StepGuard guard(patch.patch, plan.crossings, surface.isosurface, options, counted.search);
                    guard.set_freedom(freedom);
                    insert_in(patch, plan, missed, near.component_of, surface.isosurface.box(), guard, counted);
                  });
}

}  // namespace deliso

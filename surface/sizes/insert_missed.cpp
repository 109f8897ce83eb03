// Insertion of crossings that the mesh misses.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "surface/certificate/mesh_pieces.h"
#include "surface/mesh/side_adjacency.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/mesh/triangle_shape.h"
#include "surface/search/box_tree.h"
#include "surface/shape/patches.h"
#include "surface/shape/step_guard.h"
#include "surface/sizes/error_steps.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

namespace {

constexpr double kMissedReach = 3;  // of the surroundings of a triangle, in its longest edges

// A point that the mesh misses, and the component of the isosurface on which it lies.
struct Missed {
  Vec3 point;
  std::uint32_t component = kNoComponent;
};

// The nearest of a patch's triangles on a component, the first of equals; kNoVertex if there is none. `component_of`:
// of each vertex.
std::uint32_t nearest_in(const Patch& patch, std::span<const std::uint32_t> component_of, const Missed& missed) {
  constexpr double kFirstReach = 0.5;  // voxels
  constexpr int kMostDoublings = 7;    // then all triangles are asked
  const Vec3& p = missed.point;
  std::uint32_t nearest = kNoVertex;
  double least = std::numeric_limits<double>::infinity();
  const auto ask = [&](std::uint32_t t) {
    if (!patch.has(t) || component_of[patch.corners(t)[0]] != missed.component) return;
    const auto [a, b, c] = patch.corner_points(t);
    const double squared = squared_distance_to_triangle(p, a, b, c);
    if (squared > least || (squared == least && t >= nearest)) return;
    least = squared;
    nearest = t;
  };
  std::vector<std::uint32_t> near;
  double reach = kFirstReach;
  for (int i = 0; i <= kMostDoublings; ++i, reach *= 2) {
    near.clear();
    patch.append_near({p - reach * Vec3{1, 1, 1}, p + reach * Vec3{1, 1, 1}}, near);
    for (const std::uint32_t t : near) ask(t);
    if (least <= reach * reach) return nearest;
  }
  for (std::uint32_t t = 0; t < patch.triangle_count(); ++t) ask(t);
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

double least_quality(const Patch& patch, const PatchStep& step) {
  const auto at = [&](std::uint32_t v) { return v == step.vertex ? step.point : patch.point(v); };
  double least = 1;
  for (const auto& [a, b, c] : step.added) least = std::min(least, sine_of_least_angle(at(a), at(b), at(c)));
  return least;
}

// A tip of a finger may stand out beyond a vertex: over the rim of some of the triangles around it that follow each
// other, or of all, and the vertex is gone then. The best triangles first.
std::vector<PatchStep> tip_steps(const Patch& patch, std::uint32_t t, const Vec3& p) {
  const auto& corners = patch.corners(t);
  const std::uint32_t nearest =
      *std::min_element(corners.begin(), corners.end(), [&](std::uint32_t v, std::uint32_t u) {
        return squared_distance(patch.point(v), p) < squared_distance(patch.point(u), p);
      });
  std::vector<PatchStep> steps;
  VertexLink link;
  if (!patch.find_link(nearest, link)) return steps;
  const std::size_t count = link.triangles.size();
  for (std::size_t first = 0; first < count; ++first) {
    std::vector<std::uint32_t> cavity;
    const std::size_t most = link.is_closed ? (first == 0 ? count : count - 1) : count - first;
    for (std::size_t i = 0; i < most; ++i) {
      cavity.push_back(link.triangles[(first + i) % count]);
      steps.push_back(cavity_step(patch, cavity, p));
      steps.back().quality = least_quality(patch, steps.back());
    }
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const PatchStep& a, const PatchStep& b) { return a.quality > b.quality; });
  return steps;
}

// `component_of`: of each vertex of the mesh, that of its piece.
void insert_in(NumberedPatch& numbered, const PatchPlan& plan, std::span<const Missed> missed,
               std::span<const std::uint32_t> component_of, StepGuard& guard, ShapeStats& stats) {
  Patch& patch = numbered.patch;
  std::vector<std::uint32_t> of_vertex, near;
  for (const std::uint32_t v : numbered.vertices) of_vertex.push_back(component_of[v]);
  for (const Missed& one : missed) {
    const Vec3& p = one.point;
    Box3 at;
    at.extend(p);
    if (!plan.room.holds(at, near)) continue;
    const std::uint32_t t = nearest_in(patch, of_vertex, one);
    if (t == kNoVertex) continue;
    const auto& corners = patch.corners(t);
    if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return patch.point(v) == p; })) continue;
    std::vector<PatchStep> steps;
    for (const unsigned sides : {7u, 0u, 1u, 2u, 4u, 3u, 5u, 6u}) steps.push_back(star_step(patch, t, p, sides));
    for (PatchStep& step : tip_steps(patch, t, p)) steps.push_back(std::move(step));
    const bool is_done =
        std::any_of(steps.begin(), steps.end(), [&](const PatchStep& step) { return guard.apply(step); });
    if (!is_done) continue;
    of_vertex.resize(patch.vertex_count(), one.component);
    ++stats.steps[static_cast<std::size_t>(ShapeStep::kInsert)];
  }
}

// The component of each vertex's piece.
std::vector<std::uint32_t> components_of_vertices(const SurfaceMesh& mesh, const PieceComponents& pieces) {
  std::vector<std::uint32_t> component_of(mesh.points.size(), kNoComponent);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) component_of[v] = pieces.component_of(t);
  }
  return component_of;
}

// The nearest triangles on their own components, ascending, each once.
std::vector<std::uint32_t> nearest_triangles(const SurfaceMesh& mesh, const PieceComponents& pieces,
                                             std::span<const Missed> missed, const ExactSurface& surface) {
  const BoxTree tree(
      mesh.triangles.size(), [&](std::size_t t) { return box_of(mesh, static_cast<std::uint32_t>(t)); },
      surface.threads);
  std::vector<std::uint32_t> nearest;
  const double farthest = surface.isosurface.box().diagonal();
  for (const Missed& one : missed) {
    const auto measure = [&](std::uint32_t t) {
      if (pieces.component_of(t) != one.component) return std::numeric_limits<double>::infinity();
      const auto& [a, b, c] = mesh.triangles[t];
      return squared_distance_to_triangle(one.point, mesh.points[a], mesh.points[b], mesh.points[c]);
    };
    const std::uint32_t t = tree.nearest(one.point, farthest * farthest, measure).first;
    if (t != BoxTree::kNone) nearest.push_back(t);
  }
  std::sort(nearest.begin(), nearest.end());
  nearest.erase(std::unique(nearest.begin(), nearest.end()), nearest.end());
  return nearest;
}

}  // namespace

void insert_missed(SurfaceMesh& mesh, const ExactSurface& surface, std::span<const Vec3> points, double freedom,
                   const ShapeOptions& options, const Controls& controls, ShapeStats& stats) {
  Controls own = controls;
  if (points.empty() || own.poll()) return;
  set_side_adjacency(mesh);
  const PieceComponents pieces = piece_components(mesh, surface);
  std::vector<Missed> missed;
  for (const Vec3& p : points) {
    if (const auto component = surface.component_at(p)) missed.push_back({p, *component});
  }
  const std::vector<std::uint32_t> nearest = nearest_triangles(mesh, pieces, missed, surface);
  const std::vector<std::uint32_t> component_of_vertex = components_of_vertices(mesh, pieces);
  const std::vector<PatchPlan> plans = plan_patches(mesh, nearest, kMissedReach, surface);
  work_in_patches(mesh, plans, surface.threads, stats,
                  [&](NumberedPatch& patch, const PatchPlan& plan, ShapeStats& counted) {
                    StepGuard guard(patch.patch, plan.crossings, surface.isosurface, options, counted.search);
                    guard.set_freedom(freedom);
                    insert_in(patch, plan, missed, component_of_vertex, guard, counted);
                  });
}

}  // namespace deliso

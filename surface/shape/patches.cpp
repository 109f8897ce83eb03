#include "surface/shape/patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "delaunay/base/disjoint_sets.h"
#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

// A tiny triangle may be between larger ones (mesh-space units).
constexpr double kLeastReach = 2;

struct PatchTriangle {
  std::uint32_t patch, triangle;
};
struct PatchCrossing {
  std::uint32_t patch;
  Vec3 position;
};

// The boxes around bad triangles, and which patch each belongs to. Bad triangles of one small cube share a box: where
// they crowd, as in masks of noise, boxes of their own would be as many as triangles, all over each other.
struct Surroundings {
  BoxSet boxes;
  std::vector<std::uint32_t> box_of;    // of each bad triangle
  std::vector<std::uint32_t> patch_of;  // of each box

  Surroundings(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double reach) {
    for (const Box3& box : shared_boxes(mesh, bad, reach)) boxes.add(box);
    const auto count = static_cast<std::uint32_t>(boxes.boxes().size());
    DisjointSets groups(count);
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < count; ++i) {
      boxes.for_each_meeting(boxes.boxes()[i], near, [&](std::uint32_t j) { groups.unite(i, j); });
    }
    std::uint32_t patches = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t first = groups.find(i);  // not above i
      patch_of.push_back(first == i ? patches++ : patch_of[first]);
    }
  }

 private:
  std::vector<Box3> shared_boxes(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double reach) {
    constexpr double kCube = 1;  // mesh-space units
    std::map<std::array<double, 3>, std::uint32_t> box_at;
    std::vector<Box3> shared;
    for (const std::uint32_t t : bad) {
      const double beyond = std::max(kLeastReach, reach * std::sqrt(squared_longest_edge(mesh, t)));
      const Vec3 margin{beyond, beyond, beyond};
      Box3 box = deliso::box_of(mesh, t);
      const Vec3 cube = box.low / kCube;
      box = {box.low - margin, box.high + margin};
      const auto [at, is_new] = box_at.try_emplace({std::floor(cube.x), std::floor(cube.y), std::floor(cube.z)},
                                                   static_cast<std::uint32_t>(shared.size()));
      box_of.push_back(at->second);
      if (is_new) shared.emplace_back();
      shared[at->second].extend(box.low);
      shared[at->second].extend(box.high);
    }
    return shared;
  }
};

std::vector<PatchTriangle> triangles_of_patches(const SurfaceMesh& mesh, const Surroundings& around, const BoxMap& map,
                                                int threads) {
  const auto append = [&](std::size_t t, std::vector<PatchTriangle>& found) {
    const Box3 box = box_of(mesh, static_cast<std::uint32_t>(t));
    const Vec3 size = box.size();
    const std::size_t first = found.size();
    const auto add = [&](std::uint32_t i) {
      const auto is_same = [&](const PatchTriangle& other) { return other.patch == around.patch_of[i]; };
      if (std::none_of(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), is_same) &&
          around.boxes.boxes()[i].meets(box)) {
        found.push_back({around.patch_of[i], static_cast<std::uint32_t>(t)});
      }
    };
    if (std::max({size.x, size.y, size.z}) <= map.reach()) {
      for (const std::uint32_t i : map.near(box.low)) add(i);
    } else if (!map.visit_near(box, add)) {
      thread_local std::vector<std::uint32_t> near;
      around.boxes.for_each_meeting(box, near, add);
    }
  };
  return collect_in_blocks<PatchTriangle>(mesh.triangles.size(), threads, append);
}

std::vector<PatchCrossing> crossings_of_patches(const ExactSurface& surface, const Surroundings& around,
                                                const BoxMap& map) {
  const auto append = [&](std::size_t c, std::vector<PatchCrossing>& found) {
    const Vec3 p = surface.position(surface.topology.crossings[c]);
    for (const std::uint32_t i : map.near(p)) {
      if (!around.boxes.boxes()[i].contains(p)) continue;
      found.push_back({around.patch_of[i], p});
      return;
    }
  };
  return collect_in_blocks<PatchCrossing>(surface.topology.crossings.size(), surface.threads, append);
}

}  // namespace

std::vector<PatchPlan> plan_patches(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double reach,
                                    const ExactSurface& surface) {
  const Surroundings around(mesh, bad, reach);
  const BoxMap map(around.boxes.boxes());
  std::vector<PatchPlan> plans;
  for (std::uint32_t i = 0; i < around.patch_of.size(); ++i) {
    const std::uint32_t patch = around.patch_of[i];
    if (patch == plans.size()) plans.emplace_back();
    plans[patch].room.add(around.boxes.boxes()[i]);
  }
  for (std::size_t i = 0; i < bad.size(); ++i) plans[around.patch_of[around.box_of[i]]].bad.push_back(bad[i]);
  for (const auto& [patch, t] : triangles_of_patches(mesh, around, map, surface.threads)) {
    plans[patch].triangles.push_back(t);
  }
  for (const auto& [patch, p] : crossings_of_patches(surface, around, map)) plans[patch].crossings.push_back(p);
  return plans;
}

double mean_edge(const SurfaceMesh& mesh, std::span<const std::uint32_t> triangles) {
  double sum = 0;
  for (const std::uint32_t t : triangles) {
    const auto& [a, b, c] = mesh.triangles[t];
    sum += distance(mesh.points[a], mesh.points[b]) + distance(mesh.points[b], mesh.points[c]) +
           distance(mesh.points[c], mesh.points[a]);
  }
  return sum / std::max(1.0, 3 * static_cast<double>(triangles.size()));
}

NumberedPatch take_patch(const SurfaceMesh& mesh, const PatchPlan& plan) {
  NumberedPatch taken{Patch(plan.room, mean_edge(mesh, plan.triangles)), {}, {}};
  // Of each vertex of the mesh: its number in the patch, or kNoVertex, which all have again in the end.
  thread_local std::vector<std::uint32_t> numbers;
  if (numbers.size() < mesh.points.size()) numbers.resize(mesh.points.size(), kNoVertex);
  for (const std::uint32_t t : plan.triangles) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (numbers[v] == kNoVertex) taken.vertices.push_back(v);
      numbers[v] = 0;
    }
  }
  std::sort(taken.vertices.begin(), taken.vertices.end());
  for (const std::uint32_t v : taken.vertices) numbers[v] = taken.patch.add_vertex(mesh.points[v]);
  auto next_bad = plan.bad.begin();
  for (const std::uint32_t t : plan.triangles) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) corners[i] = numbers[mesh.triangles[t][i]];
    const std::uint32_t number = taken.patch.add_triangle(corners);
    if (next_bad != plan.bad.end() && *next_bad == t) {
      taken.bad.push_back(number);
      ++next_bad;
    }
  }
  for (const std::uint32_t v : taken.vertices) numbers[v] = kNoVertex;
  return taken;
}

void put_back(std::span<const PatchPlan> plans, std::span<const NumberedPatch> patches, SurfaceMesh& mesh) {
  std::vector<bool> is_gone(mesh.triangles.size(), false);
  bool is_any_gone = false;  // a triangle or a vertex
  for (std::size_t k = 0; k < plans.size(); ++k) {
    const Patch& patch = patches[k].patch;
    if (patch.steps() == 0) continue;
    std::vector<std::uint32_t> numbers = patches[k].vertices;
    for (std::uint32_t v = 0; v < patch.vertex_count(); ++v) {
      is_any_gone = is_any_gone || patch.star(v).empty();
      if (v < numbers.size()) {
        mesh.points[numbers[v]] = patch.point(v);
      } else {
        numbers.push_back(static_cast<std::uint32_t>(mesh.points.size()));
        mesh.points.push_back(patch.point(v));
      }
    }
    std::vector<std::uint32_t> free;
    const std::size_t old_count = plans[k].triangles.size();
    for (std::uint32_t t = 0; t < old_count; ++t) {
      if (!patch.has(t)) free.push_back(plans[k].triangles[t]);
    }
    auto next_free = free.begin();
    for (auto t = static_cast<std::uint32_t>(old_count); t < patch.triangle_count(); ++t) {
      if (!patch.has(t)) continue;
      const auto& [a, b, c] = patch.corners(t);
      const std::array<std::uint32_t, 3> corners = {numbers[a], numbers[b], numbers[c]};
      if (next_free != free.end()) {
        mesh.triangles[*next_free++] = corners;
      } else {
        check_triangle_count(mesh.triangles.size() + 1);
        mesh.triangles.push_back(corners);
      }
    }
    for (; next_free != free.end(); ++next_free) is_any_gone = is_gone[*next_free] = true;
  }
  is_gone.resize(mesh.triangles.size(), false);
  mesh.neighbours.clear();
  mesh.pole_heights.clear();  // new vertices have none
  if (is_any_gone) drop_triangles(mesh, is_gone);
}

}  // namespace deliso

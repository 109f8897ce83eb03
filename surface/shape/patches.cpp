#include "surface/shape/patches.h"

#include <algorithm>
#include <cmath>
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

}  // namespace

std::vector<PatchPlan> plan_patches(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double reach,
                                    const ExactSurface& surface) {
  BoxSet around;
  for (const std::uint32_t t : bad) {
    const double beyond = std::max(kLeastReach, reach * std::sqrt(squared_longest_edge(mesh, t)));
    const Vec3 margin{beyond, beyond, beyond};
    const Box3 box = box_of(mesh, t);
    around.add({box.low - margin, box.high + margin});
  }
  DisjointSets groups(bad.size());
  std::vector<std::uint32_t> scratch;
  for (std::uint32_t i = 0; i < bad.size(); ++i) {
    around.for_each_meeting(around.boxes()[i], scratch, [&](std::uint32_t j) { groups.unite(i, j); });
  }
  std::vector<std::uint32_t> patch_of(bad.size());
  std::vector<PatchPlan> plans;
  for (std::uint32_t i = 0; i < bad.size(); ++i) {
    const std::uint32_t root = groups.find(i);
    if (root == i) {
      patch_of[i] = static_cast<std::uint32_t>(plans.size());
      plans.emplace_back();
    } else {
      patch_of[i] = patch_of[root];
    }
    plans[patch_of[i]].room.add(around.boxes()[i]);
    plans[patch_of[i]].bad.push_back(bad[i]);
  }
  const BoxMap map(around.boxes());
  const auto append = [&](std::size_t t, std::vector<PatchTriangle>& found) {
    const Box3 box = box_of(mesh, static_cast<std::uint32_t>(t));
    const Vec3 size = box.size();
    const bool is_small = std::max({size.x, size.y, size.z}) <= map.reach();
    const std::size_t first = found.size();
    const auto add = [&](std::uint32_t i) {
      const auto is_same = [&](const PatchTriangle& other) { return other.patch == patch_of[i]; };
      if (around.boxes()[i].meets(box) &&
          std::none_of(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), is_same)) {
        found.push_back({patch_of[i], static_cast<std::uint32_t>(t)});
      }
    };
    if (is_small) {
      for (const std::uint32_t i : map.near(box.low)) add(i);
    } else {
      thread_local std::vector<std::uint32_t> near;
      around.for_each_meeting(box, near, add);
    }
  };
  for (const auto& [patch, t] : collect_in_blocks<PatchTriangle>(mesh.triangles.size(), surface.threads, append)) {
    plans[patch].triangles.push_back(t);
  }
  const auto append_crossing = [&](std::size_t c, std::vector<PatchCrossing>& found) {
    const Vec3 p = surface.position(surface.topology.crossings[c]);
    for (const std::uint32_t i : map.near(p)) {
      if (!around.boxes()[i].contains(p)) continue;
      found.push_back({patch_of[i], p});
      return;
    }
  };
  for (const auto& [patch, p] :
       collect_in_blocks<PatchCrossing>(surface.topology.crossings.size(), surface.threads, append_crossing)) {
    plans[patch].crossings.push_back(p);
  }
  return plans;
}

NumberedPatch take_patch(const SurfaceMesh& mesh, const PatchPlan& plan) {
  NumberedPatch taken{Patch(plan.room), {}, {}};
  for (const std::uint32_t t : plan.triangles) {
    taken.vertices.insert(taken.vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  }
  std::sort(taken.vertices.begin(), taken.vertices.end());
  taken.vertices.erase(std::unique(taken.vertices.begin(), taken.vertices.end()), taken.vertices.end());
  for (const std::uint32_t v : taken.vertices) taken.patch.add_vertex(mesh.points[v]);
  auto next_bad = plan.bad.begin();
  for (const std::uint32_t t : plan.triangles) {
    std::array<std::uint32_t, 3> corners{};
    std::transform(mesh.triangles[t].begin(), mesh.triangles[t].end(), corners.begin(), [&](std::uint32_t v) {
      const auto at = std::lower_bound(taken.vertices.begin(), taken.vertices.end(), v);
      return static_cast<std::uint32_t>(at - taken.vertices.begin());
    });
    const std::uint32_t number = taken.patch.add_triangle(corners);
    if (next_bad != plan.bad.end() && *next_bad == t) {
      taken.bad.push_back(number);
      ++next_bad;
    }
  }
  return taken;
}

void put_back(std::span<const PatchPlan> plans, std::span<const NumberedPatch> patches, SurfaceMesh& mesh) {
  std::vector<bool> is_gone(mesh.triangles.size(), false);
  bool is_any_gone = false;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    const Patch& patch = patches[k].patch;
    if (patch.steps() == 0) continue;
    std::vector<std::uint32_t> numbers = patches[k].vertices;
    for (std::uint32_t v = 0; v < patch.vertex_count(); ++v) {
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
  if (is_any_gone) drop_triangles(mesh, is_gone);
}

}  // namespace deliso

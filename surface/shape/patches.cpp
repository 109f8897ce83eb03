#include "surface/shape/patches.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

struct PatchTriangle {
  std::uint32_t patch, triangle;
};
struct PatchCrossing {
  std::uint32_t patch;
  Vec3 position;
};

// Calls add(i) for boxes that a triangle may meet, for some several times.
template <class Add>
void visit_boxes_near(const Box3& triangle, const BoxSet& boxes, const BoxMap& map, const Add& add) {
  const Vec3 size = triangle.size();
  if (std::max({size.x, size.y, size.z}) <= map.reach()) {
    for (const std::uint32_t i : map.near(triangle.low)) add(i);
  } else if (!map.visit_near(triangle, add)) {
    thread_local std::vector<std::uint32_t> near;
    boxes.for_each_meeting(triangle, near, add);
  }
}

std::vector<PatchTriangle> triangles_of_patches(const SurfaceMesh& mesh, const PatchBoxes::Pass& around,
                                                const BoxMap& map, int threads) {
  const auto append = [&](std::size_t t, std::vector<PatchTriangle>& found) {
    const Box3 box = box_of(mesh, static_cast<std::uint32_t>(t));
    const std::size_t first = found.size();
    visit_boxes_near(box, around.boxes, map, [&](std::uint32_t i) {
      const auto is_same = [&](const PatchTriangle& other) { return other.patch == around.patch_of[i]; };
      if (std::none_of(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), is_same) &&
          around.boxes.boxes()[i].meets(box)) {
        found.push_back({around.patch_of[i], static_cast<std::uint32_t>(t)});
      }
    });
  };
  return collect_in_blocks<PatchTriangle>(mesh.triangles.size(), threads, append);
}

std::vector<PatchCrossing> crossings_of_patches(const ExactSurface& surface, const PatchBoxes::Pass& around,
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

std::vector<std::uint32_t> triangles_meeting(const SurfaceMesh& mesh, const BoxSet& boxes, int threads) {
  const BoxMap map(boxes.boxes());
  return collect_in_blocks<std::uint32_t>(
      mesh.triangles.size(), threads, [&](std::size_t t, std::vector<std::uint32_t>& found) {
        const Box3 box = box_of(mesh, static_cast<std::uint32_t>(t));
        bool is_met = false;
        visit_boxes_near(box, boxes, map, [&](std::uint32_t i) { is_met = is_met || boxes.boxes()[i].meets(box); });
        if (is_met) found.push_back(static_cast<std::uint32_t>(t));
      });
}

std::vector<PatchPlan> plan_pass(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, const PatchBoxes& boxes,
                                 std::size_t pass, const ExactSurface& surface) {
  const PatchBoxes::Pass& around = boxes.passes()[pass];
  const BoxMap map(around.boxes.boxes());
  std::vector<PatchPlan> plans;
  for (std::uint32_t i = 0; i < around.patch_of.size(); ++i) {
    const std::uint32_t patch = around.patch_of[i];
    if (patch == plans.size()) plans.emplace_back();
    plans[patch].room.add(around.boxes.boxes()[i]);
  }
  for (const std::uint32_t t : bad) {
    if (const auto box = boxes.box_of(mesh, t, pass)) plans[around.patch_of[*box]].bad.push_back(t);
  }
  for (const auto& [patch, t] : triangles_of_patches(mesh, around, map, surface.threads)) {
    plans[patch].triangles.push_back(t);
  }
  for (const auto& [patch, p] : crossings_of_patches(surface, around, map)) plans[patch].crossings.push_back(p);
  return plans;
}

std::vector<PatchPlan> plan_patches(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double reach,
                                    const ExactSurface& surface) {
  if (bad.empty()) return {};
  constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();
  return plan_pass(mesh, bad, PatchBoxes(mesh, bad, reach, kAny), 0, surface);
}

std::vector<std::size_t> longest_first(std::span<const PatchPlan> plans) {
  std::vector<std::size_t> order(plans.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return plans[a].bad.size() > plans[b].bad.size(); });
  return order;
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

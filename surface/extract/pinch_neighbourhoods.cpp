#include "surface/extract/pinch_neighbourhoods.h"

#include "surface/search/box_tree.h"

namespace deliso {

PinchNeighbourhoods::PinchNeighbourhoods(const SurfaceMesh& mesh, std::span<const PinchGroup> groups,
                                         std::span<const VertexId> origin_of)
    : mesh_(mesh), groups_(groups), origin_of_(origin_of) {
  if (groups_.empty()) return;
  find_fans();
  find_those_near_other_positions();
}

// Finds the triangles at all vertices that share a triangle with a copy.
void PinchNeighbourhoods::find_fans() {
  std::vector<bool> is_copy(mesh_.points.size(), false);
  for (const PinchGroup& group : groups_) {
    for (const Copy& copy : group) is_copy[copy.vertex] = true;
  }
  for (const auto& triangle : mesh_.triangles) {
    if (std::none_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) { return is_copy[v]; })) continue;
    for (const std::uint32_t v : triangle) fans_[origin_of_[v].index()];
  }
  std::vector<bool> has_fan(mesh_.points.size());
  for (std::uint32_t v = 0; v < mesh_.points.size(); ++v) has_fan[v] = fans_.contains(origin_of_[v].index());
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh_.triangles[t]) {
      if (!has_fan[v]) continue;
      std::vector<std::uint32_t>& fan = fans_[origin_of_[v].index()];
      if (fan.empty() || fan.back() != t) fan.push_back(t);
    }
  }
}

void PinchNeighbourhoods::find_those_near_other_positions() {
  std::vector<std::size_t> groups;
  std::vector<Box3> boxes;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    Box3 box;
    bool has_other_positions = false;
    for (const Copy& copy : groups_[i]) {
      if (copy.other_positions.empty()) continue;
      has_other_positions = true;
      for (const Vec3& position : copy.other_positions) box.extend(position);
      for (const std::uint32_t t : fan(copy.vertex)) {
        if (!is_at(t, copy.vertex)) continue;
        for (const std::uint32_t v : mesh_.triangles[t]) box.extend(mesh_.points[v]);
      }
    }
    if (!has_other_positions) continue;
    const Vec3 around{kPinchSeparation, kPinchSeparation, kPinchSeparation};
    groups.push_back(i);
    boxes.push_back({box.low - around, box.high + around});
  }
  if (groups.empty()) return;
  const BoxTree tree(boxes);
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    tree.for_each_meeting(box_of(mesh_, t),
                          [&](std::uint32_t near) { near_other_positions_[groups[near]].push_back(t); });
  }
}

std::vector<std::uint32_t> PinchNeighbourhoods::triangles(std::size_t group) const {
  std::vector<std::uint32_t> triangles;
  for (const Copy& copy : groups_[group]) {
    for (const std::uint32_t t : fan(copy.vertex)) {
      if (!is_at(t, copy.vertex)) continue;
      for (const std::uint32_t v : mesh_.triangles[t]) triangles.insert(triangles.end(), fan(v).begin(), fan(v).end());
    }
  }
  if (const auto near = near_other_positions_.find(group); near != near_other_positions_.end()) {
    triangles.insert(triangles.end(), near->second.begin(), near->second.end());
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace deliso

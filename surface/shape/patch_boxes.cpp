#include "surface/shape/patch_boxes.h"

#include <algorithm>
#include <cmath>

#include "delaunay/base/disjoint_sets.h"

namespace deliso {

namespace {

// A tiny triangle may be between larger ones (mesh-space units).
constexpr double kLeastReach = 2;

// So many passes; with these shifts along each axis a box up to a quarter of a block large is cut at most once along
// each axis, so one of the four passes holds it whole. Larger boxes have a last pass of their own.
constexpr std::size_t kShifts = 4;
constexpr double kBlock = 48;  // mesh-space units

std::size_t first_pass_with(const Box3& box) {
  for (std::size_t pass = 0; pass < kShifts; ++pass) {
    const double shift = static_cast<double>(pass) / kShifts;
    bool is_whole = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      is_whole = is_whole && std::floor(box.low[axis] / kBlock + shift) == std::floor(box.high[axis] / kBlock + shift);
    }
    if (is_whole) return pass;
  }
  return kShifts;
}

// Numbers the passes that there are from 0 on.
void close_gaps(std::vector<std::size_t>& pass_of) {
  std::array<std::size_t, kShifts + 2> number{};  // of a pass; first whether a box belongs to the one before it
  for (const std::size_t pass : pass_of) number[pass + 1] = 1;
  for (std::size_t pass = 1; pass < number.size(); ++pass) number[pass] += number[pass - 1];
  for (std::size_t& pass : pass_of) pass = number[pass];
}

// Unites boxes that meet and that `may_join`.
template <class MayJoin>
DisjointSets joined(const BoxSet& boxes, const MayJoin& may_join) {
  const auto count = static_cast<std::uint32_t>(boxes.boxes().size());
  DisjointSets groups(count);
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < count; ++i) {
    boxes.for_each_meeting(boxes.boxes()[i], near, [&](std::uint32_t j) {
      if (may_join(i, j)) groups.unite(i, j);
    });
  }
  return groups;
}

}  // namespace

PatchBoxes::PatchBoxes(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double reach,
                       std::size_t most_boxes) {
  divide(share_boxes(mesh, bad, reach), most_boxes);
}

PatchBoxes::Cube PatchBoxes::cube_of(const SurfaceMesh& mesh, std::uint32_t triangle) {
  constexpr double kCube = 1;  // mesh-space units
  const Vec3 cube = deliso::box_of(mesh, triangle).low / kCube;
  return {std::floor(cube.x), std::floor(cube.y), std::floor(cube.z)};
}

std::optional<std::uint32_t> PatchBoxes::box_of(const SurfaceMesh& mesh, std::uint32_t triangle,
                                                std::size_t pass) const {
  const auto at = box_at_.find(cube_of(mesh, triangle));
  if (at == box_at_.end() || places_[at->second].pass != pass) return std::nullopt;
  return places_[at->second].box;
}

// Bad triangles of one small cube share a box: where they crowd, as in masks of noise, boxes of their own would be as
// many as triangles, all over each other.
BoxSet PatchBoxes::share_boxes(const SurfaceMesh& mesh, std::span<const std::uint32_t> bad, double reach) {
  std::vector<Box3> shared;
  for (const std::uint32_t t : bad) {
    const double beyond = std::max(kLeastReach, reach * std::sqrt(squared_longest_edge(mesh, t)));
    const Vec3 margin{beyond, beyond, beyond};
    const Box3 box = deliso::box_of(mesh, t);
    const auto [at, is_new] = box_at_.try_emplace(cube_of(mesh, t), static_cast<std::uint32_t>(shared.size()));
    if (is_new) shared.emplace_back();
    shared[at->second].extend(box.low - margin);
    shared[at->second].extend(box.high + margin);
  }
  BoxSet boxes;
  for (const Box3& box : shared) boxes.add(box);
  return boxes;
}

void PatchBoxes::divide(const BoxSet& all, std::size_t most_boxes) {
  const auto count = static_cast<std::uint32_t>(all.boxes().size());
  DisjointSets crowds = joined(all, [](std::uint32_t, std::uint32_t) { return true; });
  std::vector<std::size_t> sizes(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) ++sizes[crowds.find(i)];
  std::vector<std::size_t> pass_of(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (sizes[crowds.find(i)] > most_boxes) pass_of[i] = first_pass_with(all.boxes()[i]);
  }
  close_gaps(pass_of);
  // Boxes of different blocks of one pass do not meet, so those that do belong together.
  DisjointSets groups = joined(all, [&](std::uint32_t i, std::uint32_t j) { return pass_of[i] == pass_of[j]; });
  std::vector<std::uint32_t> patch_of(count), patches(kShifts + 1, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (pass_of[i] >= passes_.size()) passes_.resize(pass_of[i] + 1);
    const std::uint32_t first = groups.find(i);  // not above i
    patch_of[i] = first == i ? patches[pass_of[i]]++ : patch_of[first];
    Pass& pass = passes_[pass_of[i]];
    places_.push_back({pass_of[i], static_cast<std::uint32_t>(pass.patch_of.size())});
    pass.boxes.add(all.boxes()[i]);
    pass.patch_of.push_back(patch_of[i]);
  }
}

}  // namespace deliso

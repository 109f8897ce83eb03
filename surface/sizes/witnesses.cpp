#include "surface/sizes/witnesses.h"

#include <limits>
#include <utility>

#include "surface/base/parallel_blocks.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/box_tree.h"

namespace deliso {

namespace {

double squared_distance_from(const Vec3& p, const Patch& mesh, std::uint32_t triangle) {
  const auto [a, b, c] = mesh.corner_points(triangle);
  return squared_distance_to_triangle(p, a, b, c);
}

}  // namespace

Witnesses::Witnesses(const Patch& mesh, const ExactSurface& surface, double reach) : points_(mesh.points()) {
  const std::size_t vertices = points_.size(), crossings = surface.topology.crossings.size();
  points_.resize(vertices + crossings);
  next_.assign(points_.size(), kNone);
  first_.assign(mesh.triangle_count(), kNone);
  const BoxTree tree(
      mesh.triangle_count(), [&](std::size_t t) { return mesh.box_of(static_cast<std::uint32_t>(t)); },
      surface.threads);
  std::vector<std::uint32_t> nearest(crossings);
  for_each_block(crossings, surface.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 p = points_[vertices + i] = surface.position(surface.topology.crossings[i]);
      nearest[i] =
          tree.nearest(p, reach * reach, [&](std::uint32_t t) { return squared_distance_from(p, mesh, t); }).first;
    }
  });
  for (std::size_t i = 0; i < crossings; ++i) {
    if (!surface.wants(surface.topology.crossings[i])) continue;
    if (nearest[i] != BoxTree::kNone) give(static_cast<std::uint32_t>(vertices + i), nearest[i]);
  }
}

void Witnesses::give(std::uint32_t witness, std::uint32_t triangle) {
  next_[witness] = first_[triangle];
  first_[triangle] = witness;
}

void Witnesses::pass_on(std::span<const std::uint32_t> removed, std::uint32_t vertex, std::uint32_t first_added,
                        const Patch& mesh) {
  first_.resize(mesh.triangle_count(), kNone);
  const auto give_to_nearest = [&](std::uint32_t witness) {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = first_added;
    for (std::uint32_t t = first_added; t < mesh.triangle_count(); ++t) {
      const double squared = squared_distance_from(points_[witness], mesh, t);
      if (squared < least) {
        least = squared;
        nearest = t;
      }
    }
    give(witness, nearest);
  };
  for (const std::uint32_t t : removed) {
    for (std::uint32_t w = std::exchange(first_[t], kNone); w != kNone;) {
      const std::uint32_t next = next_[w];
      give_to_nearest(w);
      w = next;
    }
  }
  give_to_nearest(vertex);
}

}  // namespace deliso

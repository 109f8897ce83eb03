#include "surface/certificate/geometry_check.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

#include "raycast/gradients_at.h"
#include "surface/base/parallel_blocks.h"
#include "surface/certificate/boundary_check.h"
#include "surface/certificate/other_side.h"
#include "surface/certificate/triangle_samples.h"
#include "surface/mesh/triangle_distance.h"
#include "surface/search/occupied_blocks.h"
#include "surface/search/point_grid.h"

namespace deliso {

namespace {

constexpr double kBlock = 3;  // side of the blocks in which crossings are looked for, in distances promised
constexpr std::size_t kTrianglesAtOnce = 4096;

// Whether the isosurface passes within `reach` of p: points on either side of p tell, first those along `falling`, the
// direction in which the field is likely to fall, and in the end all around.
bool is_near(const Isosurface& isosurface, const Vec3& p, const Vec3& falling, double reach) {
  constexpr double kBeyond = 1.01;
  const bool is_above = isosurface.is_above(p);
  const auto changes = [&](const Vec3& direction, double distance) {
    const double length = norm_of_any_size(direction);
    if (!(length > 0) || !std::isfinite(length)) return false;
    const Vec3 offset = ((is_above ? distance : -distance) / length) * direction;  // the likelier side first
    return isosurface.is_above(p + offset) != is_above || isosurface.is_above(p - offset) != is_above;
  };
  if (changes(falling, reach)) return true;
  if (changes(-isosurface.gradient(p), reach)) return true;
  // As far as the values around p say that the isosurface lies, in each of its cells: just beyond that.
  bool is_found = false;
  const double value = std::abs(isosurface.value(p));
  for_each_gradient_at(isosurface, p, [&](const Vec3& gradient) {
    for (const Vec3& direction : {gradient, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      const double distance = kBeyond * value * norm_of_any_size(direction) / std::abs(dot(gradient, direction));
      is_found = is_found || (distance <= reach && changes(direction, distance));
    }
  });
  return is_found || has_other_side_within(isosurface, p, reach);
}

double squared_longest_of(const std::array<Vec3, 3>& p) {
  return std::max({squared_distance(p[0], p[1]), squared_distance(p[1], p[2]), squared_distance(p[2], p[0])});
}

struct Corners {
  std::array<Vec3, 3> p;
  Vec3 normal;  // not of unit length

  Corners(const SurfaceMesh& mesh, std::size_t triangle) {
    for (std::size_t i = 0; i < 3; ++i) p[i] = mesh.points[mesh.triangles[triangle][i]];
    normal = cross(p[1] - p[0], p[2] - p[0]);
  }
  // Whether every point of the triangle is within `reach` of a corner: so it is where the longest edge is at most the
  // square root of 3 times that, and where the circumradius is no more.
  [[nodiscard]] bool all_within(double reach) const {
    constexpr double kRounding = 1 - 1e-9;
    const double a = squared_distance(p[0], p[1]), b = squared_distance(p[1], p[2]), c = squared_distance(p[2], p[0]);
    const double squared_reach = kRounding * reach * reach;
    const double product = a * b * c;
    return std::max({a, b, c}) <= 3 * squared_reach ||
           (std::isfinite(product) && product <= 4 * squared_reach * dot(normal, normal));
  }
  [[nodiscard]] double squared_longest() const { return squared_longest_of(p); }
};

void check_triangles(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise,
                     GeometryCheck& check) {
  std::atomic<std::int64_t> off = 0;
  const auto append_if_far = [&](std::size_t t, std::vector<std::uint32_t>& far) {
    const Corners corners(mesh, t);
    if (corners.all_within(promise.max_distance)) return;
    const std::int64_t count = count_far_samples(surface.isosurface, corners.p, promise.max_distance);
    if (count == 0) return;
    off += count;
    far.push_back(static_cast<std::uint32_t>(t));
  };
  check.far_triangles =
      collect_in_blocks<std::uint32_t>(mesh.triangles.size(), surface.threads, append_if_far, kTrianglesAtOnce);
  check.mesh_off = off;
}

void check_vertices(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise,
                    GeometryCheck& check) {
  const Isosurface& isosurface = surface.isosurface;
  const auto append_if_off = [&](std::size_t v, std::vector<std::uint32_t>& off) {
    const Vec3& p = mesh.points[v];
    const auto [value, gradient] = isosurface.value_and_gradient(p);
    if (value == 0) return;
    if (!is_near(isosurface, p, -gradient, promise.max_residual)) off.push_back(std::uint32_t(v));
  };
  check.off_vertices = collect_in_blocks<std::uint32_t>(mesh.points.size(), surface.threads, append_if_off);
  check.vertices_off = static_cast<std::int64_t>(check.off_vertices.size());
}

// The crossings that no vertex is near, and no triangle with its centroid beside them, as far as those in the same
// block of space tell.
std::vector<Vec3> crossings_to_ask_for(const SurfaceMesh& mesh, const ExactSurface& surface, double reach) {
  std::vector<Vec3> centroids(mesh.triangles.size());
  for_each_block(centroids.size(), surface.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      centroids[t] = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
    }
  });
  const PointGrid vertices(mesh.points, 2 * reach), triangles(centroids, kBlock * reach);
  const auto& crossings = surface.topology.crossings;
  return collect_in_blocks<Vec3>(crossings.size(), surface.threads, [&](std::size_t i, std::vector<Vec3>& left) {
    if (!surface.wants(crossings[i])) return;
    const Vec3 p = surface.position(crossings[i]);
    const auto is_vertex_near = [&](std::uint32_t v) { return squared_distance(p, mesh.points[v]) <= reach * reach; };
    const auto is_centroid_near = [&](std::uint32_t t) { return squared_distance(p, centroids[t]) <= reach * reach; };
    const auto is_triangle_near = [&](std::uint32_t t) {
      const auto& [a, b, c] = mesh.triangles[t];
      return squared_distance_to_triangle(p, mesh.points[a], mesh.points[b], mesh.points[c]) <= reach * reach;
    };
    // The centroids are points of triangles: most of the time one of them is near enough.
    const bool is_covered = vertices.any_beside(p, is_vertex_near) || triangles.any_beside(p, is_centroid_near) ||
                            triangles.any_beside(p, is_triangle_near);
    if (!is_covered) left.push_back(p);
  });
}

// The crossings that no triangle is near. What a look beside them leaves open is asked of all triangles.
void check_crossings(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise,
                     GeometryCheck& check) {
  const double reach = promise.max_distance;
  const std::vector<Vec3> points = crossings_to_ask_for(mesh, surface, reach);
  const PointGrid grid(points, reach);
  std::vector<std::uint8_t> is_covered(points.size(), 0);
  const Vec3 around{reach, reach, reach};
  if (points.empty()) return;
  const OccupiedBlocks near_blocks(points, kBlock * reach);
  const double small = near_blocks.reach() - reach;  // a triangle far from all points by a corner, if it is no larger
  for_each_block(mesh.triangles.size(), surface.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const std::array<Vec3, 3> corners = Corners(mesh, t).p;
      if (!near_blocks.is_near(corners[0]) &&
          squared_longest_edge(mesh, static_cast<std::uint32_t>(t)) <= small * small) {
        continue;
      }
      const Box3 box = box_of(mesh, static_cast<std::uint32_t>(t));
      grid.for_each_near({box.low - around, box.high + around}, [&](std::uint32_t i) {
        const std::atomic_ref covered(is_covered[i]);
        if (covered.load(std::memory_order_relaxed) != 0) return;
        if (squared_distance_to_triangle(points[i], corners[0], corners[1], corners[2]) <= reach * reach) {
          covered.store(1, std::memory_order_relaxed);
        }
      });
    }
  });
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_covered[i] == 0) check.missed_crossings.push_back(points[i]);
  }
}

// Which way a triangle faces, as far as points on either side of its centroid tell: +1 towards lower values, as it
// should be. The nearest points that lie on different sides of the isosurface decide: farther ones may lie beyond a
// thin part; nearer ones than vertices may be off the isosurface tell nothing.
int facing(const Isosurface& isosurface, const Corners& corners) {
  // A triangle flatter than its vertices may be off the isosurface may face either way.
  const double area = norm(corners.normal), least = 2 * Promise().max_residual * std::sqrt(corners.squared_longest());
  if (!(area > least) || !std::isfinite(area)) return 0;
  const Vec3 centroid = (corners.p[0] + corners.p[1] + corners.p[2]) / 3;
  for (const double beside : {1.0 / 512, 1.0 / 64, 1.0 / 8}) {  // voxels
    const Vec3 offset = (beside / area) * corners.normal;
    const bool before = isosurface.is_above(centroid + offset), behind = isosurface.is_above(centroid - offset);
    if (before != behind) return before ? -1 : 1;
  }
  return 0;
}

// Triangles of a component agree with each other (certificate.h), so a few of them tell which way it faces.
void check_orientation(const SurfaceMesh& mesh, const ExactSurface& surface, GeometryCheck& check) {
  constexpr int kEnough = 64;  // triangles that tell
  std::vector<std::uint32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    parent[root(b)] = root(a);
    parent[root(c)] = root(a);
  }
  struct Votes {
    int count = 0, sum = 0;
  };
  std::vector<Votes> votes(mesh.points.size());  // of each component, at its root
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Votes& its = votes[root(mesh.triangles[t][0])];
    if (its.count >= kEnough) continue;
    const int vote = facing(surface.isosurface, Corners(mesh, t));
    its.count += std::abs(vote);
    its.sum += vote;
  }
  for (std::uint32_t v = 0; v < votes.size(); ++v) {
    if (votes[v].sum < 0) check.reversed_vertices.push_back(v);
  }
  check.reversed_components = static_cast<std::int64_t>(check.reversed_vertices.size());
}

}  // namespace

// Corners lie on the isosurface, so what is near them needs no look; and every point of a triangle is within its
// longest edge over the square root of 3 of a corner.
std::int64_t count_far_samples(const Isosurface& isosurface, const std::array<Vec3, 3>& corners, double most) {
  const double squared_longest = squared_longest_of(corners);
  if (squared_longest <= 3 * most * most) return 0;
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  std::int64_t count = 0;
  for_each_sample(corners, std::sqrt(squared_longest), [&](const Vec3& p) {
    const auto is_beside = [&](const Vec3& corner) { return squared_distance(p, corner) <= most * most; };
    if (std::any_of(corners.begin(), corners.end(), is_beside)) return;
    if (!is_near(isosurface, p, normal, most)) ++count;
  });
  return count;
}

GeometryCheck check_geometry(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise) {
  GeometryCheck check;
  check_vertices(mesh, surface, promise, check);
  check_triangles(mesh, surface, promise, check);
  check_crossings(mesh, surface, promise, check);
  check_orientation(mesh, surface, check);
  check.off_box_edges = boundary_edges_off_box(mesh, surface.isosurface.box(), promise.on_box);
  return check;
}

}  // namespace deliso

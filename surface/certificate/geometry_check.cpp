#include "surface/certificate/geometry_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "surface/base/parallel_blocks.h"
#include "surface/certificate/boundary_check.h"
#include "surface/certificate/far_crossings.h"
#include "surface/certificate/point_nearness.h"
#include "surface/certificate/triangle_nearness.h"

namespace deliso {

namespace {

constexpr std::size_t kTrianglesAtOnce = 4096;
constexpr std::int64_t kMostParts = 4;  // counted of a triangle

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
  [[nodiscard]] double squared_longest() const {
    return std::max({squared_distance(p[0], p[1]), squared_distance(p[1], p[2]), squared_distance(p[2], p[0])});
  }
  [[nodiscard]] bool has_edge_beyond(double length) const { return squared_longest() > length * length; }
};

// Of the triangles, those that need a closer look are found first. Returns those with a long edge (far_crossings.h).
std::vector<std::uint32_t> check_triangles(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise,
                                           const KnownBefore* known, GeometryCheck& check) {
  const TriangleReaches reaches(mesh, surface, promise);
  std::vector<std::uint32_t> large = collect_in_blocks<std::uint32_t>(
      mesh.triangles.size(), surface.threads, [&](std::size_t t, std::vector<std::uint32_t>& found) {
        if (!Corners(mesh, t).all_within(reaches[t])) found.push_back(static_cast<std::uint32_t>(t));
      });
  using Far = std::pair<std::uint32_t, std::int64_t>;  // a triangle and how many of its parts are far
  const auto append_if_far = [&](std::size_t i, std::vector<Far>& far) {
    const std::uint32_t t = large[i];
    if (surface.is_over()) return;
    const bool is_known = known != nullptr && known->far_parts[t] >= 0;
    const std::int64_t count = is_known
                                   ? known->far_parts[t]
                                   : count_far_parts(surface.isosurface, Corners(mesh, t).p, reaches[t], kMostParts);
    if (count > 0) far.emplace_back(t, count);
  };
  for (const auto& [t, count] :
       collect_in_blocks<Far>(large.size(), surface.threads, append_if_far, kTrianglesAtOnce)) {
    check.far_triangles.push_back(t);
    check.far_parts.push_back(count);
    check.mesh_off += count;
  }
  std::erase_if(large,
                [&](std::uint32_t t) { return !Corners(mesh, t).has_edge_beyond(kLongEdge * promise.max_distance); });
  return large;
}

// Block by block, for neighbours ask for the same samples of the volume.
void check_vertices(const MeshPoints& points, const ExactSurface& surface, const Promise& promise,
                    GeometryCheck& check) {
  const Isosurface& isosurface = surface.isosurface;
  const SurfaceMesh& mesh = points.mesh();
  const double most = std::min(promise.max_residual, promise.max_distance);
  const auto append_if_off = [&](std::size_t place, std::vector<std::uint32_t>& off) {
    const std::uint32_t v = points.order()[place];
    if (v >= mesh.points.size()) return;
    const Vec3& p = mesh.points[v];
    if (!is_shown_within(isosurface, p, most)) off.push_back(v);
  };
  check.off_vertices = collect_in_blocks<std::uint32_t>(points.order().size(), surface.threads, append_if_off);
  std::sort(check.off_vertices.begin(), check.off_vertices.end());
  check.vertices_off = static_cast<std::int64_t>(check.off_vertices.size());
}

void check_crossings(const MeshPoints& points, const ExactSurface& surface, const KnownBefore* known,
                     GeometryCheck& check) {
  if (known == nullptr) {
    check.missed_numbers = far_crossings(points, surface);
  } else {
    const std::vector<std::uint32_t> far = far_crossings(points, surface, known->asked);
    std::merge(known->missed.begin(), known->missed.end(), far.begin(), far.end(),
               std::back_inserter(check.missed_numbers));
  }
}

void check_cells(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise, const KnownBefore* known,
                 GeometryCheck& check) {
  const double most = promise.max_distance;
  if (!promise.within_cells) return;
  if (known == nullptr) {
    check.missed_places = missed_places(mesh, surface, most, crossed_cells(surface));
  } else {
    const std::vector<MissedPlace> found = missed_places(mesh, surface, most, known->asked_cells);
    std::merge(known->missed_places.begin(), known->missed_places.end(), found.begin(), found.end(),
               std::back_inserter(check.missed_places),
               [](const MissedPlace& a, const MissedPlace& b) { return a.cell < b.cell; });
  }
}

void list_missed_points(const ExactSurface& surface, GeometryCheck& check) {
  for (const std::uint32_t number : check.missed_numbers) {
    check.missed_points.push_back(surface.position(surface.topology.crossings[number]));
  }
  for (const MissedPlace& missed : check.missed_places) check.missed_points.push_back(missed.position);
}

// A triangle flatter than its vertices may be off the isosurface may face either way.
bool may_face_either_way(const Corners& corners) {
  const double area = norm(corners.normal), least = 2 * Promise().max_residual * std::sqrt(corners.squared_longest());
  return !(area > least) || !std::isfinite(area);
}

constexpr double kFarthestBeside = 1.0 / 8;  // voxels

// Which way a triangle faces, as far as points on either side of its centroid tell: +1 towards lower values, as it
// should be. The nearest points that lie on different sides of the isosurface decide: farther ones may lie beyond a
// thin part; nearer ones than vertices may be off the isosurface tell nothing.
int facing(const Isosurface& isosurface, const Corners& corners) {
  if (may_face_either_way(corners)) return 0;
  const Vec3 centroid = (corners.p[0] + corners.p[1] + corners.p[2]) / 3;
  for (const double beside : {1.0 / 512, 1.0 / 64, kFarthestBeside}) {
    const Vec3 offset = (beside / norm(corners.normal)) * corners.normal;
    const bool before = isosurface.is_above(centroid + offset), behind = isosurface.is_above(centroid - offset);
    if (before != behind) return before ? -1 : 1;
  }
  return 0;
}

// The same by the gradient at the centroid, of a triangle so large that all such points may lie on one side: corners
// lie on the isosurface, and every point is within the longest edge over the square root of 3 of one.
int facing_by_gradient(const Isosurface& isosurface, const Corners& corners) {
  const bool is_large = corners.squared_longest() > 3 * kFarthestBeside * kFarthestBeside;
  if (!is_large || may_face_either_way(corners)) return 0;
  const double slope = dot(isosurface.gradient((corners.p[0] + corners.p[1] + corners.p[2]) / 3), corners.normal);
  return slope < 0 ? 1 : (slope > 0 ? -1 : 0);
}

// The solid angle of a triangle seen from a point, above 0 where it faces away from it (Van Oosterom and Strackee, The
// solid angle of a plane triangle, 1983).
double solid_angle(const Vec3& from, const Corners& corners) {
  const Vec3 a = corners.p[0] - from, b = corners.p[1] - from, c = corners.p[2] - from;
  const double to_a = norm(a), to_b = norm(b), to_c = norm(c);
  return 2 *
         std::atan2(dot(a, cross(b, c)), to_a * to_b * to_c + dot(a, b) * to_c + dot(b, c) * to_a + dot(c, a) * to_b);
}

// Whether a component faces lower values whose triangles do not tell: where it is far smaller than a voxel points
// beside one triangle may lie beyond others, and across the bend of a thin tube triangles lie outside of it. Extremes
// of the interpolant are at samples, so it winds around samples beside it, on the box half around them; these have to
// agree. Nothing where it winds around none of them, or is large.
std::optional<bool> winds_as_it_should(const SurfaceMesh& mesh, const std::vector<std::size_t>& triangles,
                                       const Isosurface& isosurface) {
  constexpr std::size_t kMostTriangles = 1000;
  if (triangles.size() > kMostTriangles) return std::nullopt;
  std::set<std::array<double, 3>> samples;
  for (const std::size_t t : triangles) {
    for (const Vec3& p : Corners(mesh, t).p) {
      const Vec3& step = isosurface.step();
      samples.insert({std::round(p.x / step.x), std::round(p.y / step.y), std::round(p.z / step.z)});
    }
  }
  std::optional<bool> is_so;
  for (const auto& [x, y, z] : samples) {
    const Vec3 sample = {x * isosurface.step().x, y * isosurface.step().y, z * isosurface.step().z};
    double winding = 0;
    for (const std::size_t t : triangles) winding += solid_angle(sample, Corners(mesh, t)) / (4 * std::numbers::pi);
    if (std::abs(winding) < 0.25) continue;
    const bool agrees = (winding > 0) == isosurface.is_above(sample);
    if (is_so && *is_so != agrees) return std::nullopt;
    is_so = agrees;
  }
  return is_so;
}

// Triangles of a component agree with each other (certificate.h), so a few of them tell which way it faces. Where these
// are against it all are asked: beside walls thinner than the mesh may be off the first ones may all lie on the other
// side. Where none tells, as of what is nearly nothing, the samples that the component winds around do.
void check_orientation(const SurfaceMesh& mesh, const ExactSurface& surface, GeometryCheck& check) {
  constexpr int kEnough = 64;  // triangles that tell
  std::vector<std::uint32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    if (parent[a] == parent[b] && parent[b] == parent[c]) continue;  // nearly all, once most are joined
    parent[root(b)] = root(a);
    parent[root(c)] = root(a);
  }
  struct Votes {
    int count = 0, sum = 0;
  };
  std::vector<Votes> votes(mesh.points.size());  // of each component, at its root
  const auto add = [](Votes& its, int vote) {
    its.count += std::abs(vote);
    its.sum += vote;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Votes& its = votes[root(mesh.triangles[t][0])];
    if (its.count < kEnough) add(its, facing(surface.isosurface, Corners(mesh, t)));
  }
  // The few large triangles of a component may all lie too far from the isosurface for points to tell.
  std::vector<bool> is_silent(votes.size());
  bool is_any_silent = false;
  for (std::uint32_t v = 0; v < votes.size(); ++v) {
    is_silent[v] = parent[v] == v && votes[v].count == 0;
    is_any_silent = is_any_silent || is_silent[v];
  }
  for (std::size_t t = 0; is_any_silent && t < mesh.triangles.size(); ++t) {
    const std::uint32_t component = root(mesh.triangles[t][0]);
    if (is_silent[component]) add(votes[component], facing_by_gradient(surface.isosurface, Corners(mesh, t)));
  }
  std::map<std::uint32_t, std::vector<std::size_t>> against;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t component = root(mesh.triangles[t][0]);
    if (votes[component].sum < 0 || votes[component].count == 0) against[component].push_back(t);
  }
  for (const auto& [component, triangles] : against) {
    Votes all;
    for (const std::size_t t : triangles) add(all, facing(surface.isosurface, Corners(mesh, t)));
    const bool if_unknown = votes[component].count == 0;
    if (all.sum <= 0 && !winds_as_it_should(mesh, triangles, surface.isosurface).value_or(if_unknown)) {
      check.reversed_vertices.push_back(component);
    }
  }
  check.reversed_components = static_cast<std::int64_t>(check.reversed_vertices.size());
}

}  // namespace

GeometryCheck check_distances(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise,
                              const KnownBefore* known) {
  GeometryCheck check;
  const MeshPoints points(mesh, promise.max_distance, check_triangles(mesh, surface, promise, known, check));
  if (surface.is_over()) return check;
  check_cells(mesh, surface, promise, known, check);
  check_crossings(points, surface, known, check);
  list_missed_points(surface, check);
  return check;
}

GeometryCheck check_geometry(const SurfaceMesh& mesh, const ExactSurface& surface, const Promise& promise,
                             const KnownBefore* known) {
  GeometryCheck check;
  const MeshPoints points(mesh, promise.max_distance, check_triangles(mesh, surface, promise, known, check));
  if (surface.is_over()) return check;
  check_vertices(points, surface, promise, check);
  check_cells(mesh, surface, promise, known, check);
  // Two of these have no parts for several threads.
  run_tasks(3, surface.threads, [&](std::size_t task) {
    if (task == 0) check_crossings(points, surface, known, check);
    if (task == 1) check_orientation(mesh, surface, check);
    if (task == 2) check.off_box_edges = boundary_edges_off_box(mesh, surface.isosurface.box(), promise.on_box);
  });
  list_missed_points(surface, check);
  return check;
}

}  // namespace deliso

#include "surface/verification/verification.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/base/counted.h"
#include "delaunay/base/stopwatch.h"
#include "surface/certificate/component_assignment.h"
#include "surface/mesh/mesh_topology.h"
#include "surface/verification/delaunay_balls.h"
#include "surface/verification/dropped_components.h"
#include "surface/verification/facing_votes.h"
#include "surface/verification/inner_crossings.h"
#include "surface/verification/isosurface_probe.h"
#include "volume/topology/exact_topology.h"

namespace deliso {

namespace {

constexpr double kOnBox = Promise().on_box;
constexpr std::size_t kMostPlaces = 10;

// Triangles with the same three vertices as an earlier one, whatever their order.
std::int64_t count_duplicates(const TriangleMesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> sorted = mesh.triangles;
  for (auto& triangle : sorted) std::sort(triangle.begin(), triangle.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted.end() - std::unique(sorted.begin(), sorted.end());
}

ManifoldCheck check_manifold(const TriangleMesh& mesh, const MeshTopology& topology, std::int64_t zero_area) {
  ManifoldCheck check;
  check.non_manifold_edges = topology.non_manifold_edges;
  check.non_manifold_vertices = topology.non_manifold_vertices;
  check.repeated_vertices = topology.repeated_vertices;
  check.duplicate_triangles = count_duplicates(mesh);
  check.zero_area_triangles = zero_area;
  check.unreferenced_vertices = topology.unreferenced_vertices;
  check.components = static_cast<std::int64_t>(topology.components.size());
  for (const MeshComponent& component : topology.components) {
    check.euler_characteristic += component.euler_characteristic();
    check.boundary_loops += component.boundary_loops;
  }
  check.pass = topology.is_manifold() && !mesh.triangles.empty();
  return check;
}

// A vertex of each of the first components with negative votes.
std::vector<Vec3> reversed_places(const TriangleMesh& mesh, const MeshTopology& topology,
                                  std::vector<std::int64_t> votes) {
  std::vector<Vec3> places;
  for (const auto& triangle : mesh.triangles) {
    std::int64_t& of_component = votes[topology.component_of_vertex[triangle[0]]];
    if (of_component >= 0 || places.size() == kMostPlaces) continue;
    places.push_back(mesh.points[triangle[0]]);
    of_component = 0;  // reported already
  }
  return places;
}

// The isosurface near the centroid of a triangle: the direction of descent there, whose length is the slope, and the
// distance.
struct NextToCentroid {
  Vec3 descent;
  double distance = 0;
};

std::vector<NextToCentroid> look_next_to_centroids(const TriangleMesh& voxels, IsosurfaceProbe& probe) {
  std::vector<NextToCentroid> result;
  result.reserve(voxels.triangles.size());
  for (const auto& [a, b, c] : voxels.triangles) {
    const FootPoint foot = probe.foot_point((voxels.points[a] + voxels.points[b] + voxels.points[c]) / 3);
    result.push_back({-probe.gradient(foot.point), foot.distance});
  }
  return result;
}

// `voxels` is the mesh in voxel space.
OrientationCheck check_orientation(const TriangleMesh& mesh, const TriangleMesh& voxels, const MeshTopology& topology,
                                   const IsosurfaceProbe& probe) {
  OrientationCheck check;
  check.misoriented_edges = topology.misoriented_edges;
  std::vector<std::int64_t> votes =
      facing_votes(voxels, topology.component_of_vertex, topology.components.size(), probe);
  check.reversed_components = std::count_if(votes.begin(), votes.end(), [](std::int64_t v) { return v < 0; });
  check.pass = topology.is_oriented() && check.reversed_components == 0;
  check.reversed_at = reversed_places(mesh, topology, std::move(votes));
  return check;
}

// The faces of the box that p lies on, as bits.
unsigned faces_at(const Box3& box, const Vec3& p) {
  unsigned faces = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(p[axis] - box.low[axis]) <= kOnBox) faces |= 1u << (2 * axis);
    if (std::abs(p[axis] - box.high[axis]) <= kOnBox) faces |= 2u << (2 * axis);
  }
  return faces;
}

BoundaryCheck check_boundary(const TriangleMesh& voxels, const MeshTopology& topology, const Box3& box) {
  BoundaryCheck check;
  check.boundary_edges = static_cast<std::int64_t>(topology.boundary_edges.size());
  for (const MeshEdge& edge : topology.boundary_edges) {
    const unsigned common = faces_at(box, voxels.points[edge.low]) & faces_at(box, voxels.points[edge.high]);
    check.off_box_edges += common == 0 ? 1 : 0;
  }
  check.outside_vertices = std::count_if(voxels.points.begin(), voxels.points.end(),
                                         [&](const Vec3& p) { return distance(p, box.clamp(p)) > kOnBox; });
  check.pass = check.off_box_edges == 0;
  return check;
}

NormalCheck check_normals(const TriangleMesh& voxels, std::span<const NextToCentroid> next) {
  NormalCheck check;
  double sum = 0;
  std::int64_t count = 0;
  for (std::size_t t = 0; t < voxels.triangles.size(); ++t) {
    const auto& [ia, ib, ic] = voxels.triangles[t];
    const Vec3 &a = voxels.points[ia], &b = voxels.points[ib], &c = voxels.points[ic];
    const Vec3 normal = cross(b - a, c - a);
    const double area = norm(normal), steepness = norm_of_any_size(next[t].descent);
    if (!(area > 0 && steepness > 0 && std::isfinite(steepness))) continue;
    const double cosine = dot(normal / area, next[t].descent / steepness);
    check.min_cosine = std::min(check.min_cosine, cosine);
    check.against += cosine < 0 ? 1 : 0;
    sum += cosine;
    ++count;
  }
  if (count > 0) {
    check.fraction_against = static_cast<double>(check.against) / static_cast<double>(count);
    check.mean_cosine = sum / static_cast<double>(count);
  }
  check.pass = check.against == 0;
  return check;
}

void in_world(DistanceFigure& figure, const IsosurfaceProbe& probe) { figure.worst = probe.to_world(figure.worst); }

// The points of the isosurface whose distances are judged: its crossings with the edges of the grid, and for distances
// below kLarge also with those of a finer one.
std::vector<Vec3> judged_points(const ScalarGrid& grid, double isovalue, const IsosurfaceProbe& probe,
                                const IsosurfaceTopology& truth, std::span<const std::uint8_t> is_dropped,
                                double most) {
  constexpr double kLarge = 0.75, kSpacing = 1.5;  // voxels; of the finer grid, in distances judged
  constexpr int kMostTimes = 4;
  std::vector<Vec3> points = kept_crossings(probe, truth, is_dropped);
  if (!(most < kLarge)) return points;
  const int times = static_cast<int>(std::clamp(std::ceil(1 / (kSpacing * most)), 2.0, double(kMostTimes)));
  for (const Vec3& p : inner_crossings(grid, isovalue, truth, is_dropped, times)) {
    points.push_back(scaled(probe.step(), p));
  }
  return points;
}

// The distances beyond what is promised.
struct DistanceCounts {
  std::int64_t vertices = 0, mesh = 0, isosurface = 0;
};

DistanceCounts check_distances(const TriangleMesh& voxels, IsosurfaceProbe& probe, const std::vector<Vec3>& crossings,
                               std::span<const std::optional<double>> off, const Promise& promise, Verification& v) {
  // Maps to the world and back, which the mesher's own check has not seen, move points by rounding.
  constexpr double kRounding = 1e-9;
  const double most = (1 + kRounding) * promise.max_distance;
  DistanceCounts counts;
  v.residual.distance = vertices_to_isosurface(voxels, off);
  counts.vertices =
      std::count_if(off.begin(), off.end(), [&](const auto& d) { return d && *d > promise.max_residual; });
  v.residual.pass = counts.vertices == 0;
  v.distance.mesh_to_isosurface = triangles_to_isosurface(voxels, probe, most, &counts.mesh);
  v.distance.isosurface_to_mesh = points_to_mesh(crossings, voxels, probe.box().diagonal(), most, &counts.isosurface);
  v.distance.pass = counts.mesh == 0 && counts.isosurface == 0;
  in_world(v.residual.distance, probe);
  in_world(v.distance.mesh_to_isosurface, probe);
  in_world(v.distance.isosurface_to_mesh, probe);
  return counts;
}

// What the promise is judged by.
PromiseFigures figures_of(const Verification& v, const DistanceCounts& counts) {
  const ManifoldCheck& m = v.manifold;
  PromiseFigures figures;
  figures.triangles = v.triangles;
  figures.is_manifold = m.pass;
  figures.manifold_faults =
      counted(m.non_manifold_edges, "edge with three or more triangles, ", "edges with three or more triangles, ") +
      counted(m.non_manifold_vertices, "vertex with several umbrellas, ", "vertices with several umbrellas, ") +
      counted(m.repeated_vertices, "triangle that names a vertex twice", "triangles that name a vertex twice");
  figures.misoriented_edges = v.orientation.misoriented_edges;
  figures.reversed_components = v.orientation.reversed_components;
  figures.off_box_edges = v.boundary.off_box_edges;
  figures.topology = v.topology.verdict;
  figures.crossing_pairs = v.self_intersection.found.crossing_pairs;
  figures.touching_pairs = v.self_intersection.found.touching_pairs;
  figures.zero_area_triangles = m.zero_area_triangles;
  figures.vertices_off = counts.vertices;
  figures.mesh_off = counts.mesh;
  figures.isosurface_off = counts.isosurface;
  figures.worst_vertex = v.residual.distance.max_voxels;
  figures.worst_mesh = v.distance.mesh_to_isosurface.max_voxels;
  figures.worst_isosurface = v.distance.isosurface_to_mesh.max_voxels;
  return figures;
}

void check_input(const TriangleMesh& mesh, const ScalarGrid& grid, double isovalue) {
  check_triangles(mesh);
  const auto [lowest, highest] = grid.range();
  if (!(lowest <= isovalue && isovalue <= highest)) {
    throw InputError("the isovalue is " + std::to_string(isovalue) +
                     ", expected a number in the range of the volume, " + std::to_string(lowest) + " to " +
                     std::to_string(highest));
  }
}

}  // namespace

Verification verify_mesh(const TriangleMesh& mesh, const ScalarGrid& grid, double isovalue, const Promise& promise,
                         const VerificationProgress& progress, std::span<const Vec3> written) {
  const Stopwatch stopwatch;
  const auto begin = [&](double share, std::string_view step) {
    if (progress) progress(share, step);
  };
  check_input(mesh, grid, isovalue);
  Verification v;
  v.vertices = static_cast<std::int64_t>(mesh.points.size());
  v.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  v.isovalue = isovalue;

  // Ground truth.
  begin(0, "exact topology");
  const RegularTopology regular = regular_topology(grid, isovalue);
  const IsosurfaceTopology& truth = regular.topology;
  v.isovalue_used = regular.isovalue;
  if (truth.crossings.empty()) {
    throw InputError("the isosurface of " + std::to_string(isovalue) + " has no point in this volume");
  }
  IsosurfaceProbe probe(grid, v.isovalue_used, truth.crossings);
  const std::vector<std::uint8_t> is_dropped = components_left_out(mesh, grid, regular, promise);
  TriangleMesh voxels = mesh;
  for (Vec3& p : voxels.points) p = probe.to_voxels(p);
  begin(0.1, "vertices");
  const std::vector<std::optional<double>> off = vertex_distances(voxels, probe, promise.max_residual);
  const std::vector<NextToCentroid> next = look_next_to_centroids(voxels, probe);

  // Combinatorics.
  begin(0.3, "triangles that cross");
  v.self_intersection.found =
      self_intersections(written.empty() ? std::span<const Vec3>(mesh.points) : written, mesh.triangles, kMostPlaces);
  v.self_intersection.pass = v.self_intersection.found.meeting_pairs() == 0;
  AssignmentFaults faults;
  begin(0.4, "components");
  {
    const MeshTopology topology = mesh_topology(mesh);
    faults = assignment_faults(mesh, topology, grid, regular.isovalue, truth, is_dropped);
    v.manifold = check_manifold(mesh, topology, v.self_intersection.found.zero_area_triangles);
    v.orientation = check_orientation(mesh, voxels, topology, probe);
    v.boundary = check_boundary(voxels, topology, probe.box());
  }
  v.topology = certify_kept(mesh, truth, is_dropped);
  if (promise.dropped_components > 0 && is_dropped.empty()) refuse_dropped(promise.dropped_components, v.topology);
  add_assignment_faults(faults, v.topology);

  // Geometry.
  begin(0.5, "distances");
  const DistanceCounts counts = check_distances(
      voxels, probe, judged_points(grid, v.isovalue_used, probe, truth, is_dropped, promise.max_distance), off, promise,
      v);
  v.normals = check_normals(voxels, next);
  begin(0.8, "Delaunay balls");
  v.delaunay_balls = check_delaunay_balls(voxels, grid, v.isovalue_used);
  v.quality = measure_quality(mesh);

  v.failures = broken_promises(figures_of(v, counts), promise);
  v.proven = v.failures.empty();
  v.seconds = stopwatch.seconds();
  return v;
}

}  // namespace deliso

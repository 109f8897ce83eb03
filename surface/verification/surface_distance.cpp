#include "surface/verification/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "surface/certificate/promise.h"
#include "surface/search/box_tree.h"

namespace deliso {

namespace {

// Gathers maximum and weighted mean.
class FigureBuilder {
 public:
  void add(double distance, double weight, const Vec3& where) {
    if (distance > figure_.max_voxels || count_ == 0) {
      figure_.max_voxels = distance;
      figure_.worst = where;
    }
    sum_ += weight * distance;
    weight_ += weight;
    plain_sum_ += distance;
    ++count_;
  }
  [[nodiscard]] DistanceFigure figure() const {
    DistanceFigure result = figure_;
    if (weight_ > 0) {
      result.mean_voxels = sum_ / weight_;
    } else if (count_ > 0) {
      result.mean_voxels = plain_sum_ / static_cast<double>(count_);  // of triangles without area
    }
    return result;
  }

 private:
  DistanceFigure figure_;
  double sum_ = 0;
  double weight_ = 0;
  double plain_sum_ = 0;
  std::int64_t count_ = 0;
};

// The squared distance from p to the triangle abc: to the nearest point of its three edges, or to the foot of p in its
// plane when its barycentric weights are not negative. Rounded weights still give a point of the triangle. The mesher
// uses another formula (surface/mesh/triangle_distance.h).
double squared_distance_to(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  double least = squared_distance(p, a);
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    const double length = squared_norm(to - from);
    if (!(length > 0)) continue;
    const double along = std::clamp(dot(p - from, to - from) / length, 0.0, 1.0);
    least = std::min(least, squared_distance(p, from + along * (to - from)));
  }
  const Vec3 u = b - a, v = c - a, w = p - a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double determinant = uu * vv - uv * uv;
  const double of_b = (vv * uw - uv * vw) / determinant, of_c = (uu * vw - uv * uw) / determinant;
  if (of_b >= 0 && of_c >= 0 && of_b + of_c <= 1) least = std::min(least, squared_distance(p, a + of_b * u + of_c * v));
  return least;
}

// Appends the points at which edges of a triangle pass from one voxel cell to the next, for each face between cells
// that cuts two edges the point in the middle, and the middles of the edges. Edges that hardly change in an axis pass
// no face across it. A mesh may lie anywhere, but cells are within the box alone.
void append_cuts_by_cell_faces(const std::array<Vec3, 3>& corners, const IsosurfaceProbe& probe,
                               std::vector<Vec3>& samples) {
  constexpr double kLeastChange = 1e-3;  // cells
  // Whether an edge lies in a face, rounding may decide: its middle is a sample in any case.
  for (std::size_t i = 0; i < 3; ++i) samples.push_back((corners[i] + corners[(i + 1) % 3]) / 2);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double cell = probe.step()[axis];
    double from = corners[0][axis], to = from;
    for (const Vec3& p : corners) {
      from = std::min(from, p[axis]);
      to = std::max(to, p[axis]);
    }
    from = std::clamp(from, probe.box().low[axis], probe.box().high[axis]);
    to = std::clamp(to, probe.box().low[axis], probe.box().high[axis]);
    const auto first = static_cast<std::int64_t>(std::ceil(from / cell));
    const auto last = static_cast<std::int64_t>(std::floor(to / cell));
    for (std::int64_t number = first; number <= last; ++number) {
      const double face = static_cast<double>(number) * cell;
      std::vector<Vec3> cuts;
      for (const auto& [p, q] :
           {std::pair(corners[0], corners[1]), std::pair(corners[1], corners[2]), std::pair(corners[2], corners[0])}) {
        const double change = q[axis] - p[axis];
        if (std::abs(change) < kLeastChange * cell || (p[axis] < face) == (q[axis] < face)) continue;
        cuts.push_back(p + ((face - p[axis]) / change) * (q - p));
      }
      samples.insert(samples.end(), cuts.begin(), cuts.end());
      if (cuts.size() == 2) samples.push_back((cuts[0] + cuts[1]) / 2);
    }
  }
}

}  // namespace

std::vector<std::optional<double>> vertex_distances(const TriangleMesh& mesh, IsosurfaceProbe& probe, double most) {
  std::vector<bool> is_referenced(mesh.points.size(), false);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) is_referenced[v] = true;
  }
  std::vector<std::optional<double>> distances(mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (is_referenced[v]) distances[v] = probe.nearest_point(mesh.points[v], most).distance;
  }
  return distances;
}

DistanceFigure vertices_to_isosurface(const TriangleMesh& mesh, std::span<const std::optional<double>> distances) {
  FigureBuilder builder;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (distances[v]) builder.add(*distances[v], 1, mesh.points[v]);
  }
  return builder.figure();
}

DistanceFigure triangles_to_isosurface(const TriangleMesh& mesh, IsosurfaceProbe& probe, double most,
                                       std::int64_t* beyond) {
  // A voxel, or where less is judged less.
  constexpr double kApart = 2, kLeastApart = 0.25;  // in distances judged; voxels
  const double apart = most > 0 ? std::clamp(kApart * most, kLeastApart, 1.0) : 1;
  FigureBuilder builder;
  std::vector<Vec3> samples;
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Vec3 &a = mesh.points[ia], &b = mesh.points[ib], &c = mesh.points[ic];
    const double longest =
        std::sqrt(std::max({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)}));
    // An edge as long as some voxels may be a hair longer in the world and back.
    constexpr double kRounding = 1e-9;
    const int order =
        static_cast<int>(std::clamp(std::ceil((1 - kRounding) * longest / apart), 2.0, double(kMostSamplesPerEdge)));
    // The points of a lattice except the corners, and the centroid.
    samples.clear();
    samples.push_back((a + b + c) / 3);
    for (int i = 0; i <= order; ++i) {
      for (int j = 0; i + j <= order; ++j) {
        if (std::max({i, j, order - i - j}) == order) continue;
        samples.push_back((double(i) * a + double(j) * b + double(order - i - j) * c) / double(order));
      }
    }
    // The mean is over points that are spread evenly.
    const std::size_t even = samples.size();
    const double weight = 0.5 * norm(cross(b - a, c - a)) / static_cast<double>(even);
    // Every point of a triangle is within its longest edge over the square root of 3 of a corner.
    if (longest * longest > 3 * most * most) append_cuts_by_cell_faces({a, b, c}, probe, samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double distance = probe.foot_point(samples[i], most).distance;
      builder.add(distance, i < even ? weight : 0, samples[i]);
      if (beyond != nullptr && distance > most) ++*beyond;
    }
  }
  return builder.figure();
}

DistanceFigure points_to_mesh(std::span<const Vec3> points, const TriangleMesh& mesh, double if_empty, double most,
                              std::int64_t* beyond) {
  if (points.empty()) return {};
  if (mesh.triangles.empty()) {
    if (beyond != nullptr) *beyond = static_cast<std::int64_t>(points.size());
    return {if_empty, if_empty, points[0]};
  }
  std::vector<Box3> boxes(mesh.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) boxes[t].extend(mesh.points[v]);
  }
  const BoxTree tree(boxes);

  FigureBuilder builder;
  std::uint32_t nearest = 0;
  for (const Vec3& p : points) {
    const auto measure = [&](std::uint32_t t) {
      const auto& [a, b, c] = mesh.triangles[t];
      return squared_distance_to(p, mesh.points[a], mesh.points[b], mesh.points[c]);
    };
    // Consecutive points are mostly neighbours: the last nearest triangle gives a bound for the next.
    const double bound = measure(nearest);
    const auto [better, squared] = tree.nearest(p, bound, measure);
    if (better != BoxTree::kNone) nearest = better;
    builder.add(std::sqrt(squared), 1, p);
    if (beyond != nullptr && squared > most * most) ++*beyond;
  }
  return builder.figure();
}

}  // namespace deliso

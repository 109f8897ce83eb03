#include "surface/mesh_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "surface/blocks.h"

namespace deliso {

namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

struct TriangleShape {
  double min_angle = 0;  // degrees
  double max_angle = 0;
  double radius_edge = kDegenerateRadiusEdge;
  bool is_degenerate = true;
};

// The angle between two vectors in degrees; accurate for small and flat angles alike.
double angle_between(const Vec3& u, const Vec3& v) {
  return std::atan2(norm(cross(u, v)), dot(u, v)) * kDegreesPerRadian;
}

TriangleShape shape_of(Vec3 a, Vec3 b, Vec3 c) {
  // Bring the triangle to unit size at the origin, so that nothing overflows or underflows.
  const Vec3 anchor = a;
  b = 0.5 * b - 0.5 * anchor;
  c = 0.5 * c - 0.5 * anchor;
  const double size =
      std::max({std::abs(b.x), std::abs(b.y), std::abs(b.z), std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  if (size == 0) return {0, 90, kDegenerateRadiusEdge, true};
  const int exponent = std::ilogb(size);
  const auto to_unit = [exponent](double x) { return std::ldexp(x, -exponent); };
  b = {to_unit(b.x), to_unit(b.y), to_unit(b.z)};
  c = {to_unit(c.x), to_unit(c.y), to_unit(c.z)};

  // Every angle from its own two edges.
  const double at_a = angle_between(b, c), at_b = angle_between(c - b, -b), at_c = angle_between(-c, b - c);
  TriangleShape shape;
  shape.min_angle = std::min({at_a, at_b, at_c});
  shape.max_angle = std::max({at_a, at_b, at_c});

  // R / l = l1 l2 / (2 |cross|) with the two longer edges l1, l2: R = l l1 l2 / (4 area).
  const double lab = norm(b), lac = norm(c), lbc = norm(c - b);
  const double shortest = std::min({lab, lac, lbc});
  const double doubled_area = norm(cross(b, c));
  const double longer = shortest == lab ? lac * lbc : shortest == lac ? lab * lbc : lab * lac;
  // An area within rounding of zero (of products of unit numbers) says nothing.
  shape.is_degenerate = shortest == 0 || doubled_area <= 4e-16 * longer;
  if (shortest == 0) {
    shape.min_angle = 0;
    shape.max_angle = 90;
  }
  if (!shape.is_degenerate) shape.radius_edge = std::min(longer / (2 * doubled_area), kDegenerateRadiusEdge);
  return shape;
}

// Figures of some triangles.
struct Figures {
  double min_angle = 180;
  double max_angle = 0;
  double sum_of_min_angles = 0;
  std::int64_t below_30 = 0;
  std::int64_t degenerate = 0;
  std::array<std::int64_t, 12> histogram{};

  void add(const TriangleShape& shape) {
    min_angle = std::min(min_angle, shape.min_angle);
    max_angle = std::max(max_angle, shape.max_angle);
    sum_of_min_angles += shape.min_angle;
    below_30 += shape.min_angle < 30 ? 1 : 0;
    degenerate += shape.is_degenerate ? 1 : 0;
    ++histogram[std::min<std::size_t>(histogram.size() - 1, static_cast<std::size_t>(shape.min_angle / 5))];
  }
  void add(const Figures& other) {
    min_angle = std::min(min_angle, other.min_angle);
    max_angle = std::max(max_angle, other.max_angle);
    sum_of_min_angles += other.sum_of_min_angles;
    below_30 += other.below_30;
    degenerate += other.degenerate;
    for (std::size_t i = 0; i < histogram.size(); ++i) histogram[i] += other.histogram[i];
  }
};

}  // namespace

MeshQuality measure_quality(const TriangleMesh& mesh, int threads) {
  if (mesh.triangles.empty()) return {};
  // By blocks, which are added in order.
  std::vector<double> radius_edges(mesh.triangles.size());
  std::vector<Figures> blocks((mesh.triangles.size() + kBlockSize - 1) / kBlockSize);
  for_each_block(mesh.triangles.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const auto [a, b, c] = mesh.triangles[t];
      const TriangleShape shape = shape_of(mesh.points[a], mesh.points[b], mesh.points[c]);
      blocks[first / kBlockSize].add(shape);
      radius_edges[t] = shape.radius_edge;
    }
  });
  Figures sum;
  for (const Figures& block : blocks) sum.add(block);

  MeshQuality quality;
  quality.min_angle_degrees = sum.min_angle;
  quality.max_angle_degrees = sum.max_angle;
  quality.degenerate_triangles = sum.degenerate;
  quality.min_angle_histogram = sum.histogram;
  const auto count = static_cast<double>(mesh.triangles.size());
  quality.mean_min_angle_degrees = sum.sum_of_min_angles / count;
  quality.fraction_min_angle_below_30 = static_cast<double>(sum.below_30) / count;
  // The 99th percentile: the smallest value that at least 99 % do not exceed.
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.99 * count)) - 1;
  std::nth_element(radius_edges.begin(), radius_edges.begin() + rank, radius_edges.end());
  quality.radius_edge_p99 = radius_edges[static_cast<std::size_t>(rank)];
  quality.radius_edge_max = *std::max_element(radius_edges.begin() + rank, radius_edges.end());
  return quality;
}

}  // namespace deliso

#include "surface/mesh/mesh_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "surface/base/parallel_blocks.h"

namespace deliso {

namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

// The angle between two vectors, stored as its sine and cosine times their lengths. This is accurate for small and flat
// angles alike, and angles compare without an arctangent.
struct Angle {
  double across = 0;
  double along = 1;

  [[nodiscard]] double degrees() const { return std::atan2(across, along) * kDegreesPerRadian; }
};
Angle angle_between(const Vec3& u, const Vec3& v) { return {norm(cross(u, v)), dot(u, v)}; }
bool is_larger(const Angle& a, const Angle& b) { return b.along * a.across > a.along * b.across; }

// Scales the triangle 0bc to about unit size, so that products neither overflow nor underflow. False when its corners
// coincide.
bool bring_to_size(Vec3& b, Vec3& c) {
  constexpr double kModest = 0x1p100;
  constexpr int kLargest = 1000;  // a power of two that still has an inverse
  const double size =
      std::max({std::abs(b.x), std::abs(b.y), std::abs(b.z), std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  if (size > 1 / kModest && size < kModest) return true;
  if (size == 0) return false;
  const double scale = std::ldexp(1.0, -std::clamp(std::ilogb(size), -kLargest, kLargest));
  b = scale * b;
  c = scale * c;
  return true;
}

// The edges of a triangle, seen from its first corner.
struct Edges {
  Vec3 b, c;                           // the other two corners
  std::array<double, 3> across{};      // the length of the edge opposite each corner
  unsigned smallest = 0, largest = 0;  // the corners opposite the shortest and the longest edge
};

Edges edges_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  Edges edges{0.5 * b - 0.5 * a, 0.5 * c - 0.5 * a};  // halved terms cannot overflow
  if (!bring_to_size(edges.b, edges.c)) return edges;
  edges.across = {norm(edges.c - edges.b), norm(edges.c), norm(edges.b)};
  // Which edges these are is unpredictable, so corners are selected by number.
  const auto& across = edges.across;
  const auto corner_across = [&](double length) {
    return static_cast<unsigned>(length != across[0]) * (1u + static_cast<unsigned>(length != across[1]));
  };
  edges.smallest = corner_across(std::min(std::min(across[0], across[1]), across[2]));
  edges.largest = corner_across(std::max(std::max(across[0], across[1]), across[2]));
  return edges;
}

struct TriangleShape {
  Angle min_angle = {0, 1};
  double radius_edge = kDegenerateRadiusEdge;
  bool is_degenerate = true;
};

// Quality figures of some triangles.
struct Figures {
  double min_angle = 180;
  Angle max_angle = {1, 1};  // starts above the largest angle of any triangle
  double sum_of_min_angles = 0;
  std::int64_t below_30 = 0;
  std::int64_t degenerate = 0;
  std::array<std::int64_t, 12> histogram{};

  void add(const TriangleShape& shape) {
    const double degrees = shape.min_angle.degrees();
    min_angle = std::min(min_angle, degrees);
    sum_of_min_angles += degrees;
    below_30 += degrees < 30 ? 1 : 0;
    degenerate += shape.is_degenerate ? 1 : 0;
    ++histogram[std::min<std::size_t>(histogram.size() - 1, static_cast<std::size_t>(degrees / 5))];
  }
  // The largest angle of a triangle.
  void add_largest(const Angle& angle) {
    if (is_larger(angle, max_angle)) max_angle = angle;
  }
  void add(const Figures& other) {
    min_angle = std::min(min_angle, other.min_angle);
    add_largest(other.max_angle);
    sum_of_min_angles += other.sum_of_min_angles;
    below_30 += other.below_30;
    degenerate += other.degenerate;
    for (std::size_t i = 0; i < histogram.size(); ++i) histogram[i] += other.histogram[i];
  }
};

// Each angle from its own two edges. Adds the largest one to the figures.
TriangleShape shape_of(const Edges& edges, Figures& figures) {
  const std::array<Vec3, 3> corners = {Vec3{}, edges.b, edges.c};
  const auto leaving = [&](unsigned i, unsigned turn) { return corners[(i + turn) % 3] - corners[i]; };
  const auto [smallest, largest] = std::pair(edges.smallest, edges.largest);
  if (edges.across[smallest] == 0) {
    figures.add_largest({1, 0});  // a right angle
    return {};
  }
  figures.add_largest(angle_between(leaving(largest, 1), leaving(largest, 2)));
  TriangleShape shape;
  shape.min_angle = angle_between(leaving(smallest, 1), leaving(smallest, 2));

  // R / l = l1 l2 / (2 |cross|) with the two longer edges l1, l2: R = l l1 l2 / (4 area).
  const double doubled_area = norm(cross(edges.b, edges.c));
  const double longer = edges.across[(smallest + 1) % 3] * edges.across[(smallest + 2) % 3];
  // An area within rounding of zero (for products of numbers near 1) is meaningless.
  shape.is_degenerate = doubled_area <= 4e-16 * longer;
  if (!shape.is_degenerate) shape.radius_edge = std::min(longer / (2 * doubled_area), kDegenerateRadiusEdge);
  return shape;
}

// A few triangles at a time, step by step, with their points prefetched: so the square roots of different triangles
// overlap.
void measure(const TriangleMesh& mesh, std::size_t first, std::size_t last, Figures& figures,
             std::span<double> radius_edges) {
  constexpr std::size_t kTogether = 8;
  std::array<Edges, kTogether> edges;
  std::array<TriangleShape, kTogether> shapes;
  for (; first < last; first += kTogether) {
    const std::size_t count = std::min(kTogether, last - first);
    for (std::size_t t = first + kTogether; t < std::min(first + 2 * kTogether, last); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) __builtin_prefetch(&mesh.points[v]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto [a, b, c] = mesh.triangles[first + i];
      edges[i] = edges_of(mesh.points[a], mesh.points[b], mesh.points[c]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      shapes[i] = shape_of(edges[i], figures);
      radius_edges[first + i] = shapes[i].radius_edge;
    }
    for (std::size_t i = 0; i < count; ++i) figures.add(shapes[i]);
  }
}

}  // namespace

MeshQuality measure_quality(const TriangleMesh& mesh, int threads) {
  if (mesh.triangles.empty()) return {};
  // By blocks, whose results are added in order.
  std::vector<double> radius_edges(mesh.triangles.size());
  std::vector<Figures> blocks((mesh.triangles.size() + kBlockSize - 1) / kBlockSize);
  for_each_block(mesh.triangles.size(), threads, [&](std::size_t first, std::size_t last) {
    measure(mesh, first, last, blocks[first / kBlockSize], radius_edges);
  });
  Figures sum;
  for (const Figures& block : blocks) sum.add(block);

  MeshQuality quality;
  quality.min_angle_degrees = sum.min_angle;
  quality.max_angle_degrees = sum.max_angle.degrees();
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

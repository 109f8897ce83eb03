#include "experiments/pictures/mesh_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace deliso {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Box3> triangle_boxes(const TriangleMesh& mesh) {
  std::vector<Box3> boxes(mesh.triangles.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) boxes[i].extend(mesh.points[vertex]);
  }
  return boxes;
}

// A ray in a sheared frame where it runs along the last axis: triangles are then tested by their projection along it.
class ShearedRay {
 public:
  explicit ShearedRay(const Line& ray) : origin_(ray.origin) {
    const Vec3& d = ray.direction;
    const Vec3 size{std::abs(d.x), std::abs(d.y), std::abs(d.z)};
    z_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    shear_x_ = d[x_] / d[z_];
    shear_y_ = d[y_] / d[z_];
    scale_ = 1 / d[z_];
    for (std::size_t a = 0; a < 3; ++a) inverse_[a] = std::clamp(1 / d[a], -kLargestInverse, kLargestInverse);
  }

  // The parameter where the ray meets the triangle; infinity when it does not. A point on an edge belongs to both
  // triangles there, because the projected edge is computed alike for both.
  [[nodiscard]] double meets(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Vec3 sa = sheared(a), sb = sheared(b), sc = sheared(c);
    const double u = sc.x * sb.y - sc.y * sb.x;
    const double v = sa.x * sc.y - sa.y * sc.x;
    const double w = sb.x * sa.y - sb.y * sa.x;
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return kInfinity;
    const double sum = u + v + w;
    return sum == 0 ? kInfinity : (u * sa.z + v * sb.z + w * sc.z) / sum;
  }

  // A lower bound of the parameters of the box's points; infinity when the ray misses the box by more than `slack`.
  [[nodiscard]] double enters(const Box3& box, double slack) const {
    double first = -kInfinity;
    double last = kInfinity;
    for (std::size_t a = 0; a < 3; ++a) {
      const double at_low = (box.low[a] - slack - origin_[a]) * inverse_[a];
      const double at_high = (box.high[a] + slack - origin_[a]) * inverse_[a];
      first = std::max(first, std::min(at_low, at_high));
      last = std::min(last, std::max(at_low, at_high));
    }
    return first <= last ? first : kInfinity;
  }

 private:
  static constexpr double kLargestInverse = 1e280;

  [[nodiscard]] Vec3 sheared(const Vec3& p) const {
    const Vec3 v = p - origin_;
    return {v[x_] - shear_x_ * v[z_], v[y_] - shear_y_ * v[z_], scale_ * v[z_]};
  }

  Vec3 origin_;
  std::size_t x_ = 0, y_ = 1, z_ = 2;
  double shear_x_ = 0, shear_y_ = 0, scale_ = 1;
  Vec3 inverse_;
};

using Point2 = std::array<double, 2>;

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) {
  const Point2 ab{b[0] - a[0], b[1] - a[1]};
  const Point2 ap{p[0] - a[0], p[1] - a[1]};
  const double squared = ab[0] * ab[0] + ab[1] * ab[1];
  const double s = squared > 0 ? std::clamp((ab[0] * ap[0] + ab[1] * ap[1]) / squared, 0.0, 1.0) : 0;
  return std::hypot(ap[0] - s * ab[0], ap[1] - s * ab[1]);
}

}  // namespace

MeshShape::MeshShape(TriangleMesh mesh) : mesh_(std::move(mesh)), tree_(triangle_boxes(mesh_)) {
  for (const auto& triangle : mesh_.triangles) {
    for (const std::uint32_t vertex : triangle) box_.extend(mesh_.points[vertex]);
  }
}

std::optional<SurfacePoint> MeshShape::first_hit(const Line& ray, double t0, double t1) const {
  const ShearedRay sheared(ray);
  const double slack = 1e-9 * box_.diagonal();
  const auto [triangle, t] = tree_.least(
      t1, [&](const Box3& box) { return sheared.enters(box, slack); },
      [&](std::uint32_t i) {
        const double met = sheared.meets(corner(i, 0), corner(i, 1), corner(i, 2));
        return met < t0 ? kInfinity : met;
      });
  if (triangle == BoxTree::kNone) return std::nullopt;
  const Vec3& a = corner(triangle, 0);
  const Vec3 outward = cross(corner(triangle, 1) - a, corner(triangle, 2) - a);
  const double length = norm(outward);
  if (!(length > 0)) return SurfacePoint{t, -ray.direction, true, triangle};
  const bool outside = dot(outward, ray.direction) < 0;
  return SurfacePoint{t, (outside ? outward : -outward) / length, outside, triangle};
}

double MeshShape::edge_distance(std::uint32_t element, const Camera& camera, double x, double y) const {
  std::array<Point2, 3> seen;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto projected = camera.project(corner(element, i));
    if (!projected) return kInfinity;
    seen[i] = *projected;
  }
  const Point2 p{x, y};
  return std::min({distance_to_segment(p, seen[0], seen[1]), distance_to_segment(p, seen[1], seen[2]),
                   distance_to_segment(p, seen[2], seen[0])});
}

double MeshShape::element_size(std::uint32_t element, const Camera& camera) const {
  const double perimeter = distance(corner(element, 0), corner(element, 1)) +
                           distance(corner(element, 1), corner(element, 2)) +
                           distance(corner(element, 2), corner(element, 0));
  return perimeter / 3 / camera.pixel_size(camera.in_frame(corner(element, 0)));
}

}  // namespace deliso

#include "delaunay/constructions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "delaunay/predicates.h"

namespace deliso {
namespace {

// The largest distance of a computed circumcenter from its tetrahedron.
constexpr double kFarthest = 0x1p500;

double largest_component(const Vec3& a) { return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}); }

}  // namespace

Vec3 circumcenter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  // center - a = (|ab|^2 ac x ad + |ac|^2 ad x ab + |ad|^2 ab x ac) / (2 orient3d).
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ad = d - a;
  const Vec3 numerator =
      squared_norm(ab) * cross(ac, ad) + squared_norm(ac) * cross(ad, ab) + squared_norm(ad) * cross(ab, ac);
  const double denominator = 2 * orient3d(a, b, c, d);
  const double size = largest_component(numerator);
  if (!(size > 0)) return a;
  // Direction times length: a tiny denominator gives a distant point instead of infinity.
  const double length = std::min(size / denominator, kFarthest);
  return a + length * (numerator / size);
}

Circumcircle circumcircle(const Vec3& a, const Vec3& b, const Vec3& c) {
  // From the corner opposite the longest edge: best conditioned, and the same for every order of the corners.
  const double ca = squared_distance(c, a);
  const double bc = squared_distance(b, c);
  const bool is_b = ca > bc;
  const bool is_c = squared_distance(a, b) > std::max(ca, bc);
  const std::size_t opposite = std::max(2 * static_cast<std::size_t>(is_c), static_cast<std::size_t>(is_b));
  const std::array<Vec3, 5> around = {a, b, c, a, b};
  const Vec3& corner = around[opposite];
  const Vec3& left = around[opposite + 1];
  const Vec3& right = around[opposite + 2];
  const Vec3 u = left - corner;
  const Vec3 v = right - corner;
  const Vec3 normal = cross(u, v);
  const Vec3 offset = cross(squared_norm(u) * v - squared_norm(v) * u, normal) / (2 * squared_norm(normal));
  if (!is_finite(offset)) return {0.5 * (left + right), std::numeric_limits<double>::infinity()};
  return {corner + offset, norm(offset)};
}

}  // namespace deliso

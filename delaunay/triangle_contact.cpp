#include "delaunay/triangle_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "delaunay/predicates.h"

namespace deliso {

namespace {

using Corners = std::array<Vec3, 3>;
using Sides = std::array<int, 3>;  // of three points with respect to a plane: -1, 0 or 1

int sign(double x) { return (x > 0) - (x < 0); }

// ---- In a plane: orientations in the projection along one axis ----

// The sign of the area of abc seen along `axis`: positive when counterclockwise. Exact: a static bound (Shewchuk 1997),
// else orient3d of the points at height 0 with one lifted to height 1, which is the same determinant.
int orient2d(std::size_t axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double left = (a[u] - c[u]) * (b[v] - c[v]), right = (a[v] - c[v]) * (b[u] - c[u]);
  const double determinant = left - right;
  constexpr double kRelative = 3.3306690738754716e-16, kUnderflow = 1e-300;
  if (std::abs(determinant) > kRelative * (std::abs(left) + std::abs(right)) + kUnderflow) return sign(determinant);
  return sign(orient3d({a[u], a[v], 0}, {b[u], b[v], 0}, {c[u], c[v], 0}, {a[u], a[v], 1}));
}

// An axis along which abc projects to a triangle with an area. Precondition: not collinear.
std::size_t projection_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
  std::size_t axis = 0;
  while (axis < 2 && orient2d(axis, a, b, c) == 0) ++axis;
  return axis;
}

// Two triangles in one plane. The line along some edge separates them when they do not meet: strictly when they have no
// point in common, weakly when their interiors have none.
TriangleContact coplanar_contact(const Corners& s, const Corners& t) {
  const std::size_t axis = projection_axis(s[0], s[1], s[2]);
  bool is_weakly_separated = false;
  for (const auto& [a, b] : {std::pair{&s, &t}, {&t, &s}}) {
    const int turn = orient2d(axis, (*a)[0], (*a)[1], (*a)[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      int innermost = -1;
      for (const Vec3& p : *b) innermost = std::max(innermost, turn * orient2d(axis, (*a)[i], (*a)[(i + 1) % 3], p));
      if (innermost < 0) return TriangleContact::kNone;
      if (innermost == 0) is_weakly_separated = true;
    }
  }
  return is_weakly_separated ? TriangleContact::kTouching : TriangleContact::kCrossing;
}

// Whether p and q lie in the same direction from s. Precondition: collinear, both different from s. (Order along a line
// is the order of its coordinates.)
bool same_direction(const Vec3& s, const Vec3& p, const Vec3& q) {
  const auto before = [](const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  return before(s, p) == before(s, q);
}

// ---- Across planes ----

Sides sides_of(const Corners& plane, const Corners& points) {
  Sides sides{};
  for (std::size_t i = 0; i < 3; ++i) sides[i] = sign(orient3d(plane[0], plane[1], plane[2], points[i]));
  return sides;
}

bool all_on_one_side(const Sides& sides) { return sides[0] != 0 && sides[0] == sides[1] && sides[0] == sides[2]; }
bool all_zero(const Sides& sides) { return sides[0] == 0 && sides[1] == 0 && sides[2] == 0; }
bool is_proper(const Sides& sides) {
  const auto [low, high] = std::minmax({sides[0], sides[1], sides[2]});
  return low < 0 && high > 0;
}

// An edge that meets the other triangle's plane in one point, directed from its positive to its negative side.
struct Piercing {
  Vec3 from, to;
};

// Where a triangle meets the common line D of the two planes; low and high along D = n(s) x n(t).
struct Interval {
  Piercing low, high;
};

// The corner that is alone on its side of the other plane, and that side. A corner on the plane counts for the side on
// which it leaves one corner alone. Both edges at the lone corner meet the plane.
std::pair<std::size_t, int> lone_corner(const Sides& sides) {
  for (const int side : {1, -1}) {
    if (std::count(sides.begin(), sides.end(), side) != 1) continue;
    return {static_cast<std::size_t>(std::find(sides.begin(), sides.end(), side) - sides.begin()), side};
  }
  // Two on one side, the third on the plane.
  const auto zero = static_cast<std::size_t>(std::find(sides.begin(), sides.end(), 0) - sides.begin());
  return {zero, -sides[(zero + 1) % 3]};
}

// Look with n(s) upward and the positive side of the other plane ahead: D points to the left. So a lone corner ahead
// has its next edge on the left, a lone corner behind its previous one. For t, D points to the right.
Interval interval_on_line(const Corners& corners, const Sides& sides, bool is_first) {
  const auto [lone, side] = lone_corner(sides);
  const Vec3 &p = corners[lone], &next = corners[(lone + 1) % 3], &previous = corners[(lone + 2) % 3];
  Interval interval;
  if (side > 0) {
    interval = {{p, previous}, {p, next}};
  } else {
    interval = {{next, p}, {previous, p}};
  }
  if (!is_first) std::swap(interval.low, interval.high);
  return interval;
}

// Positive when t pierces s's plane farther along D than s pierces t's plane. With y on ab and z on cd, z - y = x D:
// [b-a, c-a, d-a] = x [b-a, D, d-c], and the last factor is positive for edges that go from the positive to the
// negative side.
int order_along_line(const Piercing& of_s, const Piercing& of_t) {
  return sign(orient3d(of_s.from, of_s.to, of_t.from, of_t.to));
}

// Certain only when true: a plane (nearly) through s has all of t beyond it. Any normal near that of s is valid, so it
// may be rounded.
bool clearly_beyond_plane(const Corners& s, const Corners& t) {
  const Vec3 u = s[1] - s[0], v = s[2] - s[0], normal = cross(u, v);
  double size = 0;
  for (const Vec3& d : {u, v, t[0] - s[0], t[1] - s[0], t[2] - s[0]}) {
    size = std::max({size, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  }
  // In terms of size^3 rounding moves the corners of s, which lie in the plane, by less than 2e-15, and those of t by
  // less than 4e-15.
  constexpr double kRelative = 1e-14, kUnderflow = 1e-300;
  const double bound = kRelative * size * size * size + kUnderflow;
  const double a = dot(normal, t[0] - s[0]), b = dot(normal, t[1] - s[0]), c = dot(normal, t[2] - s[0]);
  return std::min({a, b, c}) > bound || std::max({a, b, c}) < -bound;
}

TriangleContact contact_of_disjoint(const Corners& s, const Corners& t) {
  if (clearly_beyond_plane(s, t) || clearly_beyond_plane(t, s)) return TriangleContact::kNone;
  const Sides t_sides = sides_of(s, t);
  if (all_on_one_side(t_sides)) return TriangleContact::kNone;
  if (all_zero(t_sides)) return coplanar_contact(s, t);
  const Sides s_sides = sides_of(t, s);
  if (all_on_one_side(s_sides)) return TriangleContact::kNone;

  const Interval on_s = interval_on_line(s, s_sides, true), on_t = interval_on_line(t, t_sides, false);
  const int low_to_high = order_along_line(on_s.low, on_t.high), high_to_low = order_along_line(on_s.high, on_t.low);
  if (low_to_high < 0 || high_to_low > 0) return TriangleContact::kNone;
  const bool overlap = low_to_high > 0 && high_to_low < 0;
  return overlap && is_proper(s_sides) && is_proper(t_sides) ? TriangleContact::kCrossing : TriangleContact::kTouching;
}

// Certain only when true: a plane through the common corner of s and t (s[i] and t[j]) has the rest of each on its own
// side. Any normal is valid. This one bisects the angle between the bisectors of the two triangles' angles there, which
// succeeds for nearly all pairs of an umbrella.
bool clearly_apart_at_vertex(const Corners& s, std::size_t i, const Corners& t, std::size_t j) {
  constexpr std::array<std::size_t, 3> kNext = {1, 2, 0}, kPrevious = {2, 0, 1};
  const Vec3 s1 = s[kNext[i]] - s[i], s2 = s[kPrevious[i]] - s[i], t1 = t[kNext[j]] - t[j], t2 = t[kPrevious[j]] - t[j];
  const Vec3 in_s = s1 + s2, in_t = t1 + t2;
  const Vec3 normal = norm(in_t) * in_s - norm(in_s) * in_t;
  // Far more than the rounding of a difference and of the sum of three products.
  constexpr double kRelative = 4e-15, kUnderflow = 1e-300;
  const auto side = [&](const Vec3& d) {
    const double x = normal.x * d.x, y = normal.y * d.y, z = normal.z * d.z;
    const double sum = x + y + z;
    return std::abs(sum) > kRelative * (std::abs(x) + std::abs(y) + std::abs(z)) + kUnderflow ? sign(sum) : 0;
  };
  return side(s1) > 0 && side(s2) > 0 && side(t1) < 0 && side(t2) < 0;
}

// s and t share their corner 0. Each meets the common line D in a ray from it, if at all; with a, b the other corners
// of s, n(s) x n(t) = da (b - s) - db (a - s) with their distances da, db from t's plane, which gives the ray's
// direction along D.
TriangleContact contact_at_vertex(const Corners& s, const Corners& t) {
  const auto side = [](const Corners& plane, const Vec3& p) { return sign(orient3d(plane[0], plane[1], plane[2], p)); };
  const int c = side(s, t[1]), d = side(s, t[2]);
  if (c == d && c != 0) return TriangleContact::kNone;
  if (c == 0 && d == 0) {
    const TriangleContact contact = coplanar_contact(s, t);
    if (contact == TriangleContact::kCrossing) return contact;
    // Beyond the vertex they may still overlap along a common edge direction.
    const std::size_t axis = projection_axis(s[0], s[1], s[2]);
    for (const Vec3& p : {s[1], s[2]}) {
      for (const Vec3& q : {t[1], t[2]}) {
        if (orient2d(axis, s[0], p, q) == 0 && same_direction(s[0], p, q)) return TriangleContact::kTouching;
      }
    }
    return TriangleContact::kNone;
  }
  const int a = side(t, s[1]), b = side(t, s[2]);
  if (a == b) return TriangleContact::kNone;
  const int ray_of_s = sign(a - b), ray_of_t = sign(d - c);
  if (ray_of_s != ray_of_t) return TriangleContact::kNone;
  return a * b < 0 && c * d < 0 ? TriangleContact::kCrossing : TriangleContact::kTouching;
}

// s and t share the edge from corner 0 to corner 1 of s: they meet beyond it when they are folded flat on each other.
TriangleContact contact_at_edge(const Corners& s, const Vec3& apex_of_t) {
  if (orient3d(s[0], s[1], s[2], apex_of_t) != 0) return TriangleContact::kNone;
  const std::size_t axis = projection_axis(s[0], s[1], s[2]);
  const bool same_side = orient2d(axis, s[0], s[1], s[2]) == orient2d(axis, s[0], s[1], apex_of_t);
  return same_side ? TriangleContact::kCrossing : TriangleContact::kNone;
}

// The corners in cyclic order, starting at corner `first`.
Corners turned(const Corners& corners, std::size_t first) {
  return {corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]};
}

}  // namespace

bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) { return !collinear(a, b, c); }

TriangleContact triangle_contact(const std::array<std::uint32_t, 3>& s, const std::array<Vec3, 3>& s_points,
                                 const std::array<std::uint32_t, 3>& t, const std::array<Vec3, 3>& t_points) {
  // Bit i or j of a mask: corner i of s, or corner j of t, is shared. No branches, because the outcome is
  // unpredictable.
  unsigned in_s = 0, in_t = 0;
  for (unsigned i = 0; i < 3; ++i) {
    for (unsigned j = 0; j < 3; ++j) {
      const unsigned same = s[i] == t[j] ? 1 : 0;
      in_s |= same << i;
      in_t |= same << j;
    }
  }
  constexpr std::array<std::size_t, 8> kOnlyBit = {0, 0, 1, 0, 2, 0, 0, 0};
  constexpr std::array<int, 8> kBitCounts = {0, 1, 1, 2, 1, 2, 2, 3};
  switch (kBitCounts[in_s]) {
    case 0:
      return contact_of_disjoint(s_points, t_points);
    case 1:
      if (clearly_apart_at_vertex(s_points, kOnlyBit[in_s], t_points, kOnlyBit[in_t])) return TriangleContact::kNone;
      return contact_at_vertex(turned(s_points, kOnlyBit[in_s]), turned(t_points, kOnlyBit[in_t]));
    case 2:
      return contact_at_edge(turned(s_points, (kOnlyBit[7 - in_s] + 1) % 3), t_points[kOnlyBit[7 - in_t]]);
    default:
      return TriangleContact::kCrossing;  // the same triangle twice
  }
}

}  // namespace deliso

#include "surface/repair/signs/segment_clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace deliso {

namespace {

// More than the roundings that add up in a volume.
constexpr double kRoundings = 256;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Parameters are off by less.
constexpr double kParameterError = 1e-12;

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Keeps the part where values that go evenly from `at_a` to `at_b` are positive; none when they are no numbers.
void keep_positive(double at_a, double at_b, SegmentClip& passage) {
  if (at_a > 0 && at_b > 0) return;
  const double zero = at_a / (at_a - at_b);
  if (at_a > 0 && zero <= 1) {
    passage.to = std::min(passage.to, zero - kParameterError);
  } else if (at_b > 0 && zero >= 0) {
    passage.from = std::max(passage.from, zero + kParameterError);
  } else {
    passage.to = passage.from;
  }
}

}  // namespace

SegmentClip clip_segment(const Tetrahedralization& tets, TetId t, const Segment& segment) {
  const auto& v = tets.vertices(t);
  const Vec3& corner = tets.point(v[0]);
  const std::array<Vec3, 3> side = {tets.point(v[1]) - corner, tets.point(v[2]) - corner, tets.point(v[3]) - corner};
  const Vec3 to_a = segment.a - corner, to_b = segment.b - corner;

  // Six times the volumes below are off by less than this: differences of coordinates by the coordinates' roundings,
  // products by their own.
  const double length =
      2 * std::max({largest(side[0]), largest(side[1]), largest(side[2]), largest(to_a), largest(to_b)});
  const double off = kRoundings * kEpsilon * length * length * (length + largest(corner));

  // A point is within where the volumes that it makes up with the four sides, which come to the whole, are positive.
  SegmentClip passage{t, -1, 2};
  std::array<Vec3, 3> normal = {cross(side[1], side[2]), cross(side[2], side[0]), cross(side[0], side[1])};
  const double whole = dot(side[0], normal[0]);
  if (whole < 0) {
    for (Vec3& n : normal) n = -1.0 * n;
  }
  double left_at_a = std::abs(whole), left_at_b = left_at_a;
  for (const Vec3& n : normal) {
    const double at_a = dot(n, to_a), at_b = dot(n, to_b);
    keep_positive(at_a - off, at_b - off, passage);
    left_at_a -= at_a;
    left_at_b -= at_b;
  }
  keep_positive(left_at_a - off, left_at_b - off, passage);
  return passage;
}

}  // namespace deliso

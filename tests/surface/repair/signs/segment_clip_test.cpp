#include "surface/repair/signs/segment_clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "delaunay/base/rng.h"
#include "delaunay/bowyer_watson.h"
#include "delaunay/predicates.h"

namespace deliso {
namespace {

Vec3 random_point(Rng& rng) { return {rng.uniform(), rng.uniform(), rng.uniform()}; }

bool is_strictly_within(const Tetrahedralization& tets, TetId t, const Vec3& p) {
  for (unsigned face = 0; face < 4; ++face) {
    const auto [a, b, c] = tets.facet_vertices(FacetId(t, face));
    if (orient3d(tets.point(a), tets.point(b), tets.point(c), p) >= 0) return false;
  }
  return true;
}

// The points that halving reaches, as it rounds them.
template <class Visit>
void for_each_half(const Vec3& a, double s_a, const Vec3& b, double s_b, int levels, Visit&& visit) {
  if (levels == 0) return;
  const Vec3 middle = 0.5 * (a + b);
  const double s = 0.5 * (s_a + s_b);
  visit(s, middle);
  for_each_half(a, s_a, middle, s, levels - 1, visit);
  for_each_half(middle, s, b, s_b, levels - 1, visit);
}

// Exact orientations say of each point whether it lies within; the passage never says so wrongly, and hardly ever
// misses it. Away from the origin roundings are coarser, and flat tetrahedra are nothing but roundings.
TEST(SegmentClip, HoldsOnlyWhatLiesStrictlyWithin) {
  Rng rng(7);
  std::int64_t held = 0, missed = 0;
  for (const double away : {0.0, 1000.0, 1e6}) {
    for (const double flatness : {1.0, 1e-3, 1e-9}) {
      for (int round = 0; round < 200; ++round) {
        const Vec3 shift{away, -away, away / 3};
        std::vector<Vec3> points;
        for (int i = 0; i < 4; ++i) {
          Vec3 p = random_point(rng);
          p.z *= flatness;
          points.push_back(p + shift);
        }
        BowyerWatson delaunay({shift - Vec3{9, 9, 9}, shift + Vec3{9, 9, 9}});
        if (!delaunay.build(points)) continue;
        TetId t(std::size_t{0});
        while (delaunay.is_ghost(t)) t = TetId(t.index() + 1);
        // Through a point of it, so that most segments pass.
        const Vec3 inside = 0.25 * (points[0] + points[1] + points[2] + points[3]);
        const Vec3 a = shift + 2.0 * random_point(rng) - Vec3{0.5, 0.5, 0.5};
        const Segment segment{a, inside + rng.uniform() * (inside - a)};
        const SegmentClip passage = clip_segment(delaunay, t, segment);
        for_each_half(segment.a, 0, segment.b, 1, 7, [&](double s, const Vec3& p) {
          const bool within = is_strictly_within(delaunay, t, p);
          if (passage.surely_holds(s)) {
            EXPECT_TRUE(within) << away << " " << flatness << " " << s;
            ++held;
          } else if (within && flatness == 1.0) {
            ++missed;
          }
        });
      }
    }
  }
  EXPECT_GT(held, 10000);
  EXPECT_LT(missed, 10);
}

// Segments in the plane of a side, and along an edge: nothing lies strictly within.
TEST(SegmentClip, IsEmptyOnTheSides) {
  const std::array<Vec3, 4> points = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  BowyerWatson delaunay({{-9, -9, -9}, {9, 9, 9}});
  ASSERT_TRUE(delaunay.build(points));
  TetId t(std::size_t{0});
  while (delaunay.is_ghost(t)) t = TetId(t.index() + 1);
  for (const Segment& segment : {Segment{{0.1, 0.1, 0}, {0.3, 0.4, 0}}, Segment{{0, 0, 0}, {1, 0, 0}},
                                 Segment{{0.5, 0.5, 0}, {0, 0, 1}}, Segment{{2, 2, 2}, {3, 3, 3}}}) {
    const SegmentClip passage = clip_segment(delaunay, t, segment);
    for (const double s : {0.0, 0.25, 0.5, 1.0}) EXPECT_FALSE(passage.surely_holds(s)) << segment.b.x << " " << s;
  }
  const SegmentClip through = clip_segment(delaunay, t, {{-0.2, 0.1, 0.1}, {0.8, 0.1, 0.1}});
  EXPECT_NEAR(through.from, 0.2, 1e-9);
  EXPECT_NEAR(through.to, 1, 1e-9);
}

}  // namespace
}  // namespace deliso

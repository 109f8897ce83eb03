#include "delaunay/predicates.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "delaunay/base/rng.h"
#include "delaunay/static_filter.h"
#include "tests/support/delaunay_oracle.h"

namespace deliso {
namespace {

using Tuple = std::array<Vec3, 5>;

int sign(double x) { return (x > 0) - (x < 0); }

double orient(const Tuple& p) { return orient3d(p[0], p[1], p[2], p[3]); }

// Five points of some kind, and the shift that makes their coordinates integers.
struct Kind {
  const char* name;
  int shift;
  std::function<Tuple(Rng&)> draw;
};

Vec3 random_integers(Rng& rng, std::uint64_t range) {
  return {double(rng.below(range)), double(rng.below(range)), double(rng.below(range))};
}

template <class Draw>
Tuple five(Draw draw) {
  return {draw(), draw(), draw(), draw(), draw()};
}

// Moves a coordinate by a few units in the last place.
Vec3 nudged(Vec3 p, Rng& rng) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (auto steps = rng.below(3); steps > 0; --steps) {
      p[axis] = std::nextafter(p[axis], rng.below(2) == 0 ? -1e9 : 1e9);
    }
  }
  return p;
}

Vec3 on_sphere(Rng& rng) {
  for (;;) {
    const Vec3 p{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    if (norm(p) < 1 && norm(p) > 0.1) return p / norm(p);
  }
}

// A corner of a random lattice-aligned box: any five are cospherical, many coplanar.
Tuple corners(Rng& rng) {
  const Vec3 low = random_integers(rng, 1u << 20);
  const Vec3 high = low + random_integers(rng, 1u << 20) + Vec3{1, 1, 1};
  return five([&] {
    return Vec3{rng.below(2) == 0 ? low.x : high.x, rng.below(2) == 0 ? low.y : high.y,
                rng.below(2) == 0 ? low.z : high.z};
  });
}

Tuple coplanar(Rng& rng) {
  const Vec3 a = random_integers(rng, 1000);
  const Vec3 u = random_integers(rng, 1000);
  const Vec3 v = random_integers(rng, 1000);
  return five([&] { return a + double(rng.below(100)) * u - double(rng.below(100)) * v; });
}

std::vector<Kind> kinds() {
  return {
      {"uniform", 110,
       [](Rng& rng) { return five([&] {
                        return Vec3{rng.uniform(), rng.uniform(), rng.uniform()};
                      }); }},
      {"small integers", 0, [](Rng& rng) { return five([&] { return random_integers(rng, 5); }); }},
      {"large integers", 0, [](Rng& rng) { return five([&] { return random_integers(rng, 1ull << 50); }); }},
      {"box corners", 0, corners},
      {"box corners nudged", 60,
       [](Rng& rng) {
         Tuple p = corners(rng);
         for (Vec3& q : p) q = nudged(q + Vec3{1, 1, 1}, rng);
         return p;
       }},
      {"coplanar", 0, coplanar},
      {"coplanar nudged", 110,
       [](Rng& rng) {
         Tuple p = coplanar(rng);
         for (Vec3& q : p) q = nudged(q + Vec3{0.125, 0.125, 0.125}, rng);
         return p;
       }},
      {"rounded sphere", 110, [](Rng& rng) { return five([&] { return on_sphere(rng); }); }},
      {"small patch of a sphere", 110,
       [](Rng& rng) {
         const Vec3 center = on_sphere(rng);
         return five([&] {
           const Vec3 p = center + 1e-4 * on_sphere(rng);
           return 30 * (p / norm(p));
         });
       }},
      {"mixed scales", 260,
       [](Rng& rng) { return five([&] { return std::ldexp(1.0, int(rng.below(160)) - 80) * on_sphere(rng); }); }},
  };
}

class Predicates : public testing::TestWithParam<std::size_t> {};

TEST_P(Predicates, Orient3dHasTheExactSignAndASmallRelativeError) {
  const Kind kind = kinds()[GetParam()];
  Rng rng(11 + GetParam());
  for (int i = 0; i < 10000; ++i) {
    const Tuple p = kind.draw(rng);
    const auto exact = test::exact_orient3d({p[0], p[1], p[2], p[3]}, kind.shift);
    ASSERT_EQ(sign(orient(p)), exact.sign()) << kind.name << ", case " << i;
    if (exact.sign() == 0) continue;
    const double relative = std::ldexp(orient(p), 3 * kind.shift) / exact.to_double() - 1;
    ASSERT_LT(std::abs(relative), 0x1p-20) << kind.name << ", case " << i;
  }
}

TEST_P(Predicates, InsphereHasTheExactSign) {
  const Kind kind = kinds()[GetParam()];
  Rng rng(21 + GetParam());
  for (int i = 0; i < 4000; ++i) {
    const Tuple p = kind.draw(rng);
    const int exact = test::exact_insphere(p, kind.shift);
    ASSERT_EQ(sign(insphere(p[0], p[1], p[2], p[3], p[4])), exact) << kind.name << ", case " << i;
    ASSERT_EQ(sign(StaticFilter::insphere_sign(p[0], p[1], p[2], p[3], p[4])), exact) << kind.name << ", case " << i;
  }
}

TEST_P(Predicates, StaticFilterDoesNotChangeTheSignOfOrient3d) {
  const Kind kind = kinds()[GetParam()];
  Rng rng(31 + GetParam());
  for (int i = 0; i < 20000; ++i) {
    const Tuple p = kind.draw(rng);
    Box3 box;  // the tightest box is the hardest
    for (const Vec3& q : p) box.extend(q);
    ASSERT_EQ(sign(StaticFilter(box).orient(p[0], p[1], p[2], p[3])), sign(orient(p))) << kind.name << ", case " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(AllKinds, Predicates, testing::Range<std::size_t>(0, kinds().size()));

TEST(Orient3d, IsZeroWhereTwoPointsAreOne) {
  const std::array<Vec3, 3> points = {Vec3{0.1, 0.7, 1e-9}, Vec3{-3.3, 0.2, 5e7}, Vec3{0.3, 1.1, -2.9}};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      std::array<Vec3, 4> p;
      std::size_t next = 0;
      for (std::size_t k = 0; k < 4; ++k) p[k] = k == j ? p[i] : points[next++];
      EXPECT_EQ(orient3d(p[0], p[1], p[2], p[3]), 0) << i << " and " << j;
    }
  }
}

TEST(Orient3d, IsPositiveOnTheSideOfTheNormal) {
  EXPECT_GT(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 0);
  EXPECT_LT(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}), 0);
}

TEST(Insphere, IsPositiveInside) {
  EXPECT_GT(insphere({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0.5}), 0);
  EXPECT_EQ(insphere({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}), 0);
  EXPECT_LT(insphere({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}), 0);
}

// At both ends of the range that the header allows.
TEST(Predicates, AreExactForTinyAndForHugeCoordinates) {
  Rng rng(41);
  for (int i = 0; i < 3000; ++i) {
    Tuple p = corners(rng);
    for (Vec3& point : p) point = nudged(point + Vec3{1, 1, 1}, rng);
    const int orientation = test::exact_orient3d({p[0], p[1], p[2], p[3]}, 60).sign();
    const int inside = test::exact_insphere(p, 60);
    for (const double scale : {0x1p-160, 0x1p178}) {
      Tuple q = p;
      for (Vec3& point : q) point = scale * point;
      ASSERT_EQ(sign(orient(q)), orientation) << "case " << i;
      ASSERT_EQ(sign(insphere(q[0], q[1], q[2], q[3], q[4])), inside) << "case " << i;
      ASSERT_EQ(sign(StaticFilter::insphere_sign(q[0], q[1], q[2], q[3], q[4])), inside) << "case " << i;
    }
  }
}

TEST(PerturbedInsphere, EqualsTheExactDeterminantWithRaisedLifts) {
  Rng rng(51);
  int ties = 0;
  for (int i = 0; i < 20000 && ties < 1500; ++i) {
    const Tuple p = five([&] { return random_integers(rng, 4); });
    if (orient(p) <= 0 || insphere(p[0], p[1], p[2], p[3], p[4]) != 0) continue;
    bool distinct = true;
    for (unsigned k = 0; k < 4; ++k) distinct = distinct && p[k] != p[4];
    if (!distinct) continue;
    ++ties;
    std::array<unsigned, 5> ranks = {0, 1, 2, 3, 4};
    for (std::size_t k = 5; k > 1; --k) std::swap(ranks[k - 1], ranks[rng.below(k)]);
    std::array<VertexId, 4> ids;
    for (unsigned k = 0; k < 4; ++k) ids[k] = VertexId(std::size_t{10} * ranks[k]);
    const bool inside = perturbed_insphere({p[0], p[1], p[2], p[3]}, ids, p[4], VertexId(std::size_t{10} * ranks[4]));
    const int exact = test::exact_perturbed_insphere(p, ranks, 0);
    ASSERT_NE(exact, 0);
    ASSERT_EQ(inside, exact > 0) << "case " << i;
  }
  EXPECT_GE(ties, 500);
}

// Points next to the line y = 3 x, closer to it than the rounding of a determinant. (After Kettner et al.: Classroom
// examples of robustness problems in geometric computations, 2008.)
TEST(NormalSign, IsExactNextToALine) {
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const double x = 0.5 + i * 0x1p-53, y = 1.5 + j * 0x1p-52;
      const int expected = 2 * j > 3 * i ? 1 : 2 * j < 3 * i ? -1 : 0;
      for (unsigned axis = 0; axis < 3; ++axis) {
        const auto at = [&](double u, double v) {
          Vec3 p;
          p[(axis + 1) % 3] = u;
          p[(axis + 2) % 3] = v;
          return p;
        };
        const Vec3 a = at(-12, -36), b = at(24, 72), c = at(x, y);
        ASSERT_EQ(normal_sign(a, b, c, axis), expected) << i << " " << j;
        ASSERT_EQ(normal_sign(b, c, a, axis), expected) << i << " " << j;
        ASSERT_EQ(normal_sign(c, a, b, axis), expected) << i << " " << j;
        ASSERT_EQ(normal_sign(c, b, a, axis), -expected) << i << " " << j;
        ASSERT_EQ(collinear(a, c, b), expected == 0) << i << " " << j;
        ASSERT_EQ(collinear(c, a, b), expected == 0) << i << " " << j;
      }
    }
  }
}

TEST(Collinear, AgreesWithExactCrossProducts) {
  Rng rng(61);
  int lines = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = random_integers(rng, 8);
    const Vec3 u = random_integers(rng, 3);
    const Vec3 v = i % 2 == 0 ? random_integers(rng, 3) : double(rng.below(5)) * u;
    const bool expected = cross(u, v) == Vec3{};
    lines += expected;
    ASSERT_EQ(collinear(a, a + u, a + v), expected) << "case " << i;
  }
  EXPECT_GT(lines, 1000);
  EXPECT_FALSE(collinear({0, 0, 0}, {1, 1, 1}, {2, 2, std::nextafter(2.0, 3.0)}));
}

}  // namespace
}  // namespace deliso

// The two kinds of numbers behind every topological decision.
#include "volume/topology/exact_signs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "delaunay/base/check.h"
#include "delaunay/base/rng.h"

namespace deliso {
namespace {

__extension__ using Wide = __int128;

int sign_of(Wide value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

std::int64_t random_integer(Rng& rng, int bits) {
  return static_cast<std::int64_t>(rng.next() >> (64 - bits)) - (std::int64_t{1} << (bits - 1));
}

// Any finite double, all exponents alike.
double random_double(Rng& rng, int lowest_exponent, int highest_exponent) {
  const auto exponents = static_cast<std::uint64_t>(highest_exponent - lowest_exponent + 1);
  const int exponent = lowest_exponent + static_cast<int>(rng.below(exponents));
  return std::ldexp(rng.uniform(-1, 1), exponent);
}

TEST(DyadicNumber, AgreesWith128BitIntegers) {
  Rng rng(1);
  for (int i = 0; i < 20000; ++i) {
    // Few bits make exact cancellation common.
    const int bits = 2 + static_cast<int>(rng.below(30));
    const std::int64_t a = random_integer(rng, bits);
    const std::int64_t b = random_integer(rng, bits);
    const std::int64_t c = random_integer(rng, bits);
    const std::int64_t d = random_integer(rng, bits);
    const auto number = [](std::int64_t x) { return DyadicNumber(static_cast<double>(x)); };
    ASSERT_EQ((number(a) * number(b) - number(c) * number(d)).sign(), sign_of(Wide(a) * b - Wide(c) * d)) << i;
    ASSERT_EQ((number(a) * number(b) * number(c) + -number(d)).sign(), sign_of(Wide(a) * b * c - d)) << i;
    ASSERT_EQ((DyadicNumber::difference(static_cast<double>(a), static_cast<double>(b)) + number(c)).sign(),
              sign_of(Wide(a) - b + c))
        << i;
  }
}

TEST(DyadicNumber, KeepsEveryBitOfAnyDouble) {
  Rng rng(2);
  for (int i = 0; i < 3000; ++i) {
    const double x = random_double(rng, -1074, 1023);
    const double y = random_double(rng, -1074, 1023);
    const DyadicNumber a(x);
    const DyadicNumber b(y);
    // (a + b)(a - b) = a^2 - b^2, where rounding, overflow or underflow would show.
    ASSERT_EQ(((a + b) * (a - b) - (a * a - b * b)).sign(), 0) << x << " " << y;
    ASSERT_EQ((a + b - a).sign(), b.sign()) << x << " " << y;
    ASSERT_EQ((a - b).sign(), x > y ? 1 : x < y ? -1 : 0) << x << " " << y;
  }
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  EXPECT_EQ((DyadicNumber(huge) * DyadicNumber(huge) + DyadicNumber(tiny) * DyadicNumber(tiny) -
             DyadicNumber(huge) * DyadicNumber(huge))
                .sign(),
            1);
}

TEST(DyadicNumber, RefusesInfinity) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(DyadicNumber{infinity}, InternalError);
}

TEST(BoundedNumber, ACertainSignIsTheExactSign) {
  Rng rng(3);
  int certain = 0;
  int uncertain = 0;
  for (int i = 0; i < 20000; ++i) {
    // Nearly proportional rows: the determinant is a few rounding errors wide.
    const double a = random_double(rng, -3, 3);
    const double b = random_double(rng, -3, 3);
    const double factor = random_double(rng, -3, 3);
    const double noise = std::ldexp(rng.uniform(-1, 1), -50 - static_cast<int>(rng.below(6)));
    const double c = a * factor;
    const double d = b * factor * (1 + noise);
    const double isovalue = rng.uniform(-1e-17, 1e-17);
    const auto determinant = [&](const auto& kind) {
      using Number = std::decay_t<decltype(kind)>;
      const auto f = [&](double x) { return Number::difference(x, isovalue); };
      const Number det = f(a) * f(d) - f(b) * f(c);
      return det * det * det + Number(1e-9) * det;  // same sign, longer computation
    };
    const auto sign = determinant(BoundedNumber(0)).sign();
    const int exact = determinant(DyadicNumber(0)).sign();
    ++(sign ? certain : uncertain);
    ASSERT_EQ(sign.value_or(exact), exact) << "case " << i;
    ASSERT_EQ(exact_sign(determinant), exact);
  }
  EXPECT_GT(certain, 1000);
  EXPECT_GT(uncertain, 1000);
}

TEST(BoundedNumber, DoesNotDecideAfterOverflowOrUnderflow) {
  const BoundedNumber huge(1e300);
  EXPECT_FALSE((huge * huge).sign().has_value());
  EXPECT_FALSE((huge * huge - huge * huge).sign().has_value());
  const BoundedNumber tiny(1e-200);
  EXPECT_FALSE((tiny * tiny).sign().has_value());
  EXPECT_FALSE(BoundedNumber(0).sign().has_value());
  EXPECT_EQ(BoundedNumber::difference(1, 1 + 0x1p-52).sign(), -1);
}

}  // namespace
}  // namespace deliso

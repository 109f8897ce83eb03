#include "delaunay/expansion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "delaunay/base/rng.h"
#include "tests/support/delaunay_big_integer.h"

namespace deliso {
namespace {

using test::BigInteger;

// A double with a random number of significant bits and a random exponent in [-40, 40].
double random_double(Rng& rng) {
  const auto bits = static_cast<int>(1 + rng.below(53));
  const double mantissa = std::floor(rng.uniform(-1, 1) * std::ldexp(1.0, bits));
  return std::ldexp(mantissa, static_cast<int>(rng.below(81)) - 40 - bits);
}

constexpr int kShift = 400;  // makes every number of these tests an integer

template <std::size_t N>
BigInteger value_of(const Expansion<N>& e) {
  BigInteger sum;
  for (std::size_t i = 0; i < e.size(); ++i) sum = sum + BigInteger::from_double(e[i], kShift);
  return sum;
}

// The value of the lowest bit that is set in x.
double lowest_bit(double x) {
  int exponent = 0;
  const auto bits = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  return std::ldexp(static_cast<double>(bits & -bits), exponent - 53);
}

template <std::size_t N>
void expect_wellformed(const Expansion<N>& e) {
  for (std::size_t i = 0; i < e.size(); ++i) {
    EXPECT_NE(e[i], 0);
    // Terms do not overlap: each is below the lowest bit of the next.
    if (i == 0) continue;
    EXPECT_LT(std::abs(e[i - 1]), lowest_bit(e[i]));
  }
}

// The products below are exact in 128 bits. Were a * b - head contracted to a fused multiply-add somewhere in the
// computation of the tail, or the tail rounded, the sum would be off.
TEST(TwoProduct, TailIsExact) {
  Rng rng(1);
  for (int i = 0; i < 100000; ++i) {
    const auto a = static_cast<std::int64_t>(rng.next() >> 11);
    const auto b = static_cast<std::int64_t>(rng.next() >> 11);
    const TwoTerms product = two_product(static_cast<double>(a), static_cast<double>(b));
    __extension__ using Int128 = __int128;
    ASSERT_EQ(static_cast<Int128>(product.head) + static_cast<Int128>(product.tail), static_cast<Int128>(a) * b)
        << a << " * " << b;
  }
}

TEST(TwoProduct, HeadIsTheRoundedProductAndCompilerDoesNotContract) {
  // a * b + c with a fused multiply-add differs from the rounded product plus c.
  const volatile double a = 1 + 0x1p-30;
  const volatile double b = 1 - 0x1p-30;
  const volatile double c = -1;
  const double x = a;
  const double y = b;
  const double z = c;
  EXPECT_EQ(x * y + z, 0);
  EXPECT_EQ(two_product(x, y).head, 1);
  EXPECT_EQ(two_product(x, y).tail, -0x1p-60);
}

TEST(TwoSum, SumAndDifferenceAreExact) {
  Rng rng(2);
  for (int i = 0; i < 20000; ++i) {
    const double a = random_double(rng);
    const double b = random_double(rng);
    const TwoTerms sum = two_sum(a, b);
    EXPECT_EQ(sum.head, a + b);
    const BigInteger exact = BigInteger::from_double(a, kShift) + BigInteger::from_double(b, kShift);
    const BigInteger got = BigInteger::from_double(sum.head, kShift) + BigInteger::from_double(sum.tail, kShift);
    ASSERT_EQ((exact - got).sign(), 0) << "case " << i;
  }
}

TEST(Expansion, SumsAndProductsAreExact) {
  Rng rng(3);
  for (int i = 0; i < 5000; ++i) {
    const auto pair = [&] { return Expansion<2>(two_sum(random_double(rng), random_double(rng))); };
    const Expansion<2> a = pair();
    const Expansion<2> b = pair();
    const Expansion<2> c = pair();
    const auto sum = a * b - c * a;
    const auto product = sum * (b + c);
    expect_wellformed(sum);
    expect_wellformed(product);
    const BigInteger exact_a = value_of(a);
    const BigInteger exact_b = value_of(b);
    const BigInteger exact_c = value_of(c);
    const BigInteger scale = BigInteger::from_double(1, kShift);
    const BigInteger exact_sum = exact_a * exact_b - exact_c * exact_a;
    ASSERT_EQ((value_of(sum) * scale - exact_sum).sign(), 0) << "case " << i;
    ASSERT_EQ((value_of(product) * scale * scale - exact_sum * (exact_b + exact_c)).sign(), 0) << "case " << i;
    ASSERT_EQ((a - a).size(), 0U);
    if (exact_sum.sign() != 0) {
      const double relative = sum.estimate() / (exact_sum.to_double() * std::ldexp(1.0, -2 * kShift)) - 1;
      ASSERT_LT(std::abs(relative), 1e-15) << "case " << i;
    }
  }
}

TEST(DoubleDouble, OperationsHaveTheStatedRelativeError) {
  Rng rng(4);
  const auto value = [](const DoubleDouble& a) {
    return BigInteger::from_double(a.high, kShift) + BigInteger::from_double(a.low, kShift);
  };
  for (int i = 0; i < 20000; ++i) {
    const double first = random_double(rng);
    const DoubleDouble a(two_sum(first, random_double(rng)));
    // Every other time, nearly cancel.
    const DoubleDouble b(two_sum(i % 2 == 0 ? -first : random_double(rng), random_double(rng)));
    const auto relative_error = [](const BigInteger& got, const BigInteger& exact) {
      return exact.sign() == 0 ? (got.sign() == 0 ? 0 : 1) : std::abs((got - exact).to_double() / exact.to_double());
    };
    constexpr double kBound = 8 * 0x1p-106;
    const BigInteger scale = BigInteger::from_double(1, kShift);
    ASSERT_LE(relative_error(value(a + b), value(a) + value(b)), kBound) << "case " << i;
    ASSERT_LE(relative_error(value(a - b), value(a) - value(b)), kBound) << "case " << i;
    ASSERT_LE(relative_error(value(a * b) * scale, value(a) * value(b)), kBound) << "case " << i;
  }
}

}  // namespace
}  // namespace deliso

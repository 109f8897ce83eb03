// Exact arithmetic on doubles: error-free transformations, double-doubles and expansions.
//
// An expansion is an unevaluated sum of doubles that do not overlap, smallest first, without zeros; sums and products
// of expansions are exact. (Dekker: A floating-point technique for extending the available precision, 1971; Shewchuk:
// Adaptive precision floating-point arithmetic and fast robust geometric predicates, 1997.) A double-double is a
// rounded pair with 106 bits (Joldes, Muller, Popescu: Tight and rigorous error bounds for basic building blocks of
// double-word arithmetic, 2017).
//
// Everything here needs every operation rounded on its own (-ffp-contract=off), round to nearest, and neither overflow
// nor underflow.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace deliso {

// An exact sum head + tail, with head the rounded value of the sum.
struct TwoTerms {
  double head = 0;
  double tail = 0;
};

// a + b exactly (Knuth).
inline TwoTerms two_sum(double a, double b) {
  const double sum = a + b;
  const double b_virtual = sum - a;
  const double a_virtual = sum - b_virtual;
  return {sum, (a - a_virtual) + (b - b_virtual)};
}

// a + b exactly, when |a| >= |b| or a is zero (Dekker).
inline TwoTerms fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// a - b exactly.
inline TwoTerms two_difference(double a, double b) { return two_sum(a, -b); }

// a * b exactly (Veltkamp's splitting, Dekker's product; one fused instruction where the target has it).
inline TwoTerms two_product(double a, double b) {
  const double product = a * b;
#ifdef __FMA__
  return {product, std::fma(a, b, -product)};
#else
  constexpr double kSplitter = 0x1p27 + 1;
  const double a_scaled = kSplitter * a;
  const double b_scaled = kSplitter * b;
  const double a_high = a_scaled - (a_scaled - a);
  const double b_high = b_scaled - (b_scaled - b);
  const double a_low = a - a_high;
  const double b_low = b - b_high;
  return {product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)};
#endif
}

// A number of 106 bits. Every operation has a relative error of at most 8 u^2, u = 2^-53.
struct DoubleDouble {
  double high = 0;
  double low = 0;

  DoubleDouble() = default;
  explicit DoubleDouble(TwoTerms exact) : high(exact.head), low(exact.tail) {}

  friend DoubleDouble operator-(const DoubleDouble& a) { return DoubleDouble({-a.high, -a.low}); }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const TwoTerms highs = two_sum(a.high, b.high);
    const TwoTerms lows = two_sum(a.low, b.low);
    const TwoTerms sum = fast_two_sum(highs.head, highs.tail + lows.head);
    return DoubleDouble(fast_two_sum(sum.head, lows.tail + sum.tail));
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const TwoTerms highs = two_product(a.high, b.high);
    return DoubleDouble(fast_two_sum(highs.head, highs.tail + (a.high * b.low + a.low * b.high)));
  }
};

// No expansion of doubles has more terms than there are bit positions in the range of a double.
inline constexpr std::size_t kMostTerms = 2100;

// An exact number with room for Capacity terms; lives on the stack. Zero has no terms.
template <std::size_t Capacity>
class Expansion {
 public:
  Expansion() {}  // NOLINT: the terms stay uninitialized on purpose, only size_ of them are ever read
  explicit Expansion(TwoTerms exact) {
    append(exact.tail);
    append(exact.head);
  }
  Expansion(const Expansion& other) : size_(other.size_) { std::copy_n(other.terms_.begin(), size_, terms_.begin()); }
  Expansion& operator=(const Expansion& other) {
    size_ = other.size_;
    std::copy_n(other.terms_.begin(), size_, terms_.begin());
    return *this;
  }
  ~Expansion() = default;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double operator[](std::size_t i) const { return terms_[i]; }
  // Adds a term larger than all terms so far and not overlapping them; drops zeros.
  void append(double term) {
    if (term != 0) terms_[size_++] = term;
  }
  void clear() { size_ = 0; }
  // The value rounded to a double: exact sign, relative error of a few units in the last place.
  [[nodiscard]] double estimate() const {
    double sum = 0;
    for (std::size_t i = 0; i < size_; ++i) sum += terms_[i];
    return sum;
  }

 private:
  std::size_t size_ = 0;
  std::array<double, Capacity> terms_;
};

// sum = a + b (Shewchuk's fast expansion sum with zero elimination): merges by magnitude, carries the rounded sum up.
template <std::size_t A, std::size_t B, std::size_t C>
void add_expansions(const Expansion<A>& a, const Expansion<B>& b, double b_sign, Expansion<C>& sum) {
  sum.clear();
  std::size_t i = 0;
  std::size_t j = 0;
  double carry = 0;
  while (i < a.size() || j < b.size()) {
    const bool take_a = j == b.size() || (i < a.size() && std::abs(a[i]) < std::abs(b[j]));
    const TwoTerms step = two_sum(carry, take_a ? a[i++] : b_sign * b[j++]);
    carry = step.head;
    sum.append(step.tail);
  }
  sum.append(carry);
}

// product = a * b for one double b (Shewchuk's scale-expansion with zero elimination).
template <std::size_t A, std::size_t C>
void scale_expansion(const Expansion<A>& a, double b, Expansion<C>& product) {
  product.clear();
  double carry = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const TwoTerms term = two_product(a[i], b);
    const TwoTerms low = two_sum(carry, term.tail);
    const TwoTerms high = fast_two_sum(term.head, low.head);
    product.append(low.tail);
    product.append(high.tail);
    carry = high.head;
  }
  product.append(carry);
}

template <std::size_t A, std::size_t B>
auto operator+(const Expansion<A>& a, const Expansion<B>& b) {
  Expansion<std::min(A + B, kMostTerms)> sum;
  add_expansions(a, b, 1, sum);
  return sum;
}

template <std::size_t A, std::size_t B>
auto operator-(const Expansion<A>& a, const Expansion<B>& b) {
  Expansion<std::min(A + B, kMostTerms)> difference;
  add_expansions(a, b, -1, difference);
  return difference;
}

// product = longer * shorter: distributes over the terms of the shorter factor.
template <std::size_t A, std::size_t B, std::size_t C>
void multiply_expansions(const Expansion<A>& longer, const Expansion<B>& shorter, Expansion<C>& product) {
  Expansion<std::min(2 * A, kMostTerms)> scaled;
  Expansion<C> sum;
  product.clear();
  for (std::size_t j = 0; j < shorter.size(); ++j) {
    scale_expansion(longer, shorter[j], scaled);
    add_expansions(product, scaled, 1, sum);
    product = sum;
  }
}

template <std::size_t A, std::size_t B>
auto operator*(const Expansion<A>& a, const Expansion<B>& b) {
  Expansion<std::min(2 * A * B, kMostTerms)> product;
  if (a.size() < b.size()) {
    multiply_expansions(b, a, product);
  } else {
    multiply_expansions(a, b, product);
  }
  return product;
}

}  // namespace deliso

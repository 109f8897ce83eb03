// Exact signs of polynomials. A formula is first evaluated with a running error bound; when the bound cannot tell the
// sign, it is evaluated in exact arithmetic.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace deliso {

// A rounded value with a bound on its distance from the true one (running error analysis; Higham, Accuracy and
// Stability of Numerical Algorithms, section 3.3). Overflow makes the bound infinite or NaN: the sign is then unknown.
class BoundedNumber {
 public:
  explicit BoundedNumber(double exact) : value_(exact) {}
  // a - b for exact a and b.
  static BoundedNumber difference(double a, double b) {
    const double value = a - b;
    return {value, kRounding * std::abs(value)};
  }
  // -1 or +1 when certain.
  [[nodiscard]] std::optional<int> sign() const {
    if (value_ > error_) return 1;
    if (value_ < -error_) return -1;
    return std::nullopt;
  }
  friend BoundedNumber operator+(const BoundedNumber& a, const BoundedNumber& b) {
    const double value = a.value_ + b.value_;
    return {value, kSlack * (a.error_ + b.error_ + kRounding * std::abs(value))};
  }
  friend BoundedNumber operator-(const BoundedNumber& a) { return {-a.value_, a.error_}; }
  friend BoundedNumber operator-(const BoundedNumber& a, const BoundedNumber& b) { return a + -b; }
  friend BoundedNumber operator*(const BoundedNumber& a, const BoundedNumber& b) {
    const double value = a.value_ * b.value_;
    const double inherited = std::abs(a.value_) * b.error_ + std::abs(b.value_) * a.error_ + a.error_ * b.error_;
    return {value, kSlack * (inherited + kRounding * std::abs(value)) + kUnderflow};
  }

 private:
  BoundedNumber(double value, double error) : value_(value), error_(error) {}

  static constexpr double kRounding = 0x1p-53;
  static constexpr double kSlack = 1 + 0x1p-49;  // covers the rounding of the bound itself
  static constexpr double kUnderflow = 8 * std::numeric_limits<double>::denorm_min();

  double value_ = 0;
  double error_ = 0;
};

// An integer times a power of two, of any size: exact for every finite double. Slow and rarely needed.
class DyadicNumber {
 public:
  explicit DyadicNumber(double exact);
  static DyadicNumber difference(double a, double b) { return DyadicNumber(a) - DyadicNumber(b); }

  // -1, 0 or +1.
  [[nodiscard]] int sign() const { return sign_; }
  friend DyadicNumber operator+(const DyadicNumber& a, const DyadicNumber& b);
  friend DyadicNumber operator-(const DyadicNumber& a);
  friend DyadicNumber operator-(const DyadicNumber& a, const DyadicNumber& b) { return a + -b; }
  friend DyadicNumber operator*(const DyadicNumber& a, const DyadicNumber& b);

 private:
  using Limbs = std::vector<std::uint32_t>;  // least significant first, no leading zeros

  DyadicNumber(int sign, std::int64_t exponent, Limbs limbs);
  [[nodiscard]] Limbs shifted_to(std::int64_t exponent) const;

  int sign_ = 0;
  std::int64_t exponent_ = 0;
  Limbs limbs_;
};

// The exact sign of a polynomial. `evaluate` computes it in the type of its argument, a BoundedNumber or a
// DyadicNumber.
template <class Evaluate>
int exact_sign(const Evaluate& evaluate) {
  if (const std::optional<int> sign = evaluate(BoundedNumber(0)).sign()) return *sign;
  return evaluate(DyadicNumber(0)).sign();
}

}  // namespace deliso

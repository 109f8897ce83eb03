#include "volume/topology/exact_signs.h"

#include <algorithm>
#include <utility>

#include "delaunay/base/check.h"

namespace deliso {

namespace {

using Limbs = std::vector<std::uint32_t>;

constexpr int kLimbBits = 32;

void trim(Limbs& limbs) {
  while (!limbs.empty() && limbs.back() == 0) limbs.pop_back();
}

// -1, 0, +1 as |a| is below, equal to, above |b|.
int compare(const Limbs& a, const Limbs& b) {
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  for (std::size_t i = a.size(); i-- > 0;) {
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  }
  return 0;
}

Limbs sum(const Limbs& a, const Limbs& b) {
  Limbs result(std::max(a.size(), b.size()) + 1);
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    carry += (i < a.size() ? a[i] : 0ull) + (i < b.size() ? b[i] : 0ull);
    result[i] = static_cast<std::uint32_t>(carry);
    carry >>= kLimbBits;
  }
  trim(result);
  return result;
}

// a - b for a >= b.
Limbs difference_of(const Limbs& a, const Limbs& b) {
  Limbs result(a.size());
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::uint64_t subtrahend = (i < b.size() ? b[i] : 0ull) + borrow;
    borrow = a[i] < subtrahend ? 1 : 0;
    result[i] = static_cast<std::uint32_t>(a[i] - subtrahend);
  }
  trim(result);
  return result;
}

}  // namespace

DyadicNumber::DyadicNumber(double exact) {
  DELISO_CHECK(std::isfinite(exact), "exact arithmetic needs finite numbers");
  if (exact == 0) return;
  int exponent = 0;
  const double fraction = std::frexp(std::abs(exact), &exponent);  // in [1/2, 1), 53 bits
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
  sign_ = exact < 0 ? -1 : 1;
  exponent_ = exponent - 53;
  limbs_ = {static_cast<std::uint32_t>(mantissa), static_cast<std::uint32_t>(mantissa >> kLimbBits)};
  trim(limbs_);
}

DyadicNumber::DyadicNumber(int sign, std::int64_t exponent, Limbs limbs)
    : sign_(limbs.empty() ? 0 : sign), exponent_(exponent), limbs_(std::move(limbs)) {}

// The limbs of this number as a multiple of 2^exponent; exponent <= exponent_.
DyadicNumber::Limbs DyadicNumber::shifted_to(std::int64_t exponent) const {
  const auto shift = static_cast<std::size_t>(exponent_ - exponent);
  const std::size_t whole = shift / kLimbBits;
  const std::size_t bits = shift % kLimbBits;
  Limbs result(limbs_.size() + whole + 1);
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    const std::uint64_t wide = static_cast<std::uint64_t>(limbs_[i]) << bits;
    result[i + whole] |= static_cast<std::uint32_t>(wide);
    result[i + whole + 1] |= static_cast<std::uint32_t>(wide >> kLimbBits);
  }
  trim(result);
  return result;
}

DyadicNumber operator+(const DyadicNumber& a, const DyadicNumber& b) {
  if (a.sign_ == 0) return b;
  if (b.sign_ == 0) return a;
  const std::int64_t exponent = std::min(a.exponent_, b.exponent_);
  const Limbs x = a.shifted_to(exponent);
  const Limbs y = b.shifted_to(exponent);
  if (a.sign_ == b.sign_) return {a.sign_, exponent, sum(x, y)};
  if (compare(x, y) >= 0) return {a.sign_, exponent, difference_of(x, y)};
  return {b.sign_, exponent, difference_of(y, x)};
}

DyadicNumber operator-(const DyadicNumber& a) { return {-a.sign_, a.exponent_, a.limbs_}; }

DyadicNumber operator*(const DyadicNumber& a, const DyadicNumber& b) {
  Limbs result(a.limbs_.size() + b.limbs_.size());
  for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
      carry += result[i + j] + static_cast<std::uint64_t>(a.limbs_[i]) * b.limbs_[j];
      result[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= kLimbBits;
    }
    result[i + b.limbs_.size()] = static_cast<std::uint32_t>(carry);
  }
  trim(result);
  return {a.sign_ * b.sign_, a.exponent_ + b.exponent_, std::move(result)};
}

}  // namespace deliso

// A plain big integer for test oracles. Slow and simple: sign and magnitude, 32-bit limbs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace deliso::test {

class BigInteger {
 public:
  BigInteger() = default;
  BigInteger(std::int64_t value) : negative_(value < 0) {  // NOLINT: implicit on purpose, as for built-in integers
    std::uint64_t rest = negative_ ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
    for (; rest != 0; rest >>= 32) limbs_.push_back(static_cast<std::uint32_t>(rest));
  }
  // value * 2^shift, which must be an integer.
  static BigInteger from_double(double value, int shift) {
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);
    BigInteger result(static_cast<std::int64_t>(std::ldexp(fraction, 53)));
    exponent += shift - 53;
    for (; exponent < 0; ++exponent) result.halve();
    if (exponent > 0 && result.sign() != 0) {
      result = result * (std::int64_t{1} << exponent % 32);
      result.limbs_.insert(result.limbs_.begin(), static_cast<std::size_t>(exponent / 32), 0);
    }
    return result;
  }

  [[nodiscard]] int sign() const { return limbs_.empty() ? 0 : negative_ ? -1 : 1; }
  [[nodiscard]] double to_double() const {
    double value = 0;
    for (std::size_t i = limbs_.size(); i-- > 0;) value = value * 0x1p32 + limbs_[i];
    return negative_ ? -value : value;
  }

  friend BigInteger operator-(BigInteger a) {
    a.negative_ = !a.negative_;
    return a;
  }
  friend BigInteger operator+(const BigInteger& a, const BigInteger& b) {
    if (a.negative_ == b.negative_) return BigInteger(a.negative_, add(a.limbs_, b.limbs_));
    if (less(a.limbs_, b.limbs_)) return BigInteger(b.negative_, subtract(b.limbs_, a.limbs_));
    return BigInteger(a.negative_, subtract(a.limbs_, b.limbs_));
  }
  friend BigInteger operator-(const BigInteger& a, const BigInteger& b) { return a + (-b); }
  friend BigInteger operator*(const BigInteger& a, const BigInteger& b) {
    Limbs product(a.limbs_.size() + b.limbs_.size(), 0);
    for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
        carry += product[i + j] + static_cast<std::uint64_t>(a.limbs_[i]) * b.limbs_[j];
        product[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
      product[i + b.limbs_.size()] = static_cast<std::uint32_t>(carry);
    }
    return BigInteger(a.negative_ != b.negative_, product);
  }

 private:
  using Limbs = std::vector<std::uint32_t>;

  BigInteger(bool negative, Limbs limbs) : negative_(negative), limbs_(std::move(limbs)) {
    while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  }
  void halve() {
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      const std::uint32_t next = i + 1 < limbs_.size() ? limbs_[i + 1] : 0;
      limbs_[i] = (limbs_[i] >> 1) | (next << 31);
    }
    while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  }
  static bool less(const Limbs& a, const Limbs& b) {
    if (a.size() != b.size()) return a.size() < b.size();
    return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  }
  static Limbs add(const Limbs& a, const Limbs& b) {
    Limbs sum;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()) || carry != 0; ++i) {
      carry += (i < a.size() ? a[i] : 0ull) + (i < b.size() ? b[i] : 0ull);
      sum.push_back(static_cast<std::uint32_t>(carry));
      carry >>= 32;
    }
    return sum;
  }
  static Limbs subtract(const Limbs& a, const Limbs& b) {  // a >= b
    Limbs difference;
    std::int64_t borrow = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      borrow += static_cast<std::int64_t>(a[i]) - (i < b.size() ? static_cast<std::int64_t>(b[i]) : 0);
      difference.push_back(static_cast<std::uint32_t>(borrow));
      borrow >>= 32;
    }
    return difference;
  }

  bool negative_ = false;
  Limbs limbs_;  // least significant first, no leading zeros
};

}  // namespace deliso::test

// On which side of an isovalue samples lie, as bits: one pass over the samples, compared in their own type.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace deliso {

inline constexpr std::size_t kSidesPerWord = 64;

// Compares a sample with an isovalue in the sample's own type.
template <class Sample>
class SideTest {
 public:
  explicit SideTest(double isovalue) : threshold_(), never_equal_(true) {
    if constexpr (std::is_floating_point_v<Sample> && sizeof(Sample) == sizeof(double)) {
      threshold_ = isovalue;
      never_equal_ = false;
    } else {
      // The largest number of the type that is not above the isovalue: a sample is above the isovalue when it is above
      // this.
      constexpr Sample kLowest = std::numeric_limits<Sample>::lowest();
      constexpr Sample kHighest = std::numeric_limits<Sample>::max();
      if (isovalue < static_cast<double>(kLowest)) {
        all_above_ = true;
      } else if (isovalue >= static_cast<double>(kHighest)) {
        threshold_ = kHighest;
        never_equal_ = isovalue > static_cast<double>(kHighest);
      } else {
        if constexpr (std::is_floating_point_v<Sample>) {
          threshold_ = static_cast<Sample>(isovalue);
          if (static_cast<double>(threshold_) > isovalue) threshold_ = std::nextafter(threshold_, kLowest);
        } else {
          threshold_ = static_cast<Sample>(std::floor(isovalue));
        }
        never_equal_ = static_cast<double>(threshold_) != isovalue;
      }
    }
  }

  [[nodiscard]] bool is_above(Sample sample) const { return all_above_ || sample > threshold_; }
  // Can no number of the type equal the isovalue?
  [[nodiscard]] bool never_equal() const { return never_equal_; }
  [[nodiscard]] bool equals(Sample sample) const { return !never_equal_ && sample == threshold_; }

  // Bit i of the words, counted across them: whether sample i lies above. The unused bits of the last word are 0.
  void pack(const Sample* samples, std::size_t count, std::uint64_t* words) const {
    std::array<std::uint8_t, kSidesPerWord> flags{};
    for (std::size_t start = 0; start < count; start += kSidesPerWord) {
      const std::size_t here = std::min(kSidesPerWord, count - start);
      if (here < kSidesPerWord) flags.fill(0);
      if (all_above_) {
        std::fill_n(flags.begin(), here, std::uint8_t{1});
      } else if (here == kSidesPerWord) {
        for (std::size_t b = 0; b < kSidesPerWord; ++b) flags[b] = samples[start + b] > threshold_ ? 1 : 0;
      } else {
        for (std::size_t b = 0; b < here; ++b) flags[b] = samples[start + b] > threshold_ ? 1 : 0;
      }
      *words++ = packed(flags);
    }
  }

 private:
  // Sets bit b of the result when flags[b] is 1; flags are 0 or 1.
  static std::uint64_t packed(const std::array<std::uint8_t, kSidesPerWord>& flags) {
    std::uint64_t word = 0;
    for (std::size_t byte = 0; byte < 8; ++byte) {
      // Eight flags in one number, the first in the lowest byte; the multiplication gathers them in the top byte.
      std::uint64_t eight = 0;
      for (std::size_t b = 0; b < 8; ++b) eight |= static_cast<std::uint64_t>(flags[8 * byte + b]) << (8 * b);
      word |= ((eight * 0x0102040810204080ull) >> 56) << (8 * byte);
    }
    return word;
  }

  Sample threshold_;
  bool all_above_ = false;
  bool never_equal_;
};

}  // namespace deliso

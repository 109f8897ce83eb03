// The samples of a volume in one type: an immutable array, in our own memory or mapped from a file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace deliso {

// Copies share the memory.
template <class Sample>
class SampleArray {
 public:
  using value_type = Sample;
  using const_iterator = const Sample*;
  using iterator = const_iterator;

  SampleArray() = default;
  template <class Allocator>
  SampleArray(std::vector<Sample, Allocator> samples) {  // NOLINT(google-explicit-constructor): the usual array
    auto kept = std::make_shared<const std::vector<Sample, Allocator>>(std::move(samples));
    samples_ = *kept;
    memory_ = std::move(kept);
  }
  // Samples in memory that stays valid as long as `mapping` exists.
  SampleArray(std::shared_ptr<const void> mapping, std::span<const Sample> samples)
      : samples_(samples), memory_(std::move(mapping)), is_mapped_(true) {}

  SampleArray(const SampleArray&) = default;
  SampleArray& operator=(const SampleArray&) = default;
  SampleArray(SampleArray&& other) noexcept { swap(other); }  // leaves `other` empty
  SampleArray& operator=(SampleArray&& other) noexcept {
    SampleArray(std::move(other)).swap(*this);
    return *this;
  }
  ~SampleArray() = default;

  void swap(SampleArray& other) noexcept {
    std::swap(samples_, other.samples_);
    std::swap(memory_, other.memory_);
    std::swap(is_mapped_, other.is_mapped_);
  }

  [[nodiscard]] const Sample* data() const { return samples_.data(); }
  [[nodiscard]] std::size_t size() const { return samples_.size(); }
  [[nodiscard]] const Sample* begin() const { return samples_.data(); }
  [[nodiscard]] const Sample* end() const { return samples_.data() + samples_.size(); }
  [[nodiscard]] const Sample& front() const { return samples_.front(); }
  const Sample& operator[](std::size_t n) const { return samples_[n]; }
  // Whether it is in a file's memory, which the system may drop and read again.
  [[nodiscard]] bool is_mapped() const { return is_mapped_; }

  friend bool operator==(const SampleArray& a, const SampleArray& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::span<const Sample> samples_;
  std::shared_ptr<const void> memory_;
  bool is_mapped_ = false;
};

}  // namespace deliso

// A large flat array that several workers may append to at the same time, each within a range of its own.
//
// The owner uses it like a vector. For workers the owner reserves room and gives each a view. A view shows the same
// elements, and appends to a range that no other view uses. Afterwards the owner takes in the views in the order of
// their ranges.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "delaunay/base/check.h"
#include "delaunay/base/huge_pages.h"
#include "delaunay/base/parallel.h"

namespace deliso {

// Indices of an array: first to last - 1.
struct Range {
  std::size_t first = 0;
  std::size_t last = 0;
};

template <class T>
class SharedArray {
 public:
  SharedArray() = default;
  explicit SharedArray(std::size_t count) { resize(count); }
  // A view that begins to append at range.first. The owner must have room for the range, and must not be changed as
  // long as there are views.
  SharedArray(SharedArray& owner, const Range& range)
      : data_(owner.data_), size_(range.first), room_(range.last), first_(range.first), is_view_(true) {
    DELISO_CHECK(owner.size_ <= range.first && range.last <= owner.room_, "the owner has room for the view");
  }
  SharedArray(SharedArray&& other) noexcept { swap(other); }
  SharedArray& operator=(SharedArray&& other) noexcept {
    SharedArray(std::move(other)).swap(*this);
    return *this;
  }
  SharedArray(const SharedArray&) = delete;
  SharedArray& operator=(const SharedArray&) = delete;
  ~SharedArray() { drop(); }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  // How many more elements it can hold without growing.
  [[nodiscard]] std::size_t room_left() const { return room_ - size_; }
  T* data() { return data_; }
  [[nodiscard]] const T* data() const { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  [[nodiscard]] const T* begin() const { return data_; }
  [[nodiscard]] const T* end() const { return data_ + size_; }

  template <class... Args>
  T& emplace_back(Args&&... args) {
    if (size_ == room_) [[unlikely]] {
      reserve(std::max<std::size_t>(2 * size_, kFewest));
    }
    return *std::construct_at(data_ + size_++, std::forward<Args>(args)...);
  }
  void push_back(const T& value) { emplace_back(T(value)); }  // a copy, because the value may lie in this array
  // New elements are those of T().
  void resize(std::size_t count) {
    if (count > room_) reserve(std::max(count, 2 * size_));
    if (count > size_) std::uninitialized_value_construct(data_ + size_, data_ + count);
    if (count < size_) std::destroy(data_ + count, data_ + size_);
    size_ = count;
  }
  void clear() { resize(0); }
  // Several threads share the copying: most of its time goes into waiting for fresh pages.
  void reserve(std::size_t count, int threads = 1) {
    if (count <= room_) return;
    DELISO_CHECK(!is_view_, "a view stays within its range");
    SharedArray larger;
    larger.data_ = HugePageAllocator<T>().allocate(count);
    larger.room_ = count;
    run_tasks((size_ + kMovedAtOnce - 1) / kMovedAtOnce, threads, [&](std::size_t i) {
      const std::size_t first = i * kMovedAtOnce, last = std::min(size_, first + kMovedAtOnce);
      std::uninitialized_move(data_ + first, data_ + last, larger.data_ + first);
    });
    larger.size_ = size_;
    swap(larger);
  }
  // The same, but it grows at least by half, so frequent calls take amortized constant time per element.
  void make_room(std::size_t count, int threads = 1) {
    if (count > room_) reserve(std::max(count, room_ + room_ / 2), threads);
  }
  void swap(SharedArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(room_, other.room_);
    std::swap(first_, other.first_);
    std::swap(is_view_, other.is_view_);
  }

  // Takes in what a view of this array has appended; the view must not be used afterwards. Views are taken in the order
  // of their ranges. Returns the indices that were skipped before the view's range; their elements are now T().
  Range take_in(SharedArray& view) {
    DELISO_CHECK(!is_view_ && view.is_view_ && view.data_ == data_ && size_ <= view.first_, "views come in order");
    const Range skipped{size_, view.first_};
    std::uninitialized_value_construct(data_ + skipped.first, data_ + skipped.last);
    size_ = view.size_;
    view.first_ = view.size_;
    return skipped;
  }

 private:
  static constexpr std::size_t kFewest = 16;
  static constexpr std::size_t kMovedAtOnce = (std::size_t{1} << 21) / sizeof(T);

  void drop() {
    if (data_ == nullptr) return;
    std::destroy(data_ + first_, data_ + size_);
    if (!is_view_) HugePageAllocator<T>().deallocate(data_, room_);
    data_ = nullptr;
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t room_ = 0;
  std::size_t first_ = 0;  // where its own elements begin; those of a view are what it has appended
  bool is_view_ = false;
};

}  // namespace deliso

// An allocator for large flat arrays that are read all over: asks the system for huge pages, which saves most of the
// address translation misses. Where it cannot, it behaves as std::allocator.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace deliso {

template <class T>
class HugePageAllocator {
 public:
  using value_type = T;

  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>& /*other*/) {}  // NOLINT: implicit conversion as allocators need

  T* allocate(std::size_t count) {
    if (count < kFewest) return std::allocator<T>().allocate(count);
    if (count > kMost) throw std::bad_array_new_length();
    const std::size_t bytes = (count * sizeof(T) + kPage - 1) / kPage * kPage;
    void* memory = std::aligned_alloc(kPage, bytes);
    if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
    madvise(memory, bytes, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    if (count < kFewest) {
      std::allocator<T>().deallocate(memory, count);
    } else {
      std::free(memory);
    }
  }

  friend bool operator==(const HugePageAllocator& /*a*/, const HugePageAllocator& /*b*/) { return true; }

 private:
  static constexpr std::size_t kPage = std::size_t{1} << 21;
  static constexpr std::size_t kFewest = 4 * kPage / sizeof(T);
  static constexpr std::size_t kMost = (std::size_t{1} << 40) / sizeof(T);
};

}  // namespace deliso

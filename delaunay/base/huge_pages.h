// An allocator for large flat arrays that are read at random. It takes memory from the system in huge pages, which
// avoids most TLB misses, and gives freed memory back at once. On systems without huge pages it is std::allocator.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace deliso {

#ifdef __linux__

template <class T>
class HugePageAllocator {
 public:
  using value_type = T;

  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>& /*other*/) {}  // NOLINT: implicit conversion, as allocators need

  T* allocate(std::size_t count) {
    if (count < kFewest) return std::allocator<T>().allocate(count);
    if (count > kMost) throw std::bad_array_new_length();
    // Reserve one page more than needed and give back what lies around the aligned part.
    const std::size_t bytes = rounded_bytes(count);
    void* const mapped = mmap(nullptr, bytes + kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    const std::size_t before = (kPage - reinterpret_cast<std::uintptr_t>(mapped) % kPage) % kPage;
    char* const begin = static_cast<char*>(mapped) + before;
    if (before > 0) munmap(mapped, before);
    munmap(begin + bytes, kPage - before);
    madvise(begin, bytes, MADV_HUGEPAGE);  // only advice: if the system refuses it, nothing is lost
    return reinterpret_cast<T*>(begin);
  }
  void deallocate(T* memory, std::size_t count) {
    if (count < kFewest) {
      std::allocator<T>().deallocate(memory, count);
    } else {
      munmap(memory, rounded_bytes(count));
    }
  }

  friend bool operator==(const HugePageAllocator& /*a*/, const HugePageAllocator& /*b*/) { return true; }

 private:
  static constexpr std::size_t kPage = std::size_t{1} << 21;
  static constexpr std::size_t kFewest = kPage / sizeof(T);
  static constexpr std::size_t kMost = (std::size_t{1} << 46) / sizeof(T);

  static std::size_t rounded_bytes(std::size_t count) { return (count * sizeof(T) + kPage - 1) / kPage * kPage; }
};

#else

template <class T>
using HugePageAllocator = std::allocator<T>;

#endif

// A vector for one large flat array.
template <class T>
using LargeArray = std::vector<T, HugePageAllocator<T>>;

// The same, but elements made without a value stay uninitialized until they are written. So several threads can write
// them for the first time, which is when the system provides the pages.
template <class T>
class UnwrittenAllocator : public HugePageAllocator<T> {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  UnwrittenAllocator() = default;
  template <class U>
  UnwrittenAllocator(const UnwrittenAllocator<U>& /*other*/) {}  // NOLINT: implicit conversion, as allocators need
  template <class U>
  void construct(U* /*place*/) {}
  template <class U, class... Args>
  void construct(U* place, Args&&... args) {
    std::construct_at(place, std::forward<Args>(args)...);
  }
};
template <class T>
using UnwrittenArray = std::vector<T, UnwrittenAllocator<T>>;

}  // namespace deliso

#include "experiments/large_blocks.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DELISO_OWN_BLOCKS 0
#elif defined(__has_feature)
#define DELISO_OWN_BLOCKS (!__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer))
#else
#define DELISO_OWN_BLOCKS 1
#endif

#if defined(__GLIBC__) && DELISO_OWN_BLOCKS

#include <malloc.h>
#include <sys/mman.h>

namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;

void* large_block(std::size_t bytes) {
  if (bytes > SIZE_MAX - kHugePage) return nullptr;
  const std::size_t rounded = (bytes + kHugePage - 1) / kHugePage * kHugePage;
  void* const block = std::aligned_alloc(kHugePage, rounded);
  if (block != nullptr) madvise(block, rounded, MADV_HUGEPAGE);  // only advice: if it is refused, nothing is lost
  return block;
}

}  // namespace

void* operator new(std::size_t bytes) {
  for (;;) {
    void* const block = bytes < kHugePage ? std::malloc(bytes == 0 ? 1 : bytes) : large_block(bytes);
    if (block != nullptr) return block;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t /*bytes*/) noexcept { std::free(block); }

namespace deliso {

// By itself glibc comes to keep blocks of up to 32 MiB among small ones, where fresh pages are small.
void use_large_blocks() {
  constexpr int kMostKept = 64 << 20;  // bytes that are free at the end of small blocks
  mallopt(M_MMAP_THRESHOLD, static_cast<int>(kHugePage));
  mallopt(M_TRIM_THRESHOLD, kMostKept);
}

}  // namespace deliso

#else

void deliso::use_large_blocks() {}

#endif
